"""Planners of OMPL with their parameters, their objectives and their table."""

from __future__ import annotations

import hashlib
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from rgss.designs import PLANNER_PREFIX, PLANNER_QUANTITIES, ParameterKind
from rgss.errors import MotionError
from rgss.evidence.records.outcomes import PlanOutcome
from rgss.motion import (
    Objective,
    ParameterType,
    PlannerSettings,
    PlanningClock,
    available_planners,
    ompl_planners,
    plan,
    refusal_of,
    takes_objective,
)
from tests.fixtures.planned_paths import path_states
from tests.fixtures.processes import PATIENCE_S

engine = pytest.mark.engine

# They draw their samples beforehand, more than the small budgets here allow for.
_BATCH = ("FMT", "BFMT")


@pytest.fixture
def planned(through_the_doorway, clock, wall):
    """Plans through the doorway; a call takes what differs."""

    def run(planner, *, problem=through_the_doorway, validity=wall, **changes):
        values = {"seed": 3, "budget_checks": 40_000, "simplification_checks": 0, "clock": clock}
        return plan(problem, validity, planner, **(values | changes))

    return run


def few_samples(name):
    parameters = (("num_samples", 200),) if name in _BATCH else ()
    return PlannerSettings(algorithm=name, parameters=parameters)


@engine
def test_the_table_is_that_of_the_installed_wheel():
    from rgss.motion.planner_catalogue.introspection import planner_table

    stored = json.loads(
        (Path(__file__).parents[2] / "rgss/motion/planner_catalogue/ompl_planners.json").read_text(encoding="utf-8")
    )
    assert planner_table() == stored


def test_every_parameter_is_a_quantity_of_its_kind():
    types = {}
    for planner in ompl_planners().values():
        for name, parameter in planner.parameters.items():
            types.setdefault(f"{PLANNER_PREFIX}{name}", set()).add(parameter.type)
    assert types.keys() == PLANNER_QUANTITIES.keys()
    for name, found in types.items():
        counts = PLANNER_QUANTITIES[name].kind is ParameterKind.COUNT
        assert found == ({ParameterType.REAL} if not counts else found - {ParameterType.REAL}), name


def test_planners_that_cannot_be_run_say_why():
    refused = {name for name in ompl_planners() if name not in available_planners()}
    assert refused == {"LBTRRT", "LazyLBTRRT", "SPARS", "SPARStwo", "SST"}
    assert all(refusal_of(name) for name in refused)
    assert not refusal_of("RRT")


@engine
@pytest.mark.parametrize("name", available_planners())
def test_each_finds_a_valid_path_counts_every_check_and_finds_it_again(planned, wall, through_the_doorway, name):
    one = planned(few_samples(name))
    assert one.outcome is PlanOutcome.SOLVED
    assert one.checks + 2 == wall.calls
    points = one.path.points_rad
    assert (tuple(points[0]), tuple(points[-1])) == (through_the_doorway.start, through_the_doorway.goal)
    assert all(map(wall.is_valid, path_states(points, through_the_doorway.resolution_rad)))
    again = planned(few_samples(name))
    assert (again.checks, again.path.points_rad.tobytes()) == (one.checks, points.tobytes())


@engine
@pytest.mark.parametrize("name", available_planners())
def test_a_smaller_budget_of_each_is_read_off_a_larger_search(planned, name):
    shared = planned(few_samples(name))
    for budget, outcome in ((shared.checks, PlanOutcome.SOLVED), (shared.checks - 1, PlanOutcome.BUDGET_SPENT)):
        alone = planned(few_samples(name), budget_checks=budget)
        assert alone.outcome is outcome
        if outcome is PlanOutcome.SOLVED:
            assert alone.path.points_rad.tobytes() == shared.path.points_rad.tobytes()


ELSEWHERE = """
import hashlib, json, sys
sys.path.insert(0, sys.argv[1])
import conftest
from rgss.motion import PlannerSettings, PlanningClock, PlanningProblem, plan
problem = PlanningProblem(**json.loads(sys.argv[2]))
for name in ("PRM", "RRTConnect", "BITstar", "KPIECE1", "PRMstar"):
    result = plan(problem, conftest.Wall(), name, seed=3, budget_checks=40000, simplification_checks=0,
                  clock=PlanningClock(charge_s=0.001))
    print(name, result.checks, hashlib.sha256(result.path.points_rad).hexdigest())
"""


@engine
def test_another_process_finds_the_same(planned, through_the_doorway):
    values = {name: getattr(through_the_doorway, name) for name in through_the_doorway.__slots__}
    arguments = [str(Path(__file__).parent), json.dumps(values)]
    done = subprocess.run(
        [sys.executable, "-c", ELSEWHERE, *arguments], capture_output=True, text=True, check=True, timeout=PATIENCE_S
    )
    for line in done.stdout.splitlines():
        name, checks, digest = line.split()
        here = planned(name)
        assert (str(here.checks), hashlib.sha256(here.path.points_rad).hexdigest()) == (checks, digest)


@engine
@pytest.mark.parametrize("range_rad", [0.1, 3.0])
def test_a_parameter_reaches_the_planner(planned, range_rad):
    found = planned(PlannerSettings(algorithm="RRTConnect", parameters=(("range", range_rad),)))
    longest = np.linalg.norm(np.diff(found.path.points_rad, axis=0), axis=1).max()
    assert (longest <= 0.1 + 1e-9) == (range_rad == 0.1)


