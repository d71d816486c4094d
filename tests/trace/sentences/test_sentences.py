"""The patterns of EARS, and what is none of them."""

from __future__ import annotations

import pytest

from rgss.trace.sentences.condition_words import KEYWORDS, OPENINGS, ClauseKind
from rgss.trace.sentences.sentences import EarsPattern, read_sentence
from rgss.trace.sentences.terms import TermList


@pytest.mark.parametrize(
    ("text", "pattern", "kinds", "subject", "response"),
    [
        ("The gripper shall open.", "ubiquitous", [], "The gripper", "open."),
        ("The arm shall at all times stay.", "ubiquitous", [], "The arm", "at all times stay."),
        ("The arm shall, on loss of power, stop.", "ubiquitous", [], "The arm", ", on loss of power, stop."),
        ("The force shall in no case exceed 5 N.", "ubiquitous", [], "The force", "in no case exceed 5 N."),
        ("Each finger joint shall stay closed.", "ubiquitous", [], "Each finger joint", "stay closed."),
        ("While it rains, the arm shall stay.", "state", ["while"], "the arm", "stay."),
        ("When a cup is seen, the arm shall stop.", "event", ["when"], "the arm", "stop."),
        ("Where a camera is fitted, the cell shall record.", "option", ["where"], "the cell", "record."),
        ("If a cup slips, then the gripper shall close.", "unwanted", ["if"], "the gripper", "close."),
        ("While a, when b, the arm shall stop.", "complex", ["while", "when"], "the arm", "stop."),
        ("When a, if b, then the arm shall stop.", "complex", ["when", "if"], "the arm", "stop."),
        ("Where a, while b, if c, then the arm shall stop.", "complex", ["where", "while", "if"], "the arm", "stop."),
        ("When a, b, or c is seen, the arm shall stop.", "event", ["when"], "the arm", "stop."),
        ("WHEN a cup is seen,\n  the arm SHALL\n  stop.", "event", ["when"], "the arm", "stop."),
    ],
)
def test_patterns_are_recognised(text, pattern, kinds, subject, response):
    sentence = read_sentence(text)

    assert sentence.pattern is EarsPattern(pattern)
    assert [clause.kind for clause in sentence.conditions] == [ClauseKind(kind) for kind in kinds]
    assert (sentence.subject, sentence.response, sentence.flaw) == (subject, response, "")


@pytest.mark.parametrize(
    ("text", "flaw"),
    [
        ("The arm should stop.", "has no 'shall', but 'should'"),
        ("The arm stops.", "has no 'shall'"),
        ("", "has no 'shall'"),
        ("The arm shall.", "says nothing after 'shall'"),
        ("The arm shall the cup.", "has no verb after 'shall', but 'the'"),
        ("Shall stop.", "has no subject before 'shall'"),
        ("There shall be a cup.", "has no subject before 'shall'"),
        ("When a cup is seen, shall stop.", "has no subject before 'shall'"),
        ("If a cup slips, then shall stop.", "has no subject before 'shall'"),
        ("When a cup slips the gripper shall close.", "begins with 'When', but has no comma"),
        ("While a, when b the gripper shall close.", "has no comma between its last condition and its subject"),
        ("If a cup slips the gripper shall close.", "begins with 'If', but has no comma"),
        ("The shall stop.", "has no subject before 'shall'"),
        ("When a cup is seen, the shall stop.", "has no subject before 'shall'"),
        ("If a cup slips, then the shall stop.", "has no subject before 'shall'"),
        ("Upon a, when b the gripper shall close.", "has no comma between its last condition and its subject"),
        ("The arm shall at all times.", "has no verb after 'shall', but 'at'"),
        ("The arm shall, on loss of power, the brake.", "has no verb after 'shall', but 'the'"),
        ("The arm shall: the cup.", "has no verb after 'shall', but 'the'"),
    ],
)
def test_what_has_no_pattern_says_why(text, flaw):
    sentence = read_sentence(text)

    assert sentence.pattern is None
    assert sentence.flaw.startswith(flaw)


NEGATED = {
    "before": "While … not",
    "except": "Where … not",
    "immediately before": "While … not",
    "prior to": "While … not",
    "unless": "If … not",
    "until": "While … not",
    "without": "While … not",
}


@pytest.mark.parametrize(
    ("opening", "kind"),
    [(" ".join(words), kind) for words, kind in OPENINGS.items() if words[0] not in KEYWORDS],
)
def test_words_that_mean_the_same_as_a_keyword(opening, kind):
    sentence = read_sentence(f"{opening.capitalize()} x, the gripper shall close.")

    assert (sentence.flaw, sentence.subject, sentence.response) == ("", "the gripper", "close.")
    assert [clause.kind for clause in sentence.conditions] == [kind]
    assert sentence.departure == (
        f"begins a condition with {opening.capitalize()!r}, for which EARS has "
        f"{NEGATED.get(opening, kind.value.capitalize())!r}"
    )


