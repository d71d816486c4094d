"""How a project sets rules, and exempts elements from them."""

from __future__ import annotations

import pytest

from rgss.findings import Severity
from rgss.measures import Verdict
from rgss.trace.evidence.evidence_state import EvidenceState, TrialVerdicts
from rgss.trace.sentences import TermList, read_sentence

VAGUE = "The gripper shall lift several cups of at least 0.8 kg."


@pytest.fixture
def vague(project):
    return project.edit("system.yaml", "The gripper shall lift at least 0.8 kg.", VAGUE)


def setting(text):
    return f"  {text}\n"


def exempt(*rules, reason="the source says so"):
    return "    exempt:\n" + "".join(f"      - {{rule: {rule}, reason: {reason}}}\n" for rule in rules)


def test_a_severity_is_set(vague):
    (finding,) = vague.append("rules.yaml", setting("wording.R7: {severity: info, reason: R}")).found()

    assert (finding.rule, finding.severity) == ("wording.R7", Severity.INFO)


def test_a_rule_is_switched_off(vague):
    assert vague.append("rules.yaml", setting("wording.R7: {enabled: false, reason: R}")).rules() == []


def test_terms_are_added(project):
    project.append("rules.yaml", setting("wording.R7: {terms_added: [at least], reason: R}"))
    (finding,) = project.findings()

    assert "'SYS-1' says 'at least', which is vague" in finding


@pytest.mark.parametrize(
    ("term", "text", "found"),
    [
        ("[a-", "lift a cup", False),
        ("[a-", "lift a cup in [a-z]", True),
        ("(", "lift (and hold) a cup", True),
        ("(", "lift a cup", False),
        ("c++", "run C++", True),
        ("c++", "run c", False),
        ("e.t.", "lift eat", False),
        (".*", "lift a cup", False),
        ("%", "lift 5 % of the mass", True),
        ("Cup", "lift a Cup", True),
        ("Cup", "lift a cup", False),
        ("CUP", "lift a CUP", True),
        ("CUP", "lift a cup", False),
        ("cup", "lift a Cup", True),
        ("A", "lift a cup", False),
        ("A", "lift plan A", True),
        ("Easy to *", "be Easy to lift", True),
        ("Easy to *", "be easy to lift", False),
    ],
)
def test_terms_that_are_added_match_letter_by_letter(term, text, found):
    """Also where they are characters of regular expressions; small letters are found in any capitals."""
    sentence = read_sentence(f"The gripper shall {text}")
    terms = TermList((), added=[term])
    assert [match.term for match in terms.find(sentence, start=sentence.response_start)] == [term] * found
    assert terms.is_absent(sentence) is not found
    assert all(0 <= one.first < one.after <= len(sentence.tokens) for one in terms.find(sentence))


def test_a_symbol_is_a_term_of_every_rule_with_terms(project):
    """Rules look at the words around a match: at the end of a sentence there are none."""
    project.edit("system.yaml", "lift at least 0.8 kg", "lift at least 0.8 kg &")
    for number in (7, 8, 16, 19, 24, 26, 35):
        project.append("rules.yaml", setting(f"wording.R{number}: {{terms_added: ['&'], reason: R}}"))
    assert set(project.rules()) == {f"wording.R{number}" for number in (7, 8, 16, 19, 24, 26, 35)}


def test_terms_are_removed(vague):
    assert vague.append("rules.yaml", setting("wording.R7: {terms_removed: [Several], reason: R}")).rules() == []


def test_participles_are_taken_for_adjectives(project):
    project.edit("system.yaml", "lift at least 0.8 kg", "be curved")
    assert project.rules() == ["wording.R2"]
    assert project.append("rules.yaml", setting("wording.R2: {terms_added: [curved], reason: R}")).rules() == []


def test_combinators_between_things_count_where_they_are_added(project):
    project.edit("system.yaml", "lift at least 0.8 kg", "report position and velocity")
    assert project.rules() == []
    assert project.append("rules.yaml", setting("wording.R19: {terms_added: [and], reason: R}")).rules() == [
        "wording.R19"
    ]


def test_an_element_is_exempt(vague):
    assert vague.append("system.yaml", exempt("wording.R7")).rules() == []


def test_a_need_and_a_block_are_exempt_too(project):
    project.edit("stakeholder.yaml", "serve the cup", "serve it").append("stakeholder.yaml", exempt("wording.R24"))
    entry = "  - {id: BLK-2, name: Arm, level: subsystem, text: T., exempt: [{rule: trace.idle-element, reason: R}]}\n"
    assert project.append("architecture.yaml", entry).rules() == []


