"""The planning limit binds: a shorter one costs successes."""

from __future__ import annotations

import pytest

from rgss.evidence import PLANNED_PHASES, PlanOutcome
from rgss.trials.plan import plan_task
from rgss.trials.workcell import Workcell

pytestmark = [pytest.mark.engine, pytest.mark.slow]

SEEDS = range(1, 51)
LIMITS_S = (4.0, 6.0, 8.0)
TWO_FINGERS, THREE_FINGERS = 22, 4


def planned_tasks(spec_of, variant):
    """How many of the tasks are planned to the end within each limit; physics is not asked."""
    first = spec_of(variant)
    settings = first.settings.planning
    cell = Workcell(first.scene, first.gripper.geometry, clearance_m=settings.clearance_m)
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
