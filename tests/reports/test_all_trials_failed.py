"""A decision without a successful trial: what is unknown is not called missed, and the task must become easier."""

from __future__ import annotations

import dataclasses

import pytest

from rgss.assessment.measuring import measure_variants
from rgss.decision.sensitivity import FlatRemedy, FlatWeight
from rgss.decision.study_decision import decide_study
from rgss.reports.decision.flat_sentences import flat_sentences
from rgss.reports.decision.report_conflicts import conflict_part, conflict_reasons
from rgss.reports.decision.sentences import cautions
from rgss.reports.decision.text.conflicts import conflict_lines


@pytest.fixture(scope="module")
def made(shipped, filled, record_of):
    store = filled(shipped, lambda spec: record_of(spec, success=False))
    measured = measure_variants(shipped, store)
    assert all(entry.estimates["t_e"].value is None for entry in measured)
    assert all(entry.estimates["S"].value == 0.0 for entry in measured)
    return decide_study(shipped, measured, evidence="evidence.sqlite")


def test_a_requirement_without_a_value_is_not_said_to_be_missed(made):
    conflicts = made.decision.conflicts
    assert "SYS-024" not in conflicts.unmeasured
    assert "SYS-005" in conflicts.unmeasured
    reasons = list(conflict_reasons(made.decision))
    assert any(one.startswith("Nothing meets SYS-024 (") and "resamples" in one for one in reasons)
    (unknown,) = [one for one in reasons if "known to meet SYS-005 (" in one]
    assert "Its verdicts are inconclusive" in unknown
    assert "resamples" not in unknown
    nearest = reasons[-1]
    assert "SYS-005" not in nearest.split("has no value for")[0]
    rows = {tuple(one["requirements"]): one["unmeasured"] for one in conflict_part(made.decision)["conflicts"]}
    assert rows["SYS-005",] is True
    assert rows["SYS-024",] is False
    lines = list(conflict_lines(made.decision))
    assert next(line for line in lines if line.startswith("SYS-005 alone")).endswith("no value")


def test_the_caution_asks_for_an_easier_task_and_names_no_deciding_weights(made):
    found = list(cautions(made))
    assert any("No variant has a value of t_e, so that none has a weighted value" in one for one in found)
    (success,) = [one for one in found if one.startswith("S is worth the same")]
    assert "make the task easier" in success
    assert "harder" not in success
    assert not any("what decides is" in one for one in found)


@pytest.mark.parametrize(
    ("remedy", "wanted"), [(FlatRemedy.EASE_THE_TASK, "easier"), (FlatRemedy.VARY_THE_WORLD, "harder")]
)
def test_the_task_becomes_easier_at_the_worst_value_and_harder_above_it(remedy, wanted):
    at = 0.0 if remedy is FlatRemedy.EASE_THE_TASK else 1.0
    flat = FlatWeight(
        measure="S",
        unit="1",
        weight=0.2,
        low=at,
        high=at,
        all_low=at,
        all_high=at,
        among_feasible=False,
        remedy=remedy,
        effective=(),
    )
    (sentence,) = flat_sentences((flat,))
    assert wanted in sentence


def test_weights_decide_only_where_the_program_has_some():
    flat = FlatWeight(
        measure="S",
        unit="1",
        weight=0.2,
        low=1.0,
        high=1.0,
        all_low=1.0,
        all_high=1.0,
        among_feasible=False,
        remedy=FlatRemedy.VARY_THE_WORLD,
        effective=(("t", 1.0),),
    )
    assert list(flat_sentences((flat,)))[1] == (
        "The weight of 0.2 separates nothing; t decides alone, and without it the order is the same."
    )
    several = dataclasses.replace(flat, effective=(("t", 0.75), ("c", 0.25)))
    assert list(flat_sentences((several, several)))[-1] == (
        "Weights of 0.4 in all separate nothing; what decides is t 0.75, c 0.25, and without the others the order is "
        "the same."
    )
    assert len(list(flat_sentences((flat,), decides=False))) == 1