@engine
def test_whole_numbers_and_flags_reach_the_planner(planned):
    usual = planned("BITstar").checks
    assert planned(PlannerSettings(algorithm="BITstar", parameters=(("samples_per_batch", 20),))).checks != usual
    kept = planned(PlannerSettings(algorithm="RRT", parameters=(("intermediate_states", 1), ("range", 3.0))))
    assert kept.checks != planned(PlannerSettings(algorithm="RRT", parameters=(("range", 3.0),))).checks


@engine
def test_the_tree_of_trrt_is_that_of_rrt_only_without_a_cost(planned):
    """A cost over the second joint: over the doorway it is high, so that a tree which avoids it is another."""
    differing = 0
    for seed in range(8):
        plain = planned(PlannerSettings(algorithm="RRT", parameters=(("range", 0.4),)), seed=seed)
        free = planned(PlannerSettings(algorithm="TRRT", parameters=(("range", 0.4),)), seed=seed)
        assert free.path.points_rad.tobytes() == plain.path.points_rad.tobytes()
        assert free.checks == plain.checks
        costly = planned(
            PlannerSettings(algorithm="TRRT", parameters=(("range", 0.4),), objective=Objective.CLEARANCE),
            seed=seed,
            cost=lambda q: 100.0 * (q[1] + 2.0),
        )
        differing += costly.path is None or costly.path.points_rad.tobytes() != plain.path.points_rad.tobytes()
    assert differing == 8


@engine
def test_the_path_of_trrt_climbs_less_where_it_has_a_cost(planned):
    """Means over seeds: the criterion is one of transitions, and a single path may climb more."""

    def height(q):
        return 100.0 * (q[5] + 2.0)

    def climb(result):
        heights = [height(q) for q in path_states(result.path.points_rad, 0.01)]
        return float(np.sum(np.maximum(np.diff(heights), 0.0)))

    without, with_cost = (
        [
            climb(result)
            for seed in range(16)
            if (
                result := planned(
                    PlannerSettings(algorithm="TRRT", parameters=(("range", 0.2),), objective=objective),
                    seed=seed,
                    cost=height,
                )
            ).path
            is not None
        ]
        for objective in (None, Objective.MECHANICAL_WORK)
    )
    assert len(with_cost) >= 14
    assert np.mean(with_cost) < 0.9 * np.mean(without)


@engine
def test_every_evaluation_of_a_cost_is_charged(planned, wall):
    asked = []

    def cost(q):
        asked.append(q)
        return 0.0

    result = planned(PlannerSettings(algorithm="TRRT", objective=Objective.MECHANICAL_WORK), cost=cost)
    assert len(set(asked)) == len(asked) > 10
    assert result.checks == wall.calls - 2 + len(asked)
    assert result.search_time_s == pytest.approx(result.checks * 0.001)


@engine
def test_a_path_length_needs_no_cost(planned):
    settings = PlannerSettings(algorithm="RRTstar", objective=Objective.PATH_LENGTH)
    assert planned(settings).checks == planned("RRTstar").checks


@engine
def test_an_objective_without_the_cost_that_it_needs(planned):
    with pytest.raises(MotionError, match="the planner's objective needs the cost of a state"):
        planned(PlannerSettings(algorithm="TRRT", objective=Objective.CLEARANCE))


@engine
def test_a_roadmap_that_cannot_connect_spends_the_budget(planned):
    class Closed:
        def is_valid(self, q):
            return abs(q[0]) > 0.15

    result = planned("PRM", validity=Closed(), budget_checks=3000)
    assert (result.outcome, result.checks) == (PlanOutcome.BUDGET_SPENT, 3000)


@pytest.mark.parametrize(
    ("settings", "message", "hint"),
    [
        (PlannerSettings(algorithm="RRTStar"), "unknown planner 'RRTStar'", "the planners are "),
        (
            PlannerSettings(algorithm="SST"),
            "planner SST cannot be run: it always runs to its limit",
            "the planners are ",
        ),
        (
            PlannerSettings(algorithm="RRT", parameters=(("step", 1.0),)),
            "RRT has no parameter 'step'",
            "its parameters: goal_bias, intermediate_states, range",
        ),
        (
            PlannerSettings(algorithm="RRT", parameters=(("goal_bias", 1.5),)),
            "RRT: goal_bias must be at least 0 and at most 1, got 1.5",
            "",
        ),
        (
            PlannerSettings(algorithm="STRIDE", parameters=(("degree", 2.5),)),
            "STRIDE: degree must be a whole number, got 2.5",
            "",
        ),
        (
            PlannerSettings(algorithm="RRT", parameters=(("intermediate_states", 2),)),
            "RRT: intermediate_states must be true or false, got 2",
            "",
        ),
    ],
)
def test_settings_that_cannot_be(through_the_doorway, wall, settings, message, hint):
    with pytest.raises(MotionError) as caught:
        plan(
            through_the_doorway,
            wall,
            settings,
            seed=0,
            budget_checks=1,
            simplification_checks=0,
            clock=PlanningClock(charge_s=0.001),
        )
    assert caught.value.message.startswith(message)
    assert str(caught.value.hint or "").startswith(hint)


def test_only_planners_with_a_cost_take_an_objective():
    assert [takes_objective(name) for name in ("TRRT", "RRTstar", "FMT", "RRT", "STRIDE")] == [True] * 3 + [False] * 2
    assert PlannerSettings(algorithm="TRRT").has_no_cost
    assert not PlannerSettings(algorithm="TRRT", objective=Objective.CLEARANCE).has_no_cost
    assert not PlannerSettings(algorithm="RRT").has_no_cost
