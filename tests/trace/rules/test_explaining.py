"""The rules in words, and their page in the documentation."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.errors import DefinitionError
from rgss.trace import FAMILIES, RULES, rule_of
from rgss.trace.rules.explaining import rule_as_json, rule_lines, rules_markdown
from rgss.trace.rules.rule import SentenceRule

PAGE = Path(__file__).parents[3] / "docs" / "rules.md"


def test_the_page_is_current():
    """Written by ``rgss check --explain --markdown > docs/rules.md``."""
    assert PAGE.read_text(encoding="utf-8") == rules_markdown()


def test_the_page_has_every_rule_once_and_every_family():
    page = rules_markdown()

    for rule in RULES:
        assert page.count(f"| `{rule.id}` | {rule.severity.value} | {rule.explanation}") == 1
    for family in FAMILIES:
        assert page.count(f"## {family.title}\n") == 1
    assert not any("|" in rule.explanation for rule in RULES)


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_an_explanation_says_what_why_when_and_how(rule):
    lines = list(rule_lines(rule))
    text = " ".join(" ".join(lines).split())

    assert lines[0] == f"{rule.id} ({rule.severity.value})"
    assert rule.explanation in text
    assert "Checked " in text
    # A terminal breaks long lines; here each statement is one.
    assert not any(line.startswith("   ") for line in lines)
    assert rule.fixed == ("can neither be set" in text)
    assert rule.fixed or "To switch it off" in text
    assert rule.allows_exemption == ("To exempt one element" in text)
    if isinstance(rule, SentenceRule):
        assert all(term in text for term in rule.terms)
        assert ("terms_added" in text) == bool(rule.meaning)


def test_rules_are_found_by_id():
    assert rule_of("wording.r7").id == "wording.R7"
    assert rule_as_json(rule_of("trace.cycle"))["configurable"] is False
    with pytest.raises(DefinitionError, match=r"there is no rule 'wording.R77' \(did you mean 'wording.R7'\?\)"):
        rule_of("wording.R77")
    with pytest.raises(
        DefinitionError, match=r"'document\.syntax' is about reading files; its findings say what is wrong and where"
    ):
        rule_of("document.syntax")
    with pytest.raises(DefinitionError, match=r"there is no rule '§' \('rgss check --explain' lists all rules\)"):
        rule_of("§")


@pytest.mark.parametrize(("short", "whole"), [("R9", "wording.R9"), ("r9", "wording.R9"), ("wording.r9", "wording.R9")])
def test_the_name_behind_the_dot_is_enough_where_only_one_rule_has_it(short, whole):
    assert rule_of(short).id == whole


def test_a_name_of_several_rules_is_not_enough():
    with pytest.raises(DefinitionError, match="'cycle' is the name of several rules") as caught:
        rule_of("cycle")
    assert caught.value.hint.startswith("write ")
    assert " or " in caught.value.hint
