"""A trial that ran in three phases, failed in the last, and its course over time."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity, PhaseOutcome, PhaseRecord, TrialRecord
from rgss.evidence.records.trial_trace import PhaseSpan, TrialTrace
from tests.fixtures.eight_states import Phase

PHASES = list(Phase)


def phase_record(index, ran):
    if index < ran - 1:
        return PhaseRecord(phase=PHASES[index], outcome=PhaseOutcome.COMPLETED, duration_s=1.0 + index, metrics={})
    if index == ran - 1:
        return PhaseRecord(phase=PHASES[index], outcome=PhaseOutcome.FAILED, duration_s=0.5, metrics={})
    return PhaseRecord(phase=PHASES[index], outcome=PhaseOutcome.NOT_RUN, duration_s=None, metrics={})


@pytest.fixture
def failed() -> TrialRecord:
    return TrialRecord(
        variant=7,
        seed=3,
        fidelity=Fidelity.CONTACT,
        success=False,
        failure=Failure.OBJECT_DROPPED,
        failed_phase=Phase.LIFT,
        failure_detail="the object slipped 21.0 mm",
        phases=tuple(phase_record(index, 3) for index in range(8)),
        planning=(),
        metrics={"task_time_s": None, "motion_time_s": 3.5},
    )


@pytest.fixture
def succeeded(failed) -> TrialRecord:
    return replace(
        failed,
        success=True,
        failure=None,
        failed_phase=None,
        failure_detail="",
        phases=tuple(
            PhaseRecord(phase=phase, outcome=PhaseOutcome.COMPLETED, duration_s=1.0, metrics={}) for phase in PHASES
        ),
        metrics={"task_time_s": 12.34, "motion_time_s": 8.0},
    )


@pytest.fixture
def trace() -> TrialTrace:
    """Samples at 10 Hz over 1 s, 2 s and 0.5 s."""
    count = 35
    time = np.arange(1, count + 1) / 10
    margin = np.full(count, math.nan)
    margin[30:] = (4.0, 3.0, 2.0, 1.0, 0.5)
    commanded = np.full(count, math.nan)
    commanded[10:] = 7.0
    return TrialTrace(
        spans=(
            PhaseSpan(phase=Phase.MOVE_TO_GRASP, start_s=0.0, end_s=1.0, last=9),
            PhaseSpan(phase=Phase.GRASP, start_s=1.0, end_s=3.0, last=29),
            PhaseSpan(phase=Phase.LIFT, start_s=3.0, end_s=3.5, last=34),
        ),
        time_s=time,
        joint_positions_rad=np.outer(time, np.arange(6)) / 10,
        finger_travel_m=np.zeros((count, 3)),
        workpiece_position_m=np.zeros((count, 3)),
        workpiece_quaternion_xyzw=np.tile((0.0, 0.0, 0.0, 1.0), (count, 1)),
        tool_position_m=np.zeros((count, 3)),
        tool_speed_m_s=np.abs(np.sin(time)),
        tool_speed_limit_m_s=1.5,
        finger_forces_n=np.outer(time, (1.0, 2.0, 3.0)),
        commanded_force_n=commanded,
        grip_margin=margin,
    )
