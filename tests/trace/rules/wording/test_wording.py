"""The sentences that each rule of wording names as breaking and as passing, and all texts that there could be."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.requirements import NeedKind, Priority, StakeholderNeed, Status
from rgss.trace import RULES
from rgss.trace.rules.rule import SentenceRule
from rgss.trace.sentences.sentences import EarsPattern, read_sentence
from rgss.trace.sentences.terms import TermList

SENTENCE_RULES = {rule.id: (rule, TermList(rule.terms)) for rule in RULES if isinstance(rule, SentenceRule)}

NEED = StakeholderNeed(
    id="STK-1",
    kind=NeedKind.DESIGN,
    text="The system shall move.",
    rationale="It waits.",
    source="interview",
    priority=Priority.LOW,
    status=Status.DRAFT,
    owner="cook",
)


def broken_by(text):
    sentence = read_sentence(text)
    return {rule.id: flaw for rule, terms in SENTENCE_RULES.values() for flaw in rule.find(sentence, terms, NEED)}


def examples(kind):
    return [(name, text) for name, (rule, _) in SENTENCE_RULES.items() for text in getattr(rule, kind)]


@pytest.mark.parametrize("rule", SENTENCE_RULES)
def test_every_rule_has_examples(rule):
    definition, _ = SENTENCE_RULES[rule]
    assert definition.breaking
    assert definition.passing


@pytest.mark.parametrize(("rule", "text"), examples("breaking"))
def test_sentences_that_break_a_rule(rule, text):
    assert rule in broken_by(text)


@pytest.mark.parametrize(("rule", "text"), examples("passing"))
def test_sentences_close_to_those_that_break_a_rule(rule, text):
    assert broken_by(text).keys() <= {"wording.ears-keyword"} - {rule}
    assert isinstance(read_sentence(text).pattern, EarsPattern)


@pytest.mark.parametrize("rule", [rule for rule, (definition, _) in SENTENCE_RULES.items() if definition.terms])
def test_each_term_of_a_rule_counts(rule):
    """A term that no sentence could contain would be in the list in vain."""
    definition, terms = SENTENCE_RULES[rule]
    for term in definition.terms:
        said = term.replace("*", "light")
        assert [match.term for match in terms.find(read_sentence(f"The arm shall {said} 3 go."))], term


@pytest.mark.parametrize(
    ("rule", "text", "message"),
    [
        ("wording.R7", "The cell shall have several adequate lights.", "says 'several', 'adequate', which is vague"),
        ("wording.R18", "The arm shall go, shall stop, shall end.", "says 'shall' 3 times"),
        ("wording.R6", "The arm shall weigh 3 to 5 at most 6.", "has the number '5', '6' without a unit"),
        ("wording.R33", "The arm shall lift 3 kg at 1 m/s.", "asks for '3 kg', '1 m/s' exactly"),
        ("wording.R17", "The arm shall lift a cup/plate.", "has 'cup/plate': both, or either?"),
    ],
)
def test_a_message_says_what_was_found(rule, text, message):
    assert broken_by(text)[rule].message == message


def test_a_pure_number_that_is_the_threshold_needs_no_unit(project):
    project.change("P", unit="1").edit("system.yaml", '"800 g"', "0.8")
    assert project.edit("system.yaml", "0.8 kg", "0.8").rules() == []


def test_a_criterion_is_a_target(project):
    project.edit("system.yaml", "at least 0.8 kg", "the cup quickly")
    assert project.rules() == []


@pytest.mark.parametrize(
    ("text", "rules"),
    [
        ("when a cup is ordered, the system shall serve the cup", ["wording.duplicate"]),
        ("When a cup is ordered: the system shall serve the cup.", ["wording.R1", "wording.duplicate"]),
        ("When a cup is ordered, the system shall serve the mug.", []),
    ],
)
def test_the_same_words_are_the_same_requirement(project, text, rules):
    project.edit("system.yaml", "text: The gripper shall lift at least 0.8 kg.", f'text: "{text}"')
    assert project.rules() == rules


@pytest.mark.parametrize("hostile", ["<script>alert(1)</script>", "[link](javascript:x)", "{{7*7}}", "=1+1", "%s%n"])
def test_markup_in_a_text_is_text(project, hostile):
    project.edit("system.yaml", "text: The", f'text: "{hostile} The').edit("system.yaml", "0.8 kg.", '0.8 kg."')
    for finding in project.findings():
        assert "\n" not in finding
    assert set(project.rules()) <= {"wording.R1", "wording.R6", "wording.R17", "wording.R33"}


@pytest.mark.parametrize(
    "text",
    [
        "a" * 9000,
        "shall " * 1500,
        "When " * 1500,
        ", " * 4000,
        "/" * 9000,
        "1 " * 4000,
        "be " * 3000,
        '"' * 9000,
        "The arm shall " + "a/" * 4000,
        "If " + "a, " * 3000 + "then the arm shall stop.",
        "100 " * 2000 + "%",
    ],
)
def test_no_sentence_keeps_a_rule_for_ever(text):
    """A pattern that goes back in powers of the length would not end within a day."""
    assert isinstance(broken_by(text), dict)


@given(st.text(max_size=300), st.sampled_from(["", "The arm shall ", "When ", "If a, then the arm shall "]))
def test_no_text_makes_a_rule_fail(text, start):
    for flaw in broken_by(start + text).values():
        assert flaw.message
        assert flaw.hint
