"""Names of assumptions and their alternatives in words."""

from __future__ import annotations

from pathlib import Path

import pytest

from rgss.decision.assumptions.names import alternative_in_words, name_in_words, value_in_words
from rgss.decision.assumptions.questions import questions_of
from rgss.decision.what_if import model_settings
from rgss.decision.what_if.numbers import model_numbers
from rgss.studies import load_project


@pytest.fixture(scope="module")
def reference():
    return load_project(Path(__file__).parents[3])


def test_every_assumption_that_may_be_questioned_has_a_name_without_symbols(reference):
    names = [*model_settings(reference), *(one.id for one in model_numbers(reference))]
    titles = {name: name_in_words(reference, name) for name in names}

    assert len(titles) > 100
    assert [title for title in titles.values() if "_" in title or not title[:1].isupper()] == []
    assert [name for name, title in titles.items() if name == title] == []


def test_names_are_those_of_the_files(reference):
    assert name_in_words(reference, "reading.F_max") == "Gripper force"
    assert name_in_words(reference, "weight.S") == "Weight of Task success score"
    assert name_in_words(reference, "planning.planners.TRRT.goal_bias") == "Goal bias of TRRT"
    assert name_in_words(reference, "planning.planners.range") == "Range of all planners"
    assert name_in_words(reference, "SYS-012.threshold") == "Limit of SYS-012"


@pytest.mark.parametrize(
    ("name", "alternative", "words"),
    [
        ("reading.F_max", "force_of_the_hand", "read as “force of the hand”"),
        ("prices", "1.5", "multiplied by 1.5"),
        ("prices", "0", "0"),
        ("uncertainty.nominal", "true", "yes"),
        ("planning.charge_per_check", "0.5 ms", "0.5 ms"),
    ],
)
def test_alternatives_in_words(name, alternative, words):
    assert alternative_in_words(name, alternative) == words


def test_what_is_no_single_number_is_as_stated():
    assert (value_in_words(""), value_in_words("false"), value_in_words("4 s")) == ("as stated", "no", "4 s")


def test_the_questions_of_a_study_have_them(reference):
    questions = questions_of(reference)
    assert {one.title for one in questions} >= {
        "Maximum acceptable payload, simulated",
        "Goal bias of all planners",
        "All assumed prices of components",
    }
    assert [one.about for one in questions if not one.title] == []
