"""The cheapest repair of each requirement: how far its limit would have to move, and what would then win."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rgss.tradeoff.columns import condition_column, keeps
from rgss.tradeoff.conditions import Comparison
from rgss.tradeoff.conflicts import LimitChange, Repair
from rgss.tradeoff.program_orderings import ordering_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rgss.tradeoff.conditions import Condition
    from rgss.tradeoff.enumeration import Enumeration
    from rgss.tradeoff.preferences import Preferences


def find_repairs(preferences: Preferences, enumeration: Enumeration) -> tuple[Repair, ...]:
    """The cheapest repair of each requirement of an infeasible trade-off.

    Of a requirement with one limit, the new limit is the statistic that comes nearest to the present
    one among the alternatives that violate nothing else. Of one with several, each alternative
    asks for a change of those that it violates; the one that needs the smallest largest relative
    change is taken.

    Args:
        preferences: What is wanted.
        enumeration: Every alternative evaluated.

    Returns:
        A repair for each requirement, in their order.
    """
    found = []
    for place, requirement in enumerate(enumeration.requirements):
        others = np.delete(enumeration.violated, place, axis=1)
        only = enumeration.violated[:, place] & ~others.any(axis=1)
        conditions = [condition for condition in preferences.conditions if condition.requirement == requirement]
        found.append(_repair(preferences, enumeration, requirement, conditions, only))
    return tuple(found)


def _repair(
    preferences: Preferences,
    enumeration: Enumeration,
    requirement: str,
    conditions: list[Condition],
    only: NDArray[np.bool_],
) -> Repair:
    none = Repair(requirement=requirement, changes=(), unlocked=0, winner=None)
    if not conditions or not only.any():
        # Missing evidence has no limit that could move.
        return none
    columns = [condition_column(condition, enumeration.table) for condition in conditions]
    known = only & ~np.isnan(np.stack(columns)).any(axis=0)
    if not known.any():
        return none
    efforts = np.max([_effort(*pair) for pair in zip(conditions, columns, strict=True)], axis=0)
    row = int(np.flatnonzero(known)[efforts[known].argmin()])
    changed, changes = [], []
    for condition, column in zip(conditions, columns, strict=True):
        if condition.sense.holds(float(column[row]), condition.limit):
            changed.append((condition.sense, condition.limit))
            continue
        changed.append((condition.sense, float(column[row])))
        changes.append(
            LimitChange(
                demand=condition.demand, limit=condition.limit, needed=float(column[row]), unit=condition.limit_unit
            )
        )
    feasible = only.copy()
    for column, (sense, limit) in zip(columns, changed, strict=True):
        feasible &= keeps(sense, column, limit)
    # Regret is relative to what is feasible, which the repair changes.
    ordering = ordering_of(preferences.program, preferences, enumeration.table, feasible)
    tied = np.flatnonzero(ordering.best(feasible))
    return replace(
        none,
        changes=tuple(changes),
        unlocked=int(feasible.sum()),
        winner=int(enumeration.variants[tied[0]]) if tied.size else None,
    )


def _effort(condition: Condition, column: NDArray[np.float64]) -> NDArray[np.float64]:
    """How much of its limit a condition would have to give up for each alternative; 0 where it holds."""
    missing = condition.limit - column if condition.sense is Comparison.AT_LEAST else column - condition.limit
    scale = abs(condition.limit) or 1.0
    return np.where(keeps(condition.sense, column, condition.limit), 0.0, missing / scale)