@pytest.mark.parametrize(
    ("text", "pattern", "departure"),
    [
        ("If a cup slips, the gripper shall close.", "unwanted", "says 'if' without 'then'"),
        ("If a cup slips, then the gripper shall close.", "unwanted", ""),
        ("If a cup slips then the gripper shall close.", "unwanted", ""),
        (
            "The gripper shall open when a cup is seen.",
            "ubiquitous",
            "has a condition behind its response, with 'when'",
        ),
        ("The gripper shall stay closed UNLESS a cup is seen.", "ubiquitous", "has a condition behind its response"),
        ("When a cup slips, if b, the gripper shall close.", "complex", "says 'if' without 'then'"),
        ("When a, b or, in doubt, c is seen, the gripper shall close.", "event", ""),
        ("In the event of a slip, the gripper shall close.", "unwanted", "begins a condition with 'In the event of'"),
        ("Upon a slip, the arm shall: a) stop; b) open the gripper.", "event", "begins a condition with 'Upon'"),
        ("The arm shall - stop.", "ubiquitous", ""),
    ],
)
def test_conditions_in_other_words(text, pattern, departure):
    sentence = read_sentence(text)

    assert (sentence.pattern, sentence.flaw) == (EarsPattern(pattern), "")
    assert sentence.departure.startswith(departure)
    assert bool(sentence.departure) is bool(departure)


@pytest.mark.parametrize(
    "response",
    [
        "detect when a cup is seen",
        "close if necessary",
        "close if at all possible",
        "wait for a short while after that",
        "hold the cup as if it were full",
        "hold the cup even when the power fails",
        "log the time when a cup is seen",
        "report whether a cup is seen",
    ],
)
def test_words_of_conditions_that_open_none(response):
    assert read_sentence(f"The gripper shall {response}.").departure == ""


def test_a_subject_may_be_set_off_by_commas():
    assert read_sentence("The arm, with its base, shall stop.").pattern is EarsPattern.UBIQUITOUS


@pytest.mark.parametrize(
    ("text", "sentences"),
    [
        ("The arm shall stop.", 1),
        ("The arm shall stop. This is safe.", 2),
        ("The arm shall lift 0.5 kg at 1.5 m/s.", 1),
        ("The arm shall use tools, e.g. Grippers.", 1),
        ("The arm of Robot No. 5 shall stop.", 1),
        ("The arm shall meet the standard of the U.S. Army.", 1),
        ('The arm shall end with "Done. Next." on the display.', 1),
    ],
)
def test_sentences_are_counted(text, sentences):
    assert read_sentence(text).sentences == sentences


def test_what_is_quoted_is_no_wording():
    sentence = read_sentence('The arm shall show "it shall not be all, etc." or “never 5 kg” or `TBD`.')

    assert len(sentence.shalls) == 1
    assert sentence.quantities == ()
    assert sentence.words == {"the", "arm", "shall", "show", "or"}


def test_places_are_those_of_the_text_on_one_line():
    sentence = read_sentence("The arm\n  shall  lift.")

    assert sentence.text == "The arm shall lift."
    assert [sentence.text[token.start : token.end] for token in sentence.tokens] == ["The", "arm", "shall", "lift"]


@pytest.mark.parametrize(
    ("term", "text", "found"),
    [
        ("all", "of all cups", True),
        ("all", "ALL cups", True),
        ("asap", "stop ASAP", True),
        ("asap", "stop Asap.", True),
        ("as soon as possible", "AS SOON AS possible", True),
        ("and", "a AND b", False),
        ("safe", "to SAFE mode", False),
        ("all", "allow all-terrain shall", False),
        ("it", "it is", True),
        ("it", "the IT is", False),
        ("as far as possible", "as far  as\npossible", True),
        ("as far as possible", "as far, as possible", False),
        ("e.g", "cups, e.g. mugs", True),
        ("TBD", "TBD", True),
        ("TBD", "tbd", False),
        ("high-speed", "a high-speed arm", True),
        ("High-Speed", "a high-speed arm", True),
        ("high-speed", "a high speed arm", True),
        ("high speed", "a High-Speed arm", True),
        ("user-friendly", "is user\u2011friendly", True),
        ("high speed", "a high, speed", False),
    ],
)
def test_terms_are_found_as_words(term, text, found):
    assert [match.term for match in TermList([term]).find(read_sentence(text))] == ([term] if found else [])


def test_a_star_is_any_word():
    terms = TermList(["as * as possible", "as much as possible", "easy to *"])

    def found(text):
        return [match.term for match in terms.find(read_sentence(text))]

    assert found("As light as possible and as much as possible") == ["as light as possible", "as much as possible"]
    assert found("as light, as possible") == []
    assert found("as as possible") == []
    assert found("EASY to Use") == ["easy to use"]
    assert found("easy to") == []


def test_the_longest_of_several_terms_is_found():
    matches = TermList(["as far as", "as far as possible", "possible"]).find(read_sentence("as far as possible"))

    assert [match.term for match in matches] == ["as far as possible"]


def test_terms_are_found_from_a_place_on():
    sentence = read_sentence("all cups and all plates")

    assert len(list(TermList(["all"]).find(sentence))) == 2
    assert len(list(TermList(["all"]).find(sentence, start=1))) == 1
