"""The planning limit binds: a shorter one costs successes."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import PlanOutcome
from rgss.motion import ClockKind, PlanningClock
from rgss.studies.expansion import trial_specs
from rgss.tasks import default_task
from rgss.trials.planning import plan_task
from rgss.trials.workcell import Workcell, workcell_of
from tests.fixtures.eight_states import PLANNED_PHASES

pytestmark = [pytest.mark.engine, pytest.mark.slow]

# Among them are two with which a plan takes longer than 4 s or 6 s, and some with which it takes longer than 8 s.
SEEDS = range(26, 46)
LIMITS_S = (4.0, 6.0, 8.0)
TWO_FINGERS, THREE_FINGERS = 22, 4


def planned_tasks(spec_of, variant):
    """How many of the tasks are planned to the end within each limit; physics is not asked."""
    first = spec_of(variant)
    settings = first.settings.planning
    cell = Workcell(first.scene, first.gripper.geometry, clearance_m=settings.clearance_m, task=default_task())
    plans = [plan_task(cell, first.planner, seed=seed, settings=settings) for seed in SEEDS]
    return [
        sum(
            all(
                phase in plan.moves and plan.move_within(phase, limit_s).outcome is PlanOutcome.SOLVED
                for phase in PLANNED_PHASES
            )
            for plan in plans
        )
        for limit_s in LIMITS_S
    ]


@pytest.mark.verifies("SYS-032")
def test_trrt_plans_fewer_tasks_in_4_s_than_in_8_s(spec_of):
    by_hand = [planned_tasks(spec_of, variant) for variant in (TWO_FINGERS, THREE_FINGERS)]
    short, medium, long = (sum(counts) for counts in zip(*by_hand, strict=True))

    assert all(counts == sorted(counts) for counts in by_hand)
    assert short <= medium <= long
    assert short < long


@pytest.mark.verifies("SYS-032")
@pytest.mark.parametrize(("limit_s", "seed"), [(0.05, 1), (0.5, 2), (2.0, 3)])
def test_no_move_of_any_variant_takes_longer_than_both_limits_together(project, limit_s, seed):
    """Whatever the variant and the seed; and a plan is shared by the planning limits."""
    plans = {}
    for spec in trial_specs(project, seeds=(seed,)):
        planning = replace(spec.settings.planning, simplification_limit_s=limit_s)
        shared = spec.gripper.geometry.id, spec.planner, spec.seed
        if shared not in plans:
            cell = workcell_of(spec.scene, spec.gripper.geometry, planning.clearance_m, default_task())
            plans[shared] = plan_task(cell, spec.planner, seed=spec.seed, settings=planning)
        for phase in plans[shared].moves:
            move = plans[shared].move_within(phase, spec.planning_limit_s)
            assert move.time_s <= (spec.planning_limit_s + limit_s) * (1 + 1e-12)
            assert move.time_s == planning.clock.time_s(move.checks) + planning.clock.time_s(move.simplification_checks)


@pytest.mark.parametrize("limit_s", [0.0, 0.01, 1.0])
def test_neither_does_one_by_the_wall_clock(spec_of, limit_s):
    spec = spec_of(4)
    planning = replace(
        spec.settings.planning,
        clock=PlanningClock(kind=ClockKind.WALL),
        search_limit_s=2.0,
        simplification_limit_s=limit_s,
    )
    cell = workcell_of(spec.scene, spec.gripper.geometry, planning.clearance_m, default_task())
    for seed in (1, 2):
        plan = plan_task(cell, spec.planner, seed=seed, settings=planning)
        for phase in plan.moves:
            for planning_limit_s in (0.001, 0.1, 2.0):
                assert plan.move_within(phase, planning_limit_s).time_s <= planning_limit_s + limit_s
