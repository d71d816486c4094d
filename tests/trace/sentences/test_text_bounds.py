"""Which numbers of a sentence are bounds, and to which side: every phrase of the family."""

from __future__ import annotations

import pytest

from rgss.trace.sentences.bounds import bound_of
from rgss.trace.sentences.comparison_phrases import (
    BETWEEN,
    LOWER_BEFORE,
    LOWER_BEHIND,
    NEGATORS,
    SIGNS,
    UPPER_BEFORE,
    UPPER_BEHIND,
)
from rgss.trace.sentences.quantities import quantities_in

BEFORE = [(phrase, True) for phrase in LOWER_BEFORE] + [(phrase, False) for phrase in UPPER_BEFORE]
BEHIND = [(phrase, True) for phrase in LOWER_BEHIND] + [(phrase, False) for phrase in UPPER_BEHIND]


def only_bound(sentence):
    (quantity,) = quantities_in(sentence)
    return bound_of(sentence, quantity)


@pytest.mark.parametrize(("phrase", "is_lower"), BEFORE)
@pytest.mark.parametrize("spelt", [str, str.upper, lambda phrase: phrase.replace(" ", "\n ")])
def test_phrases_before_a_number(phrase, is_lower, spelt):
    bound = only_bound(f"The arm shall stop in {spelt(phrase)} 5 s.")

    assert bound is not None
    assert bound.is_lower is is_lower
    assert bound.text == " ".join(f"{spelt(phrase)} 5 s".split())


@pytest.mark.parametrize(("phrase", "is_lower"), BEFORE)
@pytest.mark.parametrize("negator", [*NEGATORS, "doesn't"])
def test_a_negator_turns_a_phrase(phrase, is_lower, negator):
    bound = only_bound(f"The time shall {negator} {phrase} 5 s.")

    assert bound is not None
    assert bound.is_lower is not is_lower


@pytest.mark.parametrize("word", BETWEEN)
def test_words_between_negator_and_phrase(word):
    bound = only_bound(f"The time shall not {word} more than 5 s.")

    assert bound is not None
    assert not bound.is_lower


@pytest.mark.parametrize(("phrase", "is_lower"), BEHIND)
@pytest.mark.parametrize("end", [".", ", and open.", " in each trial."])
def test_phrases_behind_a_number(phrase, is_lower, end):
    bound = only_bound(f"The arm shall stop in 5 s {phrase}{end}")

    assert bound is not None
    assert (bound.text, bound.is_lower) == (f"5 s {phrase}", is_lower)


@pytest.mark.parametrize(("sign", "is_lower"), SIGNS.items())
@pytest.mark.parametrize("space", ["", " "])
def test_signs(sign, is_lower, space):
    before, behind = only_bound(f"The time shall be {sign}{space}5 s."), only_bound(f"It shall be 5 s{space}{sign} t.")

    assert before is not None
    assert behind is not None
    assert (before.is_lower, behind.is_lower) == (is_lower, not is_lower)


@pytest.mark.parametrize(
    ("sentence", "is_lower"),
    [
        ("The arm shall take a time not exceeding 5 s.", False),
        ("The force shall not be allowed to exceed 5 N.", False),
        ("The force shall not exceed a value of 5 N.", False),
        ("The force shall exceed a mean value of 5 N.", True),
        ("The speed shall not fall below 5 m/s.", True),
        ("The speed shall never drop to less than 5 m/s.", True),
        ("The mass shall be less-than or equal to 5 kg.", False),
        ("The slip shall stay within the 5 mm.", False),
        ("The cell shall keep 5 kg, or less, in store.", False),
        ("The cell shall keep max. 5 kg in store.", False),
        ("The tool shall move no faster than 250 mm/s.", False),
        ("The tool shall not move faster than 250 mm/s.", False),
        ("The tool shall move faster than 250 mm/s.", True),
        ("The tool shall be no slower than 250 mm/s.", True),
        ("The valve shall close faster than 20 ms.", False),
        ("The valve shall be no slower than 20 ms.", False),
        ("The surface shall not become hotter than 48 degC.", False),
        ("The error shall stay within ± 5 mm.", False),
        ("The grip force shall not decrease below 5 N.", True),
        ("The pressure shall stay below 8 bar.", False),
    ],
)
def test_phrases_as_they_are_written(sentence, is_lower):
    bound = only_bound(sentence)

    assert bound is not None
    assert bound.is_lower is is_lower


@pytest.mark.parametrize(
    "sentence",
    [
        "The gripper shall lift 5 kg.",
        "The arm shall wait for 5 s.",
        "The arm shall lift, above the table, a load of 5 kg.",
        "The gripper shall exceed the other one, and lift 5 kg.",
        "The gripper shall lift up to 5 kg.",
        "The gripper shall carry cups of up to and including 5 kg.",
        "The cell shall work at temperatures down to -10 degC.",
        "The jitter shall be no worse than 5 ms.",
        "The margin shall be 50 % or better.",
        "The accuracy shall be better than 0.5 mm.",
        "The valve shall stay closed below 8 bar.",
        "The compressor shall switch off above 8 bar.",
    ],
)
def test_numbers_that_are_no_bounds(sentence):
    assert only_bound(sentence) is None


def test_what_stands_behind_one_number_may_be_about_the_next():
    sentence = "The cell shall serve in 5 s at least 3 cups."
    first, second = quantities_in(sentence)

    assert bound_of(sentence, first) is None
    assert bound_of(sentence, second).is_lower


@pytest.mark.parametrize(
    ("sentence", "is_lower"),
    [
        ("The force shall not at any time exceed 5 N.", False),
        ("The force shall under no circumstances exceed 5 N.", False),
        ("The force shall not, under any circumstances, exceed 5 N.", False),
        ("The force shall be kept from exceeding 5 N.", False),
        ("The force shall be kept from falling below 5 N.", True),
        ("The gripper shall avoid exceeding 5 N.", False),
        ("The gripper shall not have a mass exceeding 5 kg.", False),
        ("No finger shall exceed 5 N.", False),
        ("No contact force shall be greater than 5 N.", False),
        ("None of the fingers shall exert more than 5 N.", False),
        ("Neither finger shall exert less than 5 N.", True),
        ("The gripper shall at no point in time exert more than 5 N.", False),
        ("The gripper shall under no circumstances apply a force greater than 5 N.", False),
        ("The gripper shall not slip, and exceed 5 N.", True),
    ],
)
def test_distant_negators(sentence, is_lower):
    bound = only_bound(sentence)

    assert bound is not None
    assert bound.is_lower is is_lower


def test_a_negator_that_may_be_about_something_else_leaves_the_side_open():
    assert only_bound("The robot shall not drop cups of more than 5 N.") is None
    assert only_bound("No finger shall touch cups of more than 5 N.") is None


def test_both_ends_of_a_range():
    low, high = quantities_in("The speed shall lie between 0.5 m/s and 1 m/s.")
    sentence = "The speed shall lie between 0.5 m/s and 1 m/s."

    assert bound_of(sentence, low).is_lower
    assert not bound_of(sentence, high).is_lower
