"""A task ends as a failure in the phase in which its time limit passes."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, PhaseOutcome, PlanOutcome
from rgss.motion import PlanningClock
from rgss.trials.phase_result import PhaseResult
from rgss.trials.planning import PlannedMove, TaskPlan
from rgss.trials.record import assemble_record
from tests.fixtures.eight_states import PLANNED_PHASES, Phase

PHASES = tuple(Phase)


@pytest.fixture
def spec(spec_of):
    return replace(spec_of(65, 7), planning_limit_s=1000.0)


def plan_of(*times_s):
    """A plan whose moves took so long."""
    moves = {
        phase: PlannedMove(
            phase=phase,
            outcome=PlanOutcome.SOLVED,
            checks=10,
            simplification_checks=0,
            search_time_s=time_s,
            time_s=time_s,
            path_rad=np.zeros((2, 6)),
            path_length_m=0.5,
            detail="",
        )
        for phase, time_s in zip(PLANNED_PHASES, times_s, strict=True)
    }
    return TaskPlan(moves=moves, direct={"lift": np.zeros((2, 6))}, clock=PlanningClock(charge_s=0.001))


def result(phase, **changes):
    values = {"phase": phase, "failure": None, "detail": "", "duration_s": 0.5, "metrics": {}}
    return PhaseResult(**(values | changes))


EXECUTION = tuple(result(phase) for phase in PHASES)


@pytest.mark.parametrize("phase", PHASES)
def test_a_task_beyond_its_time_limit_ends_in_the_phase_in_which_it_passes(spec, phase):
    """Eight phases of 0.5 s without planning: the limit passes at the end of one of them."""
    index = PHASES.index(phase)
    for limit_s, expected in ((0.5 * index + 0.25, phase), (4.0, None)):
        limited = replace(spec, task=replace(spec.task, time_limit_s=limit_s))
        record = assemble_record(limited, plan_of(*(0.0,) * 5), {}, EXECUTION)
        assert (record.failed_phase, record.success) == (expected, expected is None)
        if expected is None:
            assert record.metrics["task_time_s"] == 4.0
            continue
        assert record.failure is Failure.TASK_TIME_LIMIT
        taken_s = 0.5 * (index + 1)
        assert record.failure_detail == f"the task took {taken_s:.3g} s, which exceeds its limit of {limit_s:g} s"
        assert record.phases[index].outcome is PhaseOutcome.FAILED
        assert record.phases[index].duration_s == 0.5
        assert all(later.outcome is PhaseOutcome.NOT_RUN for later in record.phases[index + 1 :])
        assert record.metrics["task_time_s"] is None
        assert record.metrics["attempt_time_s"] == taken_s


def test_planning_counts_towards_the_time_of_the_task(spec):
    """The search of the third planned move passes the limit: nothing moves any more."""
    limited = replace(spec, task=replace(spec.task, time_limit_s=100.0))
    planned = plan_of(1.0, 1.0, 101.0, 1.0, 1.0)
    record = assemble_record(limited, planned, {}, EXECUTION)

    assert (record.failure, record.failed_phase) == (Failure.TASK_TIME_LIMIT, PLANNED_PHASES[2])
    failed = record.phases[PHASES.index(PLANNED_PHASES[2])]
    assert failed.duration_s is None
    assert [one.outcome for one in record.planning][2:] == [PlanOutcome.SOLVED] + [PlanOutcome.NOT_RUN] * 2


def test_what_fails_beyond_the_limit_keeps_its_reason(spec):
    limited = replace(spec, task=replace(spec.task, time_limit_s=0.1))
    failed = result(PHASES[0], failure=Failure.ARM_COLLISION, detail="x", duration_s=1.0)
    record = assemble_record(limited, plan_of(*(0.0,) * 5), {}, (failed,))

    assert record.failure is Failure.ARM_COLLISION