def test_an_exemption_is_of_one_element(vague):
    again = vague.append("system.yaml", exempt("wording.R7")).edit("stakeholder.yaml", "the cup.", "several cups.")
    (finding,) = again.findings()

    assert "'STK-1' says 'several'" in finding


@pytest.mark.parametrize(
    ("rule", "text"),
    [
        ("wording.R77", "there is no rule 'wording.R77' (did you mean 'wording.R7'?)"),
        ("trace.cycle", "no element can be exempt from 'trace.cycle' (remove it)"),
        ("requirements.dangling-id", "no element can be exempt from 'requirements.dangling-id' (remove it)"),
        ("trace.mop-without-moe", "no element can be exempt from 'trace.mop-without-moe' (remove it)"),
        ("trace.unknown-mark", "no element can be exempt from 'trace.unknown-mark' (remove it)"),
        ("exempt.unused", "no element can be exempt from 'exempt.unused' (remove it)"),
    ],
)
def test_exemptions_from_what_allows_none(project, rule, text):
    project.append("system.yaml", exempt(rule))
    assert project.findings() == [f"{project.position('system.yaml', rule)}: error: {text} [exempt.unknown-rule]"]


def test_an_exemption_that_is_not_needed(project):
    project.append("system.yaml", exempt("wording.R7"))
    assert project.findings() == [
        (
            f"{project.position('system.yaml', 'wording.R7')}: warning: 'SYS-1' is exempt from 'wording.R7', which it "
            "does not break (remove it) [exempt.unused]"
        )
    ]


def test_an_exemption_from_a_rule_that_is_off_is_not_judged(vague):
    vague.append("rules.yaml", setting("wording.R7: {enabled: false, reason: R}"))
    assert vague.append("system.yaml", exempt("wording.R7")).rules() == []


def test_an_exemption_from_a_rule_of_evidence_is_judged_with_evidence(project):
    assert project.append("system.yaml", exempt("evidence.none")).rules() == []
    for verdict, rules in ((Verdict.NOT_RUN, []), (Verdict.MET, ["exempt.unused"])):
        found = TrialVerdicts(requirement="SYS-1", verdicts={1: verdict}, recorded={}, causes={})
        project.evidence = EvidenceState(trials={"SYS-1": found})
        assert project.rules() == rules


@pytest.mark.parametrize(
    ("entry", "at", "text"),
    [
        ("wording.R77: {enabled: false, reason: R}", "wording.R77", "error: there is no rule 'wording.R77' (did you"),
        ("wording.R7: {reason: R}", "wording.R7", "warning: the setting of 'wording.R7' changes nothing (remove it)"),
        ("trace.cycle: {enabled: false, reason: R}", "trace.cycle", "error: rule 'trace.cycle' cannot be set"),
        ("wording.R7: {severity: error, reason: R}", "error", "warning: the severity of 'wording.R7' is error anyway"),
        ("wording.R7: {terms_added: [Several], reason: R}", "Several", "warning: rule 'wording.R7' has the term 'S"),
        ("wording.R7: {terms_added: ['*'], reason: R}", "'*'", "warning: rule 'wording.R7' looks for no such terms"),
        ("wording.R7: {terms_added: ['* go'], reason: R}", "'* go'", "warning: rule 'wording.R7' looks for no such t"),
        ("wording.R7: {terms_removed: [red], reason: R}", "red", "warning: rule 'wording.R7' does not have the te"),
        ("wording.R17: {terms_added: [red], reason: R}", "red", "warning: rule 'wording.R17' looks for no such terms"),
        ("trace.orphan: {terms_added: [red], reason: R}", "red", "warning: rule 'trace.orphan' looks for no such t"),
    ],
)  # fmt: skip
def test_settings_that_change_nothing(project, entry, at, text):
    project.append("rules.yaml", setting(entry))
    (finding,) = project.findings()

    assert finding.startswith(f"{project.position('rules.yaml', at)}: {text}")


def test_a_fixed_rule_holds_whatever_is_set(project):
    project.append("rules.yaml", setting("trace.unknown-measure: {enabled: false, reason: R}"))
    project.edit("system.yaml", "measure: P,", "measure: Q,")
    assert project.rules() == ["settings.unknown-rule", "trace.unknown-measure"]


def test_the_rules_of_settings_can_be_set(project):
    project.append("system.yaml", exempt("wording.R7"))
    assert project.append("rules.yaml", setting("exempt.unused: {enabled: false, reason: R}")).rules() == []
