"""Every rule of traceability, and the check of a project against them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

from rgss.errors import DefinitionError
from rgss.findings import Finding, Severity
from rgss.requirements import RequirementSet, nearest
from rgss.trace.evidence import EvidenceState, MarkedTest
from rgss.trace.model import MeasureTrace, TraceModel, build_trace_model
from rgss.trace.rules import coverage, criteria, links, marks, reviews, rule_configuration, verification_evidence
from rgss.trace.rules import rule_loading as loading_rules
from rgss.trace.rules.rule import EvidenceRule, MarkRule, ModelRule, Rule, SentenceRule, Violation
from rgss.trace.rules.wording import WORDING_RULES
from rgss.trace.sentences import TermList, read_sentence, words_of


@dataclass(frozen=True, slots=True, kw_only=True)
class RuleFamily:
    """Family of rules.

    Attributes:
        title: Their subject.
        rules: The rules, in the order of the listing.
    """

    title: str
    rules: tuple[Rule, ...]


FAMILIES: tuple[RuleFamily, ...] = (
    RuleFamily(title="Links", rules=(*loading_rules.RULES, *links.RULES)),
    RuleFamily(title="Coverage", rules=coverage.RULES),
    RuleFamily(title="Verification", rules=(*criteria.RULES, *marks.RULES)),
    RuleFamily(title="Evidence", rules=verification_evidence.RULES),
    RuleFamily(
        title="Wording",
        rules=WORDING_RULES,
    ),
    RuleFamily(title="Reviews", rules=reviews.RULES),
    RuleFamily(title="Settings and exemptions", rules=rule_configuration.RULES),
)
"""Every rule, family by family."""

RULES: tuple[Rule, ...] = tuple(rule for family in FAMILIES for rule in family.rules)
"""Every rule."""


_READING = frozenset({"document", "design", "measures", "scene", "study"})
"""Prefixes of the ids of findings that are made while other files are read."""


def rule_of(rule_id: str) -> Rule:
    """Rule by id.

    Raises:
        DefinitionError: The id is unknown; the hint names the nearest id.
    """
    for rule in RULES:
        if rule.id.lower() == rule_id.lower():
            return rule
    # The name behind the dot is enough where only one rule has it, such as R9 for wording.R9.
    short = [rule for rule in RULES if rule.id.rpartition(".")[2].lower() == rule_id.lower()]
    if len(short) == 1:
        return short[0]
    if short:
        raise DefinitionError(
            f"{rule_id!r} is the name of several rules", hint="write " + " or ".join(rule.id for rule in short)
        )
    if rule_id.split(".", maxsplit=1)[0] in _READING:
        raise DefinitionError(
            f"{rule_id!r} is about reading files; its findings say what is wrong and where",
            hint="'rgss check --explain' lists the rules of requirements",
        )
    hint = nearest(rule_id, [rule.id for rule in RULES]) or "'rgss check --explain' lists all rules"
    raise DefinitionError(f"there is no rule {rule_id!r}", hint=hint)


def check_trace(
    requirements: RequirementSet,
    measures: Sequence[MeasureTrace],
    *,
    marked: Sequence[MarkedTest] | None = None,
    evidence: EvidenceState | None = None,
) -> tuple[Finding, ...]:
    """Traceability check: derivation, measures, allocation, verifiability and wording of needs and requirements.

    The project's settings and exemptions are applied, and checked too.

    Args:
        requirements: The requirements and the architecture of a project.
        measures: Its measures.
        marked: The marks on its own tests; None if it has no tests.
        evidence: Its evidence; None to skip the rules of evidence.

    Returns:
        The findings in the order of their positions; only infos for a consistent project.
    """
    check = _Check(requirements, measures, None if marked is None else tuple(marked), evidence)
    return tuple(sorted(check.findings()))


class _Check:
    def __init__(
        self,
        requirements: RequirementSet,
        measures: Sequence[MeasureTrace],
        marked: tuple[MarkedTest, ...] | None,
        evidence: EvidenceState | None,
    ) -> None:
        self._model = build_trace_model(requirements, measures)
        self._marked = marked
        self._evidence = evidence
        self._rules: Mapping[str, Rule] = MappingProxyType({rule.id: rule for rule in RULES})
        self._exempt = {
            rule_configuration.Exempted(element.id, exemption.rule)
            for element in requirements.elements
            for exemption in element.exempt
        }
        self._used: set[rule_configuration.Exempted] = set()

    def findings(self) -> Iterator[Finding]:
        """All of them; settings and exemptions come last, when it is known which exemptions were used."""
        requirements = self._model.requirements
        checked = [rule for rule in RULES if self._is_checked(rule)]
        for rule in checked:
            yield from self._reported(rule, self._violations(rule))
        sentence_rules = [rule for rule in checked if isinstance(rule, SentenceRule)]
        for rule, violation in _sentence_violations(self._model, sentence_rules):
            yield from self._reported(rule, iter((violation,)))
        of_settings = rule_configuration.setting_violations(requirements, self._rules)
        ids = frozenset(rule.id for rule in checked)
        of_exemptions = rule_configuration.exemption_violations(requirements, self._rules, ids, frozenset(self._used))
        for configuration_rule, violation in (*of_settings, *of_exemptions):
            if self._is_enabled(configuration_rule):
                yield from self._reported(configuration_rule, iter((violation,)))

    def _is_checked(self, rule: Rule) -> bool:
        if isinstance(rule, EvidenceRule):
            return self._evidence is not None and self._is_enabled(rule)
        if isinstance(rule, MarkRule):
            return self._marked is not None and self._is_enabled(rule)
        return isinstance(rule, (ModelRule, SentenceRule)) and self._is_enabled(rule)

    def _is_enabled(self, rule: Rule) -> bool:
        setting = self._model.requirements.settings.get(rule.id)
        return rule.fixed or setting is None or setting.enabled

    def _violations(self, rule: Rule) -> Iterator[Violation]:
        if isinstance(rule, ModelRule):
            yield from rule.check(self._model)
        elif isinstance(rule, MarkRule) and self._marked is not None:
            yield from rule.check(self._model, self._marked)
        elif isinstance(rule, EvidenceRule) and self._evidence is not None:
            yield from rule.check(self._model, self._evidence)

    def _reported(self, rule: Rule, violations: Iterator[Violation]) -> Iterator[Finding]:
        severity = severity_of(rule, self._model.requirements)
        for violation in violations:
            if rule.allows_exemption and isinstance(violation.subject, str):
                exempted = rule_configuration.Exempted(violation.subject, rule.id)
                if exempted in self._exempt:
                    self._used.add(exempted)
                    continue
            yield violation.finding(self._model, rule.id, severity)


def severity_of(rule: Rule, requirements: RequirementSet) -> Severity:
    """Severity of a violation of a rule in a project."""
    setting = requirements.settings.get(rule.id)
    return rule.severity if rule.fixed or setting is None or setting.severity is None else setting.severity


def terms_of(rule: SentenceRule, requirements: RequirementSet) -> TermList:
    """The terms that a rule looks for in a project."""
    setting = requirements.settings.get(rule.id)
    if setting is None:
        return TermList(rule.terms)
    removed = {words_of(term) for term in setting.terms_removed}
    return TermList((term for term in rule.terms if words_of(term) not in removed), added=setting.terms_added)


def _sentence_violations(model: TraceModel, rules: Sequence[SentenceRule]) -> Iterator[tuple[SentenceRule, Violation]]:
    """Element by element, so that each sentence is taken apart once."""
    requirements = model.requirements
    with_terms = [(rule, terms_of(rule, requirements)) for rule in rules]
    for element in model.asked_for:
        sentence = read_sentence(element.text)
        for rule, terms in with_terms:
            for flaw in rule.find(sentence, terms, element):
                message = f"{element.id!r} {flaw.message}"
                yield rule, Violation(subject=element.id, message=message, hint=flaw.hint, at=("text",))
