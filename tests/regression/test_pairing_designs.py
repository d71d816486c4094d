"""Pairing of a baseline's designs with present ones whose numbers moved."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.regression.pairing_designs import paired_by_levels

NINE, TEN = {"speed": "slow", "planner": "rrt"}, {"speed": "fast", "planner": "rrt"}
OTHER = {"speed": "fast", "planner": "trrt"}


@pytest.fixture
def with_levels(baseline):
    """The baseline of variants 9 and 10 with their levels."""
    run = replace(baseline.runs["planning"], designs={"9": NINE, "10": TEN})
    return replace(baseline, runs={"planning": run})


def test_the_same_numbers(with_levels):
    paired = paired_by_levels(with_levels, {9: NINE, 10: TEN, 11: OTHER})
    assert paired.baseline is with_levels
    assert paired.notes == ()


def test_swapped_levels(with_levels):
    """Every value moves with its design, and so do the choice and the front."""
    paired = paired_by_levels(with_levels, {9: TEN, 10: NINE})
    before, now = with_levels.runs["planning"], paired.baseline.runs["planning"]
    for old, new in (("9", "10"), ("10", "9")):
        assert now.fingerprints[new] == before.fingerprints[old]
        assert now.inputs[new] == before.inputs[old]
        assert now.designs[new] == before.designs[old]
        assert now.values["time_s"]["lift"][new] == before.values["time_s"]["lift"][old]
        assert paired.baseline.decision.verdicts[new] == with_levels.decision.verdicts[old]
        assert paired.baseline.decision.measures[new] == with_levels.decision.measures[old]
    assert (paired.baseline.decision.chosen, paired.baseline.decision.pareto) == (10, (10,))
    assert paired.former == {10: 9, 9: 10}
    assert paired.notes == (
        "designs have other numbers than in the baseline and are paired by their levels: 9 is 10, 10 is 9",
    )


def test_the_order_of_the_factors_does_not_count(with_levels):
    paired = paired_by_levels(with_levels, {1: dict(reversed(NINE.items())), 2: TEN})
    assert paired.baseline.runs["planning"].variants == (1, 2)


def test_a_design_that_is_gone_whose_number_another_has_now(with_levels):
    """Variant 10 moved to 9, and variant 9 has no counterpart."""
    paired = paired_by_levels(with_levels, {9: TEN, 10: OTHER})
    assert paired.baseline.runs["planning"].variants == (-9, 9)
    assert paired.baseline.decision.chosen == -9
    assert set(paired.baseline.decision.verdicts) == {"-9", "9"}


def test_levels_with_other_names_are_paired_by_number(with_levels):
    paired = paired_by_levels(with_levels, {9: {**NINE, "speed": "sluggish"}, 10: TEN})
    assert paired.baseline is with_levels
    assert paired.notes == ("no design has the levels that the baseline has for 9; paired by number",)


def test_a_baseline_without_levels_is_paired_by_number(baseline):
    paired = paired_by_levels(baseline, {9: TEN, 10: NINE})
    assert paired.baseline is baseline
    assert paired.notes == ()
