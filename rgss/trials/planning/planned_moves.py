"""Planned moves of a task, and their outcome under a shorter planning limit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from rgss.evidence import PlanOutcome
from rgss.motion import ClockKind, PlanningClock
from rgss.trials.reference import Array


@dataclass(frozen=True, slots=True, kw_only=True)
class PlannedMove:
    """Planning result of one move.

    Attributes:
        phase: The move.
        outcome: The outcome.
        checks: Validity checks of the search, of the verification of its path and of repairs.
        simplification_checks: Validity checks of the simplification.
        search_time_s: Time of the search by the planning clock; compared with a limit.
        time_s: Planning time t_sp by the planning clock: search and simplification.
        path_rad: The path's configurations (k, n); None if there is none.
        path_length_m: Length of the tool's path; None if there is none.
        detail: The obstacle, if the problem is ill-posed or the path is not valid.
        verification_checks: Share of `checks` spent on verifying the path.
        repairs: Number of invalid motions of the path that were replanned.
        simplification_unlimited_from: Least limit of the simplification in checks that does not change its result; None
        if its own limit did.
    """

    phase: str
    outcome: PlanOutcome
    checks: int
    simplification_checks: int
    search_time_s: float
    time_s: float
    path_rad: Array | None
    path_length_m: float | None
    detail: str = ""
    verification_checks: int = 0
    repairs: int = 0
    simplification_unlimited_from: int | None = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class TaskPlan:
    """Planned and direct moves of a task.

    Attributes:
        moves: The planned moves; those after an ill-posed problem are missing.
        direct: Configurations (k, n) of each move that the task defines as straight; None if it is infeasible.
        clock: The planning clock of the searches.
    """

    moves: Mapping[str, PlannedMove]
    direct: Mapping[str, Array | None]
    clock: PlanningClock

    def move_within(self, phase: str, limit_s: float) -> PlannedMove:
        """Planning result of a move under a shorter limit.

        A search is a prefix of the same search with a longer limit, so the result follows from the longer one.

        Args:
            phase: The move.
            limit_s: The planning limit; at most that of the search.
        """
        move = self.moves[phase]
        if move.outcome in (PlanOutcome.INVALID_START, PlanOutcome.INVALID_GOAL):
            return move
        counted = self.clock.kind is ClockKind.COUNTED
        budget = self.clock.checks_within(limit_s) if counted else move.checks
        in_time = move.checks <= budget if counted else move.search_time_s <= limit_s
        if move.outcome is not PlanOutcome.BUDGET_SPENT and in_time:
            return move
        return replace(
            move,
            outcome=PlanOutcome.BUDGET_SPENT,
            checks=budget,
            simplification_checks=0,
            search_time_s=limit_s,
            time_s=limit_s,
            path_rad=None,
            path_length_m=None,
            detail="",
            verification_checks=0,
            repairs=0,
            simplification_unlimited_from=0,
        )
