"""Assembly of a trial's record from plan and execution under the design's planning limit."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from rgss.evidence import (
    Failure,
    Metric,
    PhaseOutcome,
    PhaseRecord,
    PlanningRecord,
    PlanOutcome,
    TrialRecord,
)
from rgss.tasks import TaskClock, TaskProgram
from rgss.trials.conditions import conditions_of
from rgss.trials.metrics import METRICS, Aggregation, Direction, MetricDescriptor
from rgss.trials.phase_result import PhaseResult
from rgss.trials.planning import PlannedMove, TaskPlan
from rgss.trials.trial_spec import TrialSpec

_CARRIED = (Aggregation.WORST_CARRIED, Aggregation.SUM_CARRIED)
"""Rules over the phases with an object in the hand."""

_PLANNING_FAILURES = {
    PlanOutcome.BUDGET_SPENT: Failure.PLANNING_LIMIT,
    PlanOutcome.NOT_VERIFIED: Failure.PATH_NOT_VERIFIED,
    PlanOutcome.INVALID_START: Failure.INVALID_START,
    PlanOutcome.INVALID_GOAL: Failure.INVALID_GOAL,
    PlanOutcome.MOVE_BLOCKED: Failure.MOVE_BLOCKED,
    PlanOutcome.MOVE_UNREACHABLE: Failure.MOVE_UNREACHABLE,
}


def assemble_record(
    spec: TrialSpec,
    plan: TaskPlan,
    timing_failures: Mapping[str, tuple[Failure, str]],
    execution: Sequence[PhaseResult],
    *,
    bench_payload_kg: float | None = None,
) -> TrialRecord:
    """Assemble the record of a trial from shared pieces.

    The phases end at the first move without a path within the design's planning limit, without a timing, or with a
    failure in the physics, or when planning and motion exceed the time limit of the task; later phases count as not
    run.

    Args:
        spec: The trial.
        plan: The searches, at least as long as the limit.
        timing_failures: Moves with a path but without a trajectory, and the reasons.
        execution: The executed phases, in order.
        bench_payload_kg: Payload of the gripper on the bench; None if unknown.
    """
    planned_phases, results = spec.task.planned, {result.phase: result for result in execution}
    phases: list[PhaseRecord] = []
    planning: list[PlanningRecord] = []
    ended: tuple[Failure, str] | None = None
    failed_phase: str | None = None
    clock = TaskClock(spec.task.time_limit_s)
    for phase in spec.task.phases:
        if ended is not None:
            phases.append(PhaseRecord(phase=phase, outcome=PhaseOutcome.NOT_RUN, duration_s=None, metrics={}))
            if phase in planned_phases:
                planning.append(_not_planned(phase))
            continue
        if phase in planned_phases:
            limit_s = spec.task.move(phase).limit_s
            limit_s = min(limit_s or spec.planning_limit_s, spec.planning_limit_s)
            planned = plan.move_within(phase, limit_s)
            planning.append(_planning_record(planned))
            clock.spend(planned.time_s)
            if planned.outcome is not PlanOutcome.SOLVED:
                ended = _PLANNING_FAILURES[planned.outcome], planned.detail or _limit_detail(planned, spec, limit_s)
        ended = ended or timing_failures.get(phase) or _too_late(clock)
        if ended is not None:
            failed_phase = phase
            phases.append(PhaseRecord(phase=phase, outcome=PhaseOutcome.FAILED, duration_s=None, metrics={}))
            continue
        result = results[phase]
        clock.spend(result.duration_s)
        ended = _too_late(clock) if result.failure is None else (result.failure, result.detail)
        failed_phase = None if ended is None else phase
        phases.append(
            PhaseRecord(
                phase=phase,
                outcome=PhaseOutcome.COMPLETED if ended is None else PhaseOutcome.FAILED,
                duration_s=result.duration_s,
                metrics=dict(result.metrics),
            )
        )
    (failure, detail), conditions = ended or (None, ""), conditions_of(spec)
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
        metrics=_metrics(spec.task, phases, planning, success=failure is None, bench_payload_kg=bench_payload_kg),
        workload=conditions.case,
        draws=dict(conditions.draws),
    )


def _too_late(clock: TaskClock) -> tuple[Failure, str] | None:
    return (Failure.TASK_TIME_LIMIT, clock.overrun) if clock.overrun else None


def _planning_record(planned: PlannedMove) -> PlanningRecord:
    return PlanningRecord(
        subtask=planned.phase,
        outcome=planned.outcome,
        checks=planned.checks,
        simplification_checks=planned.simplification_checks,
        time_s=planned.time_s,
        path_length_m=planned.path_length_m,
    )


def _not_planned(phase: str) -> PlanningRecord:
    return PlanningRecord(
        subtask=phase,
        outcome=PlanOutcome.NOT_RUN,
        checks=0,
        simplification_checks=0,
        time_s=None,
        path_length_m=None,
    )


def _limit_detail(planned: PlannedMove, spec: TrialSpec, limit_s: float) -> str:
    return f"{spec.planned_by.algorithm} found no path in {limit_s:g} s ({planned.checks} validity checks)"


def _metrics(
    task: TaskProgram,
    phases: Sequence[PhaseRecord],
    planning: Sequence[PlanningRecord],
    *,
    success: bool,
    bench_payload_kg: float | None,
) -> dict[str, Metric]:
    """All metrics of the trial: those computed here, and the others aggregated by their descriptors."""
    computed: dict[str, Metric] = {
        "success": int(success),
        "phases_completed": sum(phase.outcome is PhaseOutcome.COMPLETED for phase in phases),
        "phases_total": len(phases),
        "planning_time_s": tuple(record.time_s for record in planning),
        "planning_checks": tuple(
            None if record.outcome is PlanOutcome.NOT_RUN else record.checks for record in planning
        ),
        "path_length_m": tuple(record.path_length_m for record in planning),
        **_durations(task, phases, planning, success=success),
        "grasp_force_closure_share_1": _force_closure_share(task, phases),
        "bench_payload_kg": bench_payload_kg,
    }
    grips, carried = frozenset(task.grips), frozenset(task.carried)
    of_rule: dict[Aggregation | None, Sequence[PhaseRecord]] = {
        Aggregation.AT_GRASP: [phase for phase in phases if phase.phase in grips],
        **{rule: [phase for phase in phases if phase.phase in carried] for rule in _CARRIED},
    }
    return {
        name: computed[name]
        if metric.trial is Aggregation.COMPUTED
        else _aggregated(metric, task, of_rule.get(metric.trial, phases))
        for name, metric in METRICS.items()
    }


def _aggregated(metric: MetricDescriptor, task: TaskProgram, phases: Sequence[PhaseRecord]) -> Metric:
    """Aggregated value of the trial over the phases of the rule; None if none of them has a value."""
    rule = metric.trial
    if rule is Aggregation.AT_GRASP:
        return _at_grasps(metric, phases)
    if rule is Aggregation.OF_GREATEST:
        return _of_greatest(metric, phases)
    values = [value for phase in phases if (value := phase.metrics.get(metric.name)) is not None]
    if not values:
        return None
    if rule is Aggregation.WORST_PLACED:
        return _worst_placed(metric, task, phases)
    if rule in (Aggregation.GREATEST_OF_EACH, Aggregation.SUM_OF_EACH):
        of_each = max if rule is Aggregation.GREATEST_OF_EACH else math.fsum
        rows = [tuple(float(entry or 0.0) for entry in value) for value in values if isinstance(value, tuple)]
        return tuple(map(of_each, zip(*rows, strict=True)))
    numbers = [value for value in values if isinstance(value, (int, float))]
    if rule in (Aggregation.SUM, Aggregation.SUM_CARRIED):
        total = math.fsum(numbers)
        total = int(total) if all(isinstance(value, int) for value in numbers) else total
        return total or None if rule is Aggregation.SUM_CARRIED else total
    higher_is_better = metric.better is Direction.HIGHER
    least = rule is Aggregation.LEAST or (rule is Aggregation.WORST_CARRIED and higher_is_better)
    return min(numbers) if least else max(numbers)


def _worst_placed(metric: MetricDescriptor, task: TaskProgram, phases: Sequence[PhaseRecord]) -> Metric:
    """The greatest of the last value of each release: what was placed may still be moved."""
    last: dict[int, float] = {}
    release = 0
    for phase in phases:
        release += phase.phase in task.releases
        value = phase.metrics.get(metric.name)
        if isinstance(value, (int, float)):
            last[release] = value
    return max(last.values(), default=None)


def _durations(
    task: TaskProgram, phases: Sequence[PhaseRecord], planning: Sequence[PlanningRecord], *, success: bool
) -> dict[str, float | None]:
    motion_s = math.fsum(phase.duration_s for phase in phases if phase.duration_s is not None)
    planning_s = math.fsum(record.time_s for record in planning if record.time_s is not None)
    by_phase = {phase.phase: phase for phase in phases}
    cycles_s: list[float | None] = []
    for grip, release in zip(task.grips, task.releases, strict=False):
        closing, opening_s = by_phase[grip], by_phase[release].metrics.get("opening_s")
        closing_s = closing.duration_s if closing.outcome is PhaseOutcome.COMPLETED else None
        has_cycle = closing_s is not None and isinstance(opening_s, float)
        cycles_s.append(closing_s + opening_s if has_cycle else None)  # type: ignore[operator]
    return {
        "motion_time_s": motion_s,
        "task_time_s": motion_s + planning_s if success else None,
        "attempt_time_s": motion_s + planning_s,
        # Of several cycles the longest, if all were completed.
        "grasp_cycle_time_s": None
        if None in cycles_s
        else max((one for one in cycles_s if one is not None), default=None),
    }


def _at_grasps(metric: MetricDescriptor, grasps: Sequence[PhaseRecord]) -> Metric:
    """Value at the grasp; of several grasps the worst number, or the first value if it is not a number."""
    values = [value for phase in grasps if (value := phase.metrics.get(metric.source)) is not None]
    if len(values) < 2:
        return values[0] if values else None
    numbers = [value for value in values if isinstance(value, (int, float))]
    if len(numbers) < len(values):
        return values[0]
    return min(numbers) if metric.better is Direction.HIGHER else max(numbers)


def _of_greatest(metric: MetricDescriptor, phases: Sequence[PhaseRecord]) -> Metric:
    """Value in the first phase in which the metric's source is greatest."""
    found = [
        (source, phase.metrics.get(metric.name))
        for phase in phases
        if isinstance(source := phase.metrics.get(metric.source), float)
    ]
    return max(found, key=lambda pair: pair[0])[1] if found else None


def _force_closure_share(task: TaskProgram, phases: Sequence[PhaseRecord]) -> float | None:
    samples, closed = (
        sum(
            value
            for phase in phases
            if phase.phase in task.carried and isinstance(value := phase.metrics.get(name), int)
        )
        for name in ("grasp_samples", "grasp_samples_closed")
    )
    return closed / samples if samples else None
