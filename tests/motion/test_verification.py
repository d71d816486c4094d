"""Paths verified more finely than their search checked them, and what happens to those that are not valid."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.evidence.records.outcomes import PlanOutcome
from rgss.motion import OnUnverified, PlannerSettings, plan
from rgss.motion.verification import verified
from tests.fixtures.planned_paths import outcome_within, path_states

pytestmark = pytest.mark.engine

FINE_RAD, COARSE_RAD = 0.02, 0.6


@pytest.fixture
def coarse(through_the_doorway):
    """Searched so coarsely that motions jump over the wall, 0.3 rad thick."""
    return replace(through_the_doorway, resolution_rad=COARSE_RAD, verification_resolution_rad=FINE_RAD)


@pytest.fixture
def planned(coarse, clock, wall):
    def run(seed, how, *, problem=coarse, planner="RRT", **changes):
        values = {"budget_checks": 200_000, "simplification_checks": 0, "clock": clock}
        return plan(problem, wall, planner, seed=seed, on_unverified=how, **(values | changes))

    return run


def test_a_path_that_is_not_valid_is_a_failure_of_its_own(planned):
    outcomes = [planned(seed, OnUnverified.FAIL) for seed in range(12)]
    failed = [one for one in outcomes if one.outcome is PlanOutcome.NOT_VERIFIED]
    assert failed
    for one in failed:
        assert (one.path, one.simplification_checks) == (None, 0)
        assert one.search_time_s == pytest.approx(one.checks * 0.001)


@pytest.mark.parametrize("planner", ["RRT", "STRIDE", "RRTConnect", "PRM"])
def test_a_repaired_path_is_valid_and_every_check_is_charged(planned, coarse, wall, planner):
    repaired = 0
    for seed in range(8, 18):
        wall.calls = 0
        one = planned(seed, OnUnverified.REPAIR, planner=planner)
        assert one.checks == wall.calls - 2
        assert one.outcome is PlanOutcome.SOLVED
        points = one.path.points_rad
        assert (tuple(points[0]), tuple(points[-1])) == (coarse.start, coarse.goal)
        assert all(map(wall.is_valid, path_states(points, FINE_RAD)))
        assert one.verification_checks > 0
        repaired += one.repairs > 0
        fails = planned(seed, OnUnverified.FAIL, planner=planner).outcome is PlanOutcome.NOT_VERIFIED
        assert fails == (one.repairs > 0)
    assert repaired


@pytest.mark.parametrize("how", OnUnverified)
def test_a_smaller_budget_is_read_off_a_larger_one(planned, how):
    kinds = set()
    for seed in range(8):
        shared = planned(seed, how)
        kinds.add(shared.outcome)
        for budget in (0, shared.checks // 2, shared.checks - 1, shared.checks, shared.checks + 1):
            alone = planned(seed, how, budget_checks=budget)
            assert alone.outcome is outcome_within(shared, budget), (seed, budget)
    assert (PlanOutcome.NOT_VERIFIED in kinds) == (how is OnUnverified.FAIL)


def test_a_motion_that_cannot_be_repaired_spends_the_budget(planned, coarse):
    for seed in range(12):
        found = planned(seed, OnUnverified.FAIL)
        if found.outcome is PlanOutcome.NOT_VERIFIED:
            one = planned(seed, OnUnverified.REPAIR, budget_checks=found.checks + 5)
            assert (one.outcome, one.checks) == (PlanOutcome.BUDGET_SPENT, found.checks + 5)
            return
    pytest.fail("no path to repair")


def test_the_shortened_path_is_valid_at_the_verification_too(planned, wall):
    for seed in range(4):
        one = planned(seed, OnUnverified.REPAIR, simplification_checks=1000)
        assert all(map(wall.is_valid, path_states(one.path.points_rad, FINE_RAD)))


def test_the_same_resolution_for_both_changes_nothing(planned, through_the_doorway):
    same = replace(through_the_doorway, verification_resolution_rad=through_the_doorway.resolution_rad)
    for seed in range(3):
        one, other = (planned(seed, OnUnverified.REPAIR, problem=problem) for problem in (through_the_doorway, same))
        assert (one.checks, one.path.points_rad.tobytes()) == (other.checks, other.path.points_rad.tobytes())
        assert other.verification_checks == other.repairs == 0


def test_an_optimizing_planner_repairs_too(planned, wall):
    settings = PlannerSettings(algorithm="RRTstar", parameters=(("range", 1.0),))
    one = planned(1, OnUnverified.REPAIR, planner=settings)
    assert all(map(wall.is_valid, path_states(one.path.points_rad, FINE_RAD)))


def test_verification_finds_what_lies_between_corners(wall):
    corners = np.array([[-1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]])
    assert not verified(corners, wall, resolution_rad=0.02).is_valid
    assert verified(corners + np.eye(6)[1], wall, resolution_rad=0.02).is_valid


def test_a_resolution_of_nothing(through_the_doorway):
    with pytest.raises(MotionError, match="the resolution must be above 0 rad, got 0 rad"):
        replace(through_the_doorway, verification_resolution_rad=0.0)
