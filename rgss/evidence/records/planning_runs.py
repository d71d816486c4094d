"""Runs of planners on problems, for comparisons of planners."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.evidence.records.outcomes import PlanOutcome


@dataclass(frozen=True, slots=True, kw_only=True)
class PlanningRun:
    """One search of one planner for one move.

    Attributes:
        problem: The problem: gripper and move.
        planner: Name of the planner.
        seed: Seed of the search.
        limit_s: Planning limit of the run. outcome: Its outcome.
        checks: State-validity checks of the search.
        simplification_checks: State-validity checks spent on shortening the path.
        time_s: Planning time by the planning clock; None if the search did not run.
        path_length_m: Length of the tool's path; None if there is no path.
    """

    problem: str
    planner: str
    seed: int
    limit_s: float
    outcome: PlanOutcome
    checks: int
    simplification_checks: int
    time_s: float | None
    path_length_m: float | None
