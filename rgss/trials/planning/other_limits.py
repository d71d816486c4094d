"""Plan under another charge of a check and other limits, read off the searches that were made."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rgss.evidence import PlanOutcome
from rgss.motion import ClockKind
from rgss.tasks import MoveKind
from rgss.trials.planning.planned_moves import PlannedMove, TaskPlan
from rgss.trials.settings import PlanningSettings

_WITHOUT_SEARCH = (PlanOutcome.INVALID_START, PlanOutcome.INVALID_GOAL)


def plan_under(
    plan: TaskPlan, before: PlanningSettings, after: PlanningSettings, *, planned: Sequence[str], limit_s: float
) -> TaskPlan | None:
    """The plan of a trial under other settings, as far as its planning limit lets it go.

    A search is a prefix of the same search with a larger budget, and depends on neither the charge of a check nor the
    limit. So is a simplification whose limit refuses it nothing.

    Args:
        plan: The plan that was made.
        before: The settings that it was made with.
        after: The other settings; they may differ in the charge, the search limit and the simplification limit alone.
        planned: Names of the planned moves of the task.
        limit_s: The planning limit of the trial, at most the search limit of `after`.

    Returns:
        The plan; None if the stored searches do not tell: one ended before the limit, the limit of a simplification
        decides its result, or time is not counted in checks.
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
            # Nothing comes after it; the plan itself tells what the limit makes of it.
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
    """A move with its times by another clock; None if its path could be another."""
    search_s, shortening_s = after.clock.time_s(move.checks), 0.0
    if not is_searched and move.checks == after.search_checks:
        return None  # Whether the last check of a direct move is in time is a matter of rounding.
    if move.outcome is PlanOutcome.SOLVED and is_searched and after.simplification_checks:
        limit = after.clock.checks_within(after.simplification_limit_s)
        if limit != before.clock.checks_within(before.simplification_limit_s):
            least = move.simplification_unlimited_from
            if least is None or limit < least:
                return None
        shortening_s = min(after.clock.time_s(move.simplification_checks), after.simplification_limit_s)
    return replace(move, search_time_s=search_s, time_s=search_s + shortening_s)


def with_limits_of(settings: PlanningSettings, other: PlanningSettings) -> PlanningSettings:
    """The settings with the clock, the search limit and the simplification limit of others.

    Args:
        settings: The settings.
        other: Those whose clock and limits are taken.
    """
    return replace(
        settings,
        clock=other.clock,
        search_limit_s=other.search_limit_s,
        simplification_limit_s=other.simplification_limit_s,
    )
