"""A trial's record, put together from its plan and its execution under the design's limit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from rgss.evidence import (
    PLANNED_PHASES,
    Failure,
    Metric,
    Phase,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    TrialRecord,
)
from rgss.trials.metrics import AT_GRASP
from rgss.trials.monitors import GREATEST, LEAST, worst_of
from rgss.trials.phase_result import PhaseResult
from rgss.trials.plan import PlannedMove, TaskPlan
from rgss.trials.trial_spec import TrialSpec

_PLANNING_FAILURES = {
    PlanOutcome.BUDGET_SPENT: Failure.PLANNING_LIMIT,
    PlanOutcome.INVALID_START: Failure.INVALID_START,
    PlanOutcome.INVALID_GOAL: Failure.INVALID_GOAL,
}
_GREATEST = (
    "peak_tool_speed_m_s",
    "peak_tool_acceleration_m_s2",
    "sensed_finger_force_n",
    "peak_finger_force_n",
    "peak_joint_torque_ratio",
    "tracking_error_m",
    "slip_m",
)
_CARRIED = (Phase.LIFT, Phase.MOVE_TO_GRASP_DEPARTURE, Phase.MOVE_TO_PLACE_APPROACH, Phase.MOVE_TO_PLACE)


def assemble_record(
    spec: TrialSpec,
    plan: TaskPlan,
    timing_failures: Mapping[Phase, tuple[Failure, str]],
    execution: Sequence[PhaseResult],
    *,
    bench_payload_kg: float | None = None,
) -> TrialRecord:
    """Read a trial off the pieces that it shares with others.

    Phases run in order until a move finds no path within the design's planning limit, cannot be
    timed, or fails in the physics; what comes after is not run.

    Args:
        spec: The trial.
        plan: The searches, which went on at least as long as the limit.
        timing_failures: Moves that have a path but no trajectory, and why.
        execution: The phases that physics ran, in order.
        bench_payload_kg: What the gripper holds on the payload bench; None where that is not known.
    """
    results = {result.phase: result for result in execution}
    phases: list[PhaseRecord] = []
    planning: list[PlanningRecord] = []
    failure: Failure | None = None
    failed_phase: Phase | None = None
    detail = ""
    for phase in Phase:
        if failure is not None:
            phases.append(PhaseRecord(phase=phase, outcome=PhaseOutcome.NOT_RUN, duration_s=None, metrics={}))
            if phase in PLANNED_PHASES:
                planning.append(_not_planned(phase))
            continue
        if phase in PLANNED_PHASES:
            planned = plan.move_within(phase, spec.planning_limit_s)
            planning.append(_planning_record(planned))
            if planned.outcome is not PlanOutcome.SOLVED:
                failure, failed_phase = _PLANNING_FAILURES[planned.outcome], phase
                detail = planned.detail or _limit_detail(planned, spec)
        if failure is None and phase in timing_failures:
            failure, detail = timing_failures[phase]
            failed_phase = phase
        if failure is not None:
            phases.append(PhaseRecord(phase=phase, outcome=PhaseOutcome.FAILED, duration_s=None, metrics={}))
            continue
        result = results[phase]
        if result.failure is not None:
            failure, failed_phase, detail = result.failure, phase, result.detail
        phases.append(
            PhaseRecord(
                phase=phase,
                outcome=PhaseOutcome.COMPLETED if result.failure is None else PhaseOutcome.FAILED,
                duration_s=result.duration_s,
                metrics=dict(result.metrics),
            )
        )
    return TrialRecord(
        variant=spec.variant,
        seed=spec.seed,
        fidelity=spec.fidelity,
        success=failure is None,
        failure=failure,
        failed_phase=failed_phase,
        failure_detail=detail,
        phases=tuple(phases),
        planning=tuple(planning),
        metrics={**_metrics(phases, planning, success=failure is None), "bench_payload_kg": bench_payload_kg},
    )


def _planning_record(planned: PlannedMove) -> PlanningRecord:
    return PlanningRecord(
        subtask=planned.phase,
        outcome=planned.outcome,
        checks=planned.checks,
        simplification_checks=planned.simplification_checks,
        time_s=planned.time_s,
        path_length_m=planned.path_length_m,
    )


def _not_planned(phase: Phase) -> PlanningRecord:
    return PlanningRecord(
        subtask=phase,
        outcome=PlanOutcome.NOT_RUN,
        checks=0,
        simplification_checks=0,
        time_s=None,
        path_length_m=None,
    )


def _limit_detail(planned: PlannedMove, spec: TrialSpec) -> str:
    return f"{spec.planner} found no path in {spec.planning_limit_s:g} s ({planned.checks} validity checks)"


def _metrics(phases: Sequence[PhaseRecord], planning: Sequence[PlanningRecord], *, success: bool) -> dict[str, Metric]:
    durations = [phase.duration_s for phase in phases if phase.duration_s is not None]
    motion_s = math.fsum(durations)
    times = [record.time_s for record in planning if record.time_s is not None]
    by_phase = {record.phase: record for record in phases}
    closing = by_phase[Phase.GRASP]
    placing = by_phase[Phase.PLACE]
    opening_s = placing.metrics.get("opening_s")
    cycle_s: Metric = None
    if closing.outcome is PhaseOutcome.COMPLETED and isinstance(opening_s, float) and closing.duration_s is not None:
        cycle_s = closing.duration_s + opening_s
    touches = [count for p in phases if isinstance(count := p.metrics.get("arm_scene_contacts"), int)]
    margins = [m for p in phases if isinstance(m := p.metrics.get("grip_margin_min"), float)]
    metrics: dict[str, Metric] = {
        "success": int(success),
        "phases_completed": sum(phase.outcome is PhaseOutcome.COMPLETED for phase in phases),
        "phases_total": len(phases),
        "planning_time_s": tuple(record.time_s for record in planning),
        "planning_checks": tuple(
            None if record.outcome is PlanOutcome.NOT_RUN else record.checks for record in planning
        ),
        "path_length_m": tuple(record.path_length_m for record in planning),
        "motion_time_s": motion_s,
        "task_time_s": motion_s + math.fsum(times) if success else None,
        "grasp_cycle_time_s": cycle_s,
        "grip_margin_min": min(margins, default=None),
        "arm_scene_contacts": sum(touches) if touches else None,
        "place_error_m": _last(phases, "place_error_m"),
        "place_tilt_rad": _last(phases, "place_tilt_rad"),
    }
    for name in _GREATEST:
        values = [v for p in phases if isinstance(v := p.metrics.get(name), float)]
        metrics[name] = max(values, default=None)
    return {**metrics, **_joint_load(phases), **_grasp(by_phase)}


def _joint_load(phases: Sequence[PhaseRecord]) -> dict[str, Metric]:
    """What each joint needed over all phases, and which one came nearest to its limit."""
    peaks, saturated = (_rows(phases, name) for name in ("peak_joint_torque_n_m", "joint_saturated_s"))
    ratios = [
        (ratio, phase.metrics.get("most_loaded_joint"))
        for phase in phases
        if isinstance(ratio := phase.metrics.get("peak_joint_torque_ratio"), float)
    ]
    most_loaded = max(ratios, key=lambda pair: pair[0])[1] if ratios else None
    return {
        "peak_joint_torque_n_m": tuple(map(max, zip(*peaks, strict=True))) if peaks else None,
        "joint_saturated_s": tuple(map(math.fsum, zip(*saturated, strict=True))) if saturated else None,
        "most_loaded_joint": most_loaded,
    }


def _rows(phases: Sequence[PhaseRecord], name: str) -> list[tuple[float, ...]]:
    rows = [phase.metrics.get(name) for phase in phases]
    return [tuple(float(value or 0.0) for value in row) for row in rows if isinstance(row, tuple)]


def _grasp(by_phase: Mapping[Phase, PhaseRecord]) -> dict[str, Metric]:
    """The grasp as it was closed, and at its worst while the object was carried."""
    carried = [by_phase[phase].metrics for phase in _CARRIED]
    worst = worst_of(carried)
    samples, closed = (
        sum(value for row in carried if isinstance(value := row.get(name), int))
        for name in ("grasp_samples", "grasp_samples_closed")
    )
    first = by_phase[Phase.GRASP].metrics
    return {
        **{name: worst.get(name) for name in (*LEAST, *GREATEST)},
        "grasp_samples": samples if samples else None,
        "grasp_force_closure_share_1": closed / samples if samples else None,
        **{at_grasp: first.get(name) for at_grasp, name in AT_GRASP.items()},
    }


def _last(phases: Sequence[PhaseRecord], name: str) -> Metric:
    return next((p.metrics[name] for p in reversed(phases) if p.metrics.get(name) is not None), None)
