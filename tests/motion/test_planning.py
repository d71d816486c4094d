"""Planning: outcomes, budgets that are beginnings of larger ones, and the same result every time."""

from __future__ import annotations

import hashlib
import json
import random
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.evidence.records.outcomes import PlanOutcome
from rgss.motion import (
    SOURCE_PLANNERS,
    ClockKind,
    PlannerSettings,
    PlanningClock,
    available_planners,
    path_length,
    plan,
)
from tests.fixtures.planned_paths import outcome_within, path_states
from tests.fixtures.processes import PATIENCE_S

pytestmark = pytest.mark.engine


@pytest.fixture
def planned(through_the_doorway, clock, wall):
    """Plans through the doorway; a call takes what differs."""

    def run(planner="RRT", *, problem=through_the_doorway, validity=wall, **changes):
        values = {"seed": 0, "budget_checks": 20_000, "simplification_checks": 0, "clock": clock}
        return plan(problem, validity, planner, **(values | changes))

    return run


def fields(result):
    path = None if result.path is None else result.path.points_rad.tobytes()
    return result.outcome, result.checks, result.simplification_checks, result.search_time_s, path


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
@pytest.mark.parametrize("seed", range(4))
def test_a_path_leads_from_start_to_goal_and_is_valid_throughout(planned, through_the_doorway, wall, planner, seed):
    result = planned(planner, seed=seed, simplification_checks=300)
    points = result.path.points_rad
    assert result.outcome is PlanOutcome.SOLVED
    assert tuple(points[0]) == through_the_doorway.start
    assert tuple(points[-1]) == through_the_doorway.goal
    assert all(map(wall.is_valid, path_states(points, through_the_doorway.resolution_rad)))
    assert np.all(np.abs(points) <= 2.0)


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_without_simplification_the_path_is_valid_too(planned, through_the_doorway, wall, planner):
    for seed in range(5):
        result = planned(planner, seed=seed)
        assert all(map(wall.is_valid, path_states(result.path.points_rad, through_the_doorway.resolution_rad)))
        assert result.simplification_checks == 0


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_every_check_is_counted(planned, wall, planner):
    result = planned(planner, seed=3, simplification_checks=200)
    # Start and goal are looked at once more before the search, uncounted.
    assert result.checks + result.simplification_checks + 2 == wall.calls
    assert result.search_time_s == pytest.approx(result.checks * 0.001)


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_a_smaller_budget_is_read_off_a_larger_search(planned, planner):
    boundaries = 0
    for seed in range(15):
        shared = planned(planner, seed=seed, simplification_checks=100)
        assert shared.outcome is PlanOutcome.SOLVED
        exact = shared.checks
        for budget in {0, 1, exact // 2, exact - 1, exact, exact + 1, 2 * exact}:
            alone = planned(planner, seed=seed, simplification_checks=100, budget_checks=budget)
            assert alone.outcome is outcome_within(shared, budget), (seed, budget)
            if alone.outcome is PlanOutcome.SOLVED:
                assert fields(alone) == fields(shared)
            else:
                assert (alone.checks, alone.path, alone.simplification_checks) == (budget, None, 0)
                assert alone.search_time_s == pytest.approx(budget * 0.001)
            boundaries += budget == exact - 1
    assert boundaries == 15


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_neither_budget_nor_clock_changes_what_is_found(planned, planner):
    one = planned(planner, seed=2, simplification_checks=300)
    other = planned(planner, seed=2, simplification_checks=300, budget_checks=50_000, clock=PlanningClock(charge_s=0.5))
    assert np.array_equal(one.path.points_rad, other.path.points_rad)
    assert one.checks == other.checks


def test_seeds_give_different_searches(planned):
    assert len({planned(seed=seed).checks for seed in range(10)}) > 5


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_the_simplification_does_not_depend_on_the_search(planned, planner):
    raw = planned(planner, seed=4)
    for budget in (100, 400):
        result = planned(planner, seed=4, simplification_checks=budget)
        assert result.checks == raw.checks
        assert path_length(result.path.points_rad) <= path_length(raw.path.points_rad)


JOBS = [(planner, seed, budget) for planner in SOURCE_PLANNERS for seed in range(5) for budget in (300, 2000)]


def _digests(planned, jobs):
    return {
        job: hashlib.sha256(
            repr(fields(planned(job[0], seed=job[1], budget_checks=job[2], simplification_checks=150))).encode()
        ).hexdigest()
        for job in jobs
    }


def test_the_order_of_calls_changes_nothing(planned):
    first = _digests(planned, JOBS)
    for seed in range(3):
        order = list(JOBS)
        random.Random(seed).shuffle(order)  # noqa: S311 - any order will do
        assert _digests(planned, order) == first


ELSEWHERE = """
import hashlib, json, sys
sys.path.insert(0, sys.argv[1])
import conftest
from rgss.motion import SOURCE_PLANNERS, PlanningClock, PlanningProblem, plan
problem = PlanningProblem(**json.loads(sys.argv[2]))
for planner in reversed(SOURCE_PLANNERS):
    result = plan(problem, conftest.Wall(), planner, seed=7, budget_checks=20000, simplification_checks=300,
                  clock=PlanningClock(charge_s=0.001))
    print(planner, result.checks, result.simplification_checks, hashlib.sha256(result.path.points_rad).hexdigest())
"""


def test_another_process_finds_the_same(planned, through_the_doorway):
    for warm_up in range(3):
        planned("TRRT", seed=warm_up)
    here = set()
    for planner in SOURCE_PLANNERS:
        result = planned(planner, seed=7, simplification_checks=300)
        digest = hashlib.sha256(result.path.points_rad).hexdigest()
        here.add(f"{planner} {result.checks} {result.simplification_checks} {digest}")
    values = {name: getattr(through_the_doorway, name) for name in through_the_doorway.__slots__}
    arguments = [str(Path(__file__).parent), json.dumps(values)]
    for hash_seed in ("1", "2"):
        done = subprocess.run(
            [sys.executable, "-c", ELSEWHERE, *arguments],
            capture_output=True,
            text=True,
            check=True,
            timeout=PATIENCE_S,
            env={"PYTHONHASHSEED": hash_seed, "PYTHONPATH": ":".join(sys.path)},
        )
        assert set(done.stdout.splitlines()) == here


def test_a_start_or_goal_that_is_invalid(planned, through_the_doorway):
    inside = (0.0,) * 6
    start = planned(problem=replace(through_the_doorway, start=inside))
    assert (start.outcome, start.path, start.checks) == (PlanOutcome.INVALID_START, None, 0)
    goal = planned(problem=replace(through_the_doorway, goal=inside))
    assert (goal.outcome, goal.path, goal.checks) == (PlanOutcome.INVALID_GOAL, None, 0)
    beyond = planned(problem=replace(through_the_doorway, goal=(4.0, *inside[1:])))
    assert beyond.outcome is PlanOutcome.INVALID_GOAL


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_a_goal_that_cannot_be_reached_spends_the_budget(planned, through_the_doorway, planner):
    class Closed:
        def is_valid(self, q):
            return abs(q[0]) > 0.15

    result = planned(planner, validity=Closed(), budget_checks=3000, simplification_checks=100)
    assert fields(result) == (PlanOutcome.BUDGET_SPENT, 3000, 0, pytest.approx(3.0), None)


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
def test_a_move_to_where_the_arm_is(planned, through_the_doorway, planner):
    result = planned(planner, problem=replace(through_the_doorway, goal=through_the_doorway.start))
    assert result.outcome is PlanOutcome.SOLVED
    assert path_length(result.path.points_rad) == 0.0


def test_a_shorter_range_makes_shorter_steps(planned):
    steps = np.diff(planned(PlannerSettings(algorithm="RRT", parameters=(("range", 0.3),))).path.points_rad, axis=0)
    assert np.max(np.linalg.norm(steps, axis=1)) <= 0.3 + 1e-9


def test_a_wall_clock_ends_the_search_by_time(planned):
    class Closed:
        def is_valid(self, q):
            return abs(q[0]) > 0.15

    wall = PlanningClock(kind=ClockKind.WALL)
    result = planned(validity=Closed(), clock=wall, limit_s=0.05, budget_checks=10**9)
    assert result.outcome is PlanOutcome.BUDGET_SPENT
    assert result.search_time_s >= 0.05
    found = planned(clock=wall, limit_s=60.0)
    assert found.outcome is PlanOutcome.SOLVED
    assert found.search_time_s > 0.0


def test_an_error_of_the_validity_check_comes_through(planned):
    class Broken:
        calls = 0

        def is_valid(self, q):
            self.calls += 1
            if self.calls > 50:
                raise RuntimeError("the sensor is off")
            return True

    class Impassable(Broken):
        def is_valid(self, q):
            return super().is_valid(q) and abs(q[0]) > 0.15

    with pytest.raises(RuntimeError, match="the sensor is off"):
        planned(validity=Impassable())


def test_a_planner_that_there_is_not(planned):
    with pytest.raises(MotionError) as caught:
        planned("RRTStar")
    assert caught.value.message == "unknown planner 'RRTStar'"
    assert caught.value.hint == f"the planners are {', '.join(available_planners())}"


def test_a_seed_that_is_none(planned):
    with pytest.raises(MotionError) as caught:
        planned(seed=-1)
    assert caught.value.message == "seed must be at least 0, got -1"
    assert caught.value.hint == "give a whole number"


@pytest.mark.parametrize("name", ["budget_checks", "simplification_checks"])
def test_a_budget_below_zero(planned, name):
    with pytest.raises(MotionError) as caught:
        planned(**{name: -5})
    assert caught.value.message == "a budget of validity checks must be at least 0, got -5"
    assert caught.value.hint == "give a whole number"


@pytest.mark.parametrize("planner", SOURCE_PLANNERS)
@pytest.mark.parametrize("limit_s", [0.0, 0.03, 0.5, 0.9, 2.0, 60.0])
def test_the_simplification_keeps_its_limit_by_the_counted_clock(planned, wall, planner, limit_s):
    for seed in range(6):
        clock = PlanningClock(charge_s=0.001)
        result = planned(planner, seed=seed, simplification_checks=1500, simplification_limit_s=limit_s, clock=clock)
        assert result.simplification_time_s == clock.time_s(result.simplification_checks) <= limit_s * (1 + 1e-12)
        # The search knows nothing of it.
        assert result.checks == planned(planner, seed=seed).checks


class Ticking:
    """A computer's clock that goes on by a fixed time at every look, and the validity that it belongs to."""

    def __init__(self, validity, monkeypatch, *, tick_s):
        self._validity = validity
        self.now_s = 0.0
        self._tick_s = tick_s
        monkeypatch.setattr("rgss.motion.clock.time.perf_counter", lambda: self.now_s)

    def is_valid(self, q):
        self.now_s += self._tick_s
        return self._validity.is_valid(q)


@pytest.mark.parametrize("limit_s", [0.0, 0.05, 0.8, 1.5, 60.0])
def test_the_simplification_keeps_its_limit_by_a_wall_clock(planned, wall, through_the_doorway, monkeypatch, limit_s):
    search_limit_s = 20.0
    used = set()
    for seed in range(6):
        ticking = Ticking(wall, monkeypatch, tick_s=0.001)
        result = planned(
            seed=seed,
            validity=ticking,
            simplification_checks=1500,
            simplification_limit_s=limit_s,
            limit_s=search_limit_s,
            budget_checks=2**31 - 1,
            clock=PlanningClock(kind=ClockKind.WALL),
        )
        assert result.outcome is PlanOutcome.SOLVED
        assert result.search_time_s <= search_limit_s
        assert 0.0 <= result.simplification_time_s <= limit_s
        assert result.search_time_s + result.simplification_time_s <= search_limit_s + limit_s
        points = result.path.points_rad
        assert all(map(wall.is_valid, path_states(points, through_the_doorway.resolution_rad)))
        found = planned(seed=seed).path.points_rad
        used.add(not np.array_equal(points, found))
    # What is not checked by then is not used, and there is time enough in a minute.
    assert (True in used) == (limit_s >= 1.5)


def test_a_simplification_limit_is_a_time(planned):
    for limit_s in (-1.0, float("nan")):
        with pytest.raises(MotionError, match="simplification limit must be at least 0 s"):
            planned(simplification_limit_s=limit_s)
