"""Rules of settings and exemptions: each names an existing rule and has an effect."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from typing import NamedTuple

from rgss.findings import Severity
from rgss.requirements import RequirementSet, RuleSetting, nearest
from rgss.trace.rules.rule import ConfigurationRule, Rule, SentenceRule, Violation
from rgss.trace.sentences import is_literal, words_of

UNKNOWN_EXEMPTION = ConfigurationRule(
    id="exempt.unknown-rule",
    of_elements=False,
    severity=Severity.ERROR,
    explanation="An element is exempt from existing rules that allow exemptions.",
)
UNUSED_EXEMPTION = ConfigurationRule(
    id="exempt.unused",
    of_elements=False,
    severity=Severity.WARNING,
    explanation=(
        "An exemption exempts something: the element would break the rule otherwise. One that is not needed any "
        "more would hide the next violation."
    ),
)
UNKNOWN_SETTING = ConfigurationRule(
    id="settings.unknown-rule",
    of_elements=False,
    severity=Severity.ERROR,
    explanation="rules.yaml sets existing rules that can be set.",
)
UNUSED_SETTING = ConfigurationRule(
    id="settings.unused",
    of_elements=False,
    severity=Severity.WARNING,
    explanation=(
        "A setting changes something: the severity is another one than the rule has, a term that is added was not "
        "there, one that is removed was."
    ),
)

RULES: tuple[ConfigurationRule, ...] = (UNKNOWN_EXEMPTION, UNUSED_EXEMPTION, UNKNOWN_SETTING, UNUSED_SETTING)


class Exempted(NamedTuple):
    """Exemption by its subject."""

    element: str
    rule: str


def setting_violations(
    requirements: RequirementSet, rules: Mapping[str, Rule]
) -> Iterator[tuple[ConfigurationRule, Violation]]:
    """Violations by the project's settings."""
    for name, setting in requirements.settings.items():
        place, rule = requirements.setting_places[name], rules.get(name)
        if rule is None:
            message, hint = f"there is no rule {name!r}", nearest(name, rules)
            yield UNKNOWN_SETTING, Violation(subject=place, message=message, hint=hint, at=(), at_key=True)
            continue
        if rule.fixed:
            message = f"rule {name!r} cannot be set: what breaks it cannot be decided"
            yield UNKNOWN_SETTING, Violation(subject=place, message=message, hint="remove it", at=(), at_key=True)
            continue
        if setting == RuleSetting(reason=setting.reason):
            message = f"the setting of {name!r} changes nothing"
            yield UNUSED_SETTING, Violation(subject=place, message=message, hint="remove it", at=(), at_key=True)
        if setting.severity is rule.severity:
            message = f"the severity of {name!r} is {rule.severity.value} anyway"
            yield UNUSED_SETTING, Violation(subject=place, message=message, hint="remove it", at=("severity",))
        for message, at in _idle_terms(setting, rule):
            yield UNUSED_SETTING, Violation(subject=place, message=message, hint="remove it", at=at)


def exemption_violations(
    requirements: RequirementSet, rules: Mapping[str, Rule], checked: frozenset[str], used: frozenset[Exempted]
) -> Iterator[tuple[ConfigurationRule, Violation]]:
    """Violations by the exemptions of the elements.

    Args:
        requirements: The requirements with the exemptions.
        rules: Every rule by its id.
        checked: Ids of the rules that were checked; of any other rule it is unknown whether it is broken.
        used: The exemptions that exempted something.
    """
    for element in requirements.elements:
        for index, exemption in enumerate(element.exempt):
            rule, at = rules.get(exemption.rule), ("exempt", index, "rule")
            if rule is None:
                message, hint = f"there is no rule {exemption.rule!r}", nearest(exemption.rule, rules)
            elif not rule.allows_exemption:
                message, hint = f"no element can be exempt from {exemption.rule!r}", "remove it"
            elif exemption.rule in checked and Exempted(element.id, exemption.rule) not in used:
                message = f"{element.id!r} is exempt from {exemption.rule!r}, which it does not break"
                yield UNUSED_EXEMPTION, Violation(subject=element.id, message=message, hint="remove it", at=at)
                continue
            else:
                continue
            yield UNKNOWN_EXEMPTION, Violation(subject=element.id, message=message, hint=hint, at=at)


def _idle_terms(setting: RuleSetting, rule: Rule) -> Iterator[tuple[str, tuple[str, int]]]:
    """Terms that a setting adds or removes without effect, and their locations in it."""
    takes_terms = isinstance(rule, SentenceRule) and bool(rule.meaning)
    own = {words_of(term) for term in rule.terms} if isinstance(rule, SentenceRule) else set()
    for index, term in enumerate(setting.terms_added):
        is_widened = isinstance(rule, SentenceRule) and term in rule.widened_by
        if not takes_terms or not (is_literal(term) or (words_of(term) and not term.startswith("*"))):
            yield f"rule {rule.id!r} looks for no such terms", ("terms_added", index)
        elif _is_own(term, own) and not is_widened:
            yield f"rule {rule.id!r} has the term {term!r} already", ("terms_added", index)
    for index, term in enumerate(setting.terms_removed):
        if words_of(term) not in own:
            yield f"rule {rule.id!r} does not have the term {term!r}", ("terms_removed", index)


def _is_own(term: str, own: Collection[tuple[str, ...]]) -> bool:
    """True if a rule has the words of a term, whatever their capitals; a character beside them makes it another."""
    return words_of(term) in own and not is_literal(term.lower())
