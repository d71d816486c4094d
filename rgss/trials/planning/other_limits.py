"""Derivation of a plan under another check charge and other limits from existing searches."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rgss.evidence import PlanOutcome
from rgss.motion import ClockKind
from rgss.tasks import MoveKind
from rgss.trials.planning.planned_moves import PlannedMove, TaskPlan
from rgss.trials.settings import PlanningSettings

_WITHOUT_SEARCH = (PlanOutcome.INVALID_START, PlanOutcome.INVALID_GOAL)


def plan_with_limits(
    plan: TaskPlan, before: PlanningSettings, after: PlanningSettings, *, planned: Sequence[str], limit_s: float
) -> TaskPlan | None:
    """Plan of a trial under other settings, up to its planning limit.

    A search is a prefix of the same search with a larger budget, and depends on neither the charge of a check nor the
    limit. The same applies to a simplification whose limit refuses no check.

    Args:
        plan: The existing plan.
        before: The settings of the existing plan.
        after: The other settings; they may differ only in the charge, the search limit and the simplification limit.
        planned: Names of the planned moves of the task.
        limit_s: The planning limit of the trial, at most the search limit of `after`.

    Returns:
        The plan; None if the existing searches do not determine it: one ended before the limit, the limit of a
        simplification decides its result, or time is not counted in checks.
    """
    if {before.clock.kind, after.clock.kind} != {ClockKind.COUNTED}:
        return None
    budget = after.clock.checks_within(limit_s)
    moves: dict[str, PlannedMove] = {}
    kinds = after.kinds(planned)
    for phase in planned:
        move = plan.moves.get(phase)
        if move is None:
            break
        if move.outcome is PlanOutcome.BUDGET_SPENT and budget > move.checks:
            return None
        if move.outcome in _WITHOUT_SEARCH or move.outcome is PlanOutcome.BUDGET_SPENT or move.checks > budget:
            # It is the last move; the plan itself has its outcome under the limit.
            moves[phase] = move
            break
        timed = _timed(move, before, after, is_searched=kinds[phase] is MoveKind.PLANNED)
        if timed is None:
            return None
        moves[phase] = timed
    return TaskPlan(moves=moves, direct=plan.direct, clock=after.clock)


def _timed(
    move: PlannedMove, before: PlanningSettings, after: PlanningSettings, *, is_searched: bool
) -> PlannedMove | None:
    """Move with its times by another clock; None if its path could differ."""
    search_s, shortening_s = after.clock.time_s(move.checks), 0.0
    if not is_searched and move.checks == after.search_checks:
        return None  # Rounding decides whether the last check of a direct move is within the limit.
    if move.outcome is PlanOutcome.SOLVED and is_searched and after.simplification_checks:
        limit = after.clock.checks_within(after.simplification_limit_s)
        if limit != before.clock.checks_within(before.simplification_limit_s):
            least = move.simplification_unlimited_from
            if least is None or limit < least:
                return None
        shortening_s = min(after.clock.time_s(move.simplification_checks), after.simplification_limit_s)
    return replace(move, search_time_s=search_s, time_s=search_s + shortening_s)


def with_limits_of(settings: PlanningSettings, other: PlanningSettings) -> PlanningSettings:
    """Settings with the clock, the search limit and the simplification limit of others."""
    return replace(
        settings,
        clock=other.clock,
        search_limit_s=other.search_limit_s,
        simplification_limit_s=other.simplification_limit_s,
    )
