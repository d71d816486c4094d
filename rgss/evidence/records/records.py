"""Record of one trial: plain, frozen values that survive a round trip through JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.evidence.records.outcomes import Failure, Fidelity, PhaseOutcome, PlanOutcome

Metric = float | int | None | tuple[float | int | None, ...]
"""A number, a row of numbers, or None where the trial cannot know it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PhaseRecord:
    """One step of the task as it was run.

    Attributes:
        phase: The phase.
        outcome: Its outcome.
        duration_s: Simulated time that it took; None if it did not run.
        metrics: Metrics of the phase, by name with unit, such as ``slip_m``.
    """

    phase: str
    outcome: PhaseOutcome
    duration_s: float | None
    metrics: Mapping[str, Metric]


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningRecord:
    """The planning of one of the five moves.

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
    """One variant tried once.

    Attributes:
        variant: Id of the design variant.
        seed: The trial's seed.
        fidelity: Its fidelity.
        success: True if all steps of the task are complete and the object is where it should be.
        failure: What ended it; None on success.
        failed_phase: The phase that failed; None on success.
        failure_detail: The numbers that show the failure, in one line; empty on success.
        phases: The steps of the task in order.
        planning: The planned moves in order.
        metrics: Metrics of the whole trial, by name with unit.
        workload: The case of the workload; empty where there is none.
        draws: What was drawn for it of each uncertain quantity, in SI; empty where everything is as the files say.
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
