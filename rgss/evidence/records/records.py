"""Record of one trial: frozen plain values with a lossless JSON form."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.evidence.records.outcomes import Failure, Fidelity, PhaseOutcome, PlanOutcome

Metric = float | int | None | tuple[float | int | None, ...]
"""A number, a row of numbers, or None if not observed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PhaseRecord:
    """Result of one step of the task.

    Attributes:
        phase: The phase.
        outcome: Its outcome.
        duration_s: Its simulated time; None if it did not run.
        metrics: Metrics of the phase, by name with unit, such as ``slip_m``.
    """

    phase: str
    outcome: PhaseOutcome
    duration_s: float | None
    metrics: Mapping[str, Metric]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningRecord:
    """Planning result of one planned move.

    Attributes:
        subtask: The move.
        outcome: Outcome of its planning.
        checks: State-validity checks of the search (without simplification).
        simplification_checks: State-validity checks spent on shortening the path.
        time_s: Planning time by the trial's planning clock; None if it did not run.
        path_length_m: Length of the tool's path; None if there is no path.
    """

    subtask: str
    outcome: PlanOutcome
    checks: int
    simplification_checks: int
    time_s: float | None
    path_length_m: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialRecord:
    """Record of a trial: one variant under one seed.

    Attributes:
        variant: Id of the design variant.
        seed: The trial's seed.
        fidelity: Its fidelity.
        success: True if all steps of the task are complete and the object is in its place.
        failure: The failure that ended it; None on success.
        failed_phase: The phase that failed; None on success.
        failure_detail: Numbers of the failure, in one line; empty on success.
        phases: The steps of the task in order.
        planning: The planned moves in order.
        metrics: Metrics of the whole trial, by name with unit.
        workload: The case of the workload; empty if there is none.
        draws: Draw of each uncertain quantity, in SI; empty without uncertainty.
    """

    variant: int
    seed: int
    fidelity: Fidelity
    success: bool
    failure: Failure | None
    failed_phase: str | None
    failure_detail: str
    phases: tuple[PhaseRecord, ...]
    planning: tuple[PlanningRecord, ...]
    metrics: Mapping[str, Metric]
    workload: str = ""
    draws: Mapping[str, float] = field(default_factory=dict)
