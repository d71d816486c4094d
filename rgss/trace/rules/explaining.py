"""Explanations of the rules, for the command line and as a page of the documentation."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from rgss.trace.rules.registry import FAMILIES
from rgss.trace.rules.rule import EvidenceRule, LoadingRule, MarkRule, Rule, SentenceRule


def rule_lines(rule: Rule) -> Iterator[str]:
    """Lines of text about a rule: requirement and rationale, terms, and configuration."""
    yield f"{rule.id} ({rule.severity.value})"
    yield f"  {' '.join(rule.explanation.split())}"
    yield f"  Checked {when_checked(rule)}."
    if isinstance(rule, SentenceRule) and rule.terms:
        yield f"  {rule.meaning[:1].upper()}{rule.meaning[1:]}: {', '.join(rule.terms)}."
    elif isinstance(rule, SentenceRule) and rule.meaning:
        yield f"  Takes terms: {rule.meaning}."
    if rule.fixed:
        yield "  It can neither be set nor exempted from."
        return
    settings = "severity: info, reason: …"
    if isinstance(rule, SentenceRule) and rule.meaning:
        settings = "severity: info, terms_added: […], terms_removed: […], reason: …"
    yield f"  To set it, in requirements/rules.yaml:  rules: {{{rule.id}: {{{settings}}}}}"
    yield f"  To switch it off, there:                rules: {{{rule.id}: {{enabled: false, reason: …}}}}"
    if rule.allows_exemption:
        yield f"  To exempt one element, in its entry:    exempt: [{{rule: {rule.id}, reason: …}}]"


def when_checked(rule: Rule) -> str:
    """Occasion on which a rule is checked, in words that follow 'checked'."""
    if isinstance(rule, LoadingRule):
        return "whenever the files are read"
    if isinstance(rule, MarkRule):
        return "by 'rgss check' where the project has a folder tests/"
    return "by 'rgss check --evidence'" if isinstance(rule, EvidenceRule) else "by 'rgss check'"


def rule_as_json(rule: Rule) -> dict[str, Any]:
    """A rule as plain data."""
    return {
        "rule": rule.id,
        "severity": rule.severity.value,
        "explanation": rule.explanation,
        "checked": when_checked(rule),
        "configurable": not rule.fixed,
        "terms": list(rule.terms) if isinstance(rule, SentenceRule) else [],
    }


def rules_markdown() -> str:
    """Every rule as a page in Markdown."""
    return "\n".join(_page()) + "\n"


def _page() -> Iterator[str]:
    yield _HEAD
    for family in FAMILIES:
        yield f"## {family.title}\n"
        yield "| rule | severity | what must hold, and why |"
        yield "|---|---|---|"
        for rule in family.rules:
            notes = " Cannot be set." if rule.fixed else ""
            yield f"| `{rule.id}` | {rule.severity.value} | {rule.explanation}{notes} |"
        yield ""
    yield "## Terms of the wording rules\n"
    for family in FAMILIES:
        for rule in family.rules:
            if isinstance(rule, SentenceRule) and rule.terms:
                yield f"**`{rule.id}`**, {rule.meaning}: {', '.join(rule.terms)}.\n"


_HEAD = """\
# Rules

<!-- Written by `rgss check --explain --markdown`; a test compares it with the code. -->

`rgss check` checks a project against these rules; `rgss check --explain RULE` explains one of them. Each
finding has its place as `file:line:column`. A check never writes.

- **Severity.** An error or a warning makes `rgss check` end with 1; a note (`info`) is shown by
  `rgss check --all`.
- **Settings.** `rules.yaml`, in the folder of the requirements, sets the severity of a rule, switches
  it off, or adds and removes terms that it searches for; each setting has a reason:
  `rules: {wording.R19: {severity: info, reason: "…"}}`. A setting that changes nothing is a finding. An
  added term is found as it is written; one in small letters also in capitals.
- **Exemptions.** An element may break a rule for a stated reason:
  `exempt: [{rule: wording.R7, reason: "…"}]`. An exemption that exempts nothing is a finding.
- **Evidence.** `rgss check --evidence` also compares the verdicts with the stored evidence, and the marks
  `@pytest.mark.verifies("…")` with the result of the tests in `.rgss/junit.xml`.
- **Reviews.** `rgss check --review ID --reviewer NAME` records in `reviews.yaml`, beside `rules.yaml`,
  that somebody has read an element, with the digests of its content and of its upstream elements. When an
  upstream text changes afterwards, the link to it is suspect until the element is reviewed again.

Numbers such as R7 are those of the INCOSE *Guide to Writing Requirements*, version 3.1; explanations
and word lists are those of rgss. Sentences follow the EARS patterns (Mavin and others, 2009): *The SYSTEM
shall …* alone, or after `While` a state, `When` an event, `Where` an option, `If` something unwanted
`then`, or several of these. Words that mean the same, such as `Upon` or `In the event of`, are
understood; `wording.ears-keyword` notes them.

## Verdicts

`rgss measure` gives a verdict on each requirement with a criterion for each variant;
`rgss measure --verdicts` lists them. The verdict on a requirement without a criterion that is verified
by test follows from the tests that are marked with it; what a person inspected, demonstrated, analysed
or tested follows from its record (`rgss verify`). Of tests and record the worst decides. A marked test
that failed, and a record of *not met*, outweigh what trials show of a requirement with a criterion, in
`rgss trace`, in the decision and on the report; a test that passed, or a record of *met*, does not.

| verdict | by trials | by tests | by a record |
|---|---|---|---|
| met, not met | the estimate and its whole interval lie on one side of the threshold | all passed; one failed | found |
| inconclusive | the interval straddles the threshold, is unknown, or no trial gave a value | | found |
| not run | no trial of the variant was run | a marked test was not run | |
| stale | something changed since the evidence | something changed since the run | something changed since |

A verdict becomes stale when a digest differs, and the cause is named:

- *model*, *code*, *engines*: a trial that the verdict needs has evidence only under other inputs,
  other source of the pieces that make it, or another engine. `rgss sweep` runs it again.
- *requirement*: its sentence, its criterion or its verification changed since the verdict was
  recorded. *measure*: the definition of its measure, or of any measure, input or
  constant below it. *model*, also without trials: a value of the design or a component behind it.
  `rgss measure --record` gives and records new verdicts by the stored evidence.

Recorded verdicts are in `.rgss/verdicts.json` beside the evidence. A verdict that was never
recorded cannot be older than its requirement; a recorded one that its evidence contradicts is a
finding. A test run that `pytest --junitxml=FILE` writes where rgss is installed contains the digests
of the tested code (in the project's folder, in `src`, or in a package of the folder) and of each
requirement, and is stale once one of them differs. A run without them is stale as *unrecorded*:
nobody knows what it tested. Of a test with parameters the sets that were run count. A verification
record contains the digests of the requirement and of the files that it rests on (*files*).
"""
