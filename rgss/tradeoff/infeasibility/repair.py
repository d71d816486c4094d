"""Cheapest repairs: changes of limits, single or joint, that make an alternative feasible, and the resulting choice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from rgss.tradeoff.infeasibility.conflicts import Conflicts, JointRepair, LimitChange, Repair
from rgss.tradeoff.problem import ChanceBound, Comparison, Threshold, chosen_of_equals
from rgss.tradeoff.programs import condition_column, keeps, ordering_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from rgss.tradeoff.problem import Condition, EvidenceTable
    from rgss.tradeoff.programs import Enumeration, Preferences

_SAME_EFFORT = 1e-9


def with_repairs(
    preferences: Preferences, enumeration: Enumeration, conflicts: Conflicts, *, last_of_equals: bool = False
) -> Conflicts:
    """Conflicts with their repairs, and with the evidence that no alternative has.

    Args:
        preferences: Preferences that the alternatives are compared by.
        enumeration: Every alternative evaluated.
        conflicts: The conflicts, from `find_conflicts`.
        last_of_equals: Whether the largest id of equals is chosen; the smallest otherwise.
    """
    return replace(
        conflicts,
        repairs=find_repairs(preferences, enumeration, last_of_equals=last_of_equals),
        joint_repairs=find_joint_repairs(
            preferences, enumeration, conflicts.corrections, last_of_equals=last_of_equals
        ),
        unmeasured=unmeasured_requirements(preferences, enumeration.table),
        unvalued=unvalued_measures(preferences, enumeration.table),
    )


def find_repairs(
    preferences: Preferences, enumeration: Enumeration, *, last_of_equals: bool = False
) -> tuple[Repair, ...]:
    """The cheapest repair of each requirement of an infeasible trade-off.

    Of a requirement with one limit, the new limit is the statistic that comes nearest to the present
    one among the alternatives that violate nothing else. Of one with several, each alternative
    needs a change of those that it violates; the one that needs the smallest largest relative
    change is taken.

    Args:
        preferences: Preferences that the alternatives are compared by.
        enumeration: Every alternative evaluated.
        last_of_equals: As for `with_repairs`.

    Returns:
        A repair for each requirement, in their order.
    """
    found = []
    for requirement in enumeration.requirements:
        changes, unlocked, winner = _mended(preferences, enumeration, (requirement,), last_of_equals=last_of_equals)
        found.append(Repair(requirement=requirement, changes=changes, unlocked=unlocked, winner=winner))
    return tuple(found)


def find_joint_repairs(
    preferences: Preferences,
    enumeration: Enumeration,
    corrections: Sequence[tuple[str, ...]],
    *,
    last_of_equals: bool = False,
) -> tuple[JointRepair, ...]:
    """The cheapest repair of each correction of an infeasible trade-off.

    Of the alternatives that violate just the requirements of a correction, the one that needs the
    smallest largest relative change of their limits.

    Args:
        preferences: Preferences that the alternatives are compared by.
        enumeration: Every alternative evaluated.
        corrections: The smallest sets of requirements without which something is feasible.
        last_of_equals: As for `with_repairs`.

    Returns:
        A repair for each correction, in their order.
    """
    found = []
    for requirements in corrections:
        changes, unlocked, winner = _mended(preferences, enumeration, requirements, last_of_equals=last_of_equals)
        found.append(JointRepair(requirements=requirements, changes=changes, unlocked=unlocked, winner=winner))
    return tuple(found)


def unmeasured_requirements(preferences: Preferences, table: EvidenceTable) -> tuple[str, ...]:
    """Requirements with a condition whose statistic is unknown for every alternative.

    Args:
        preferences: Preferences that the alternatives are compared by.
        table: The alternatives.

    Returns:
        Ids in the order of the conditions. Such a requirement excludes every alternative, though none is shown to
        violate it.
    """
    unknown = [one.requirement for one in preferences.conditions if np.isnan(condition_column(one, table)).all()]
    return tuple(dict.fromkeys(unknown))


def unvalued_measures(preferences: Preferences, table: EvidenceTable) -> tuple[str, ...]:
    """Weighted measures that are unknown for every alternative, in the order of the weights.

    Args:
        preferences: Preferences that the alternatives are compared by.
        table: The alternatives.
    """
    return tuple(one for one in preferences.weighting.deciding_measures if np.isnan(table.column(one)).all())


def winner_among(
    preferences: Preferences, table: EvidenceTable, feasible: NDArray[np.bool_], *, last_of_equals: bool
) -> int | None:
    """The alternative that is chosen of the feasible ones; None if there is none.

    Args:
        preferences: Preferences that the alternatives are compared by.
        table: The alternatives.
        feasible: Mask of the feasible ones, shape (n,).
        last_of_equals: As for `with_repairs`.
    """
    # Regret is relative to what is feasible, which a repair changes.
    tied = np.flatnonzero(ordering_of(preferences.program, preferences, table, feasible).best(feasible))
    return chosen_of_equals(table, preferences.deciding_functions, tied, last_of_equals=last_of_equals)


def _mended(
    preferences: Preferences, enumeration: Enumeration, requirements: Sequence[str], *, last_of_equals: bool
) -> tuple[tuple[LimitChange, ...], int, int | None]:
    """The changes of the limits of some requirements; how many are then feasible, and which is chosen."""
    none: tuple[tuple[LimitChange, ...], int, int | None] = ((), 0, None)
    places = [enumeration.requirements.index(requirement) for requirement in requirements]
    others = np.delete(enumeration.violated, places, axis=1)
    only = enumeration.violated[:, places].all(axis=1) & ~others.any(axis=1)
    conditions = [condition for condition in preferences.conditions if condition.requirement in requirements]
    if {condition.requirement for condition in conditions} != set(requirements):
        # Missing evidence has no limit that could move.
        return none
    # Only these are examined from here on, so that many corrections of many alternatives take no longer.
    table = enumeration.table.rows(np.flatnonzero(only))
    columns = [condition_column(condition, table) for condition in conditions]
    movable = np.all([_reachable(*pair) for pair in zip(conditions, columns, strict=True)], axis=0)
    if not movable.any():
        return none
    each = np.array([_effort(*pair) for pair in zip(conditions, columns, strict=True)])
    row = _least_effort(each, np.flatnonzero(movable))
    feasible = np.ones(len(table), dtype=np.bool_)
    changes = []
    for condition, column in zip(conditions, columns, strict=True):
        limit = condition.limit
        if not condition.sense.holds(float(column[row]), limit):
            limit = float(column[row])
            changes.append(_change(condition, limit))
        feasible &= keeps(condition.sense, column, limit)
    winner = winner_among(preferences, table, feasible, last_of_equals=last_of_equals)
    return tuple(changes), int(feasible.sum()), winner


def _change(condition: Condition, limit: float) -> LimitChange:
    """The change of a condition to another limit; of one with a tolerance, the change of what is required."""
    present, needed = condition.limit, limit
    if isinstance(condition, Threshold) and condition.required is not None:
        present, needed = condition.required, condition.required_for(limit)
    return LimitChange(
        requirement=condition.requirement,
        demand=condition.demand,
        limit=present,
        needed=needed,
        unit=condition.limit_unit,
    )


def _least_effort(each: NDArray[np.float64], movable: NDArray[np.intp]) -> int:
    """The alternative whose largest relative change of a limit is the smallest; of equals the least in total."""
    largest = each[:, movable].max(axis=0)
    least = largest.min()
    equals = movable[largest <= least + _SAME_EFFORT * max(1.0, abs(least))] if np.isfinite(least) else movable
    return int(equals[each[:, equals].sum(axis=0).argmin()])


def _reachable(condition: Condition, column: NDArray[np.float64]) -> NDArray[np.bool_]:
    """True where another limit would meet a condition: a statistic is known, and a chance is not 0."""
    # A chance of 0 demands nothing, so it cannot be suggested as a demand.
    return column > 0.0 if isinstance(condition, ChanceBound) else ~np.isnan(column)


def _effort(condition: Condition, column: NDArray[np.float64]) -> NDArray[np.float64]:
    """Relaxation of a condition's limit that each alternative needs; 0 where it holds."""
    missing = condition.limit - column if condition.sense is Comparison.AT_LEAST else column - condition.limit
    scale = abs(condition.limit) or 1.0
    return np.where(keeps(condition.sense, column, condition.limit), 0.0, missing / scale)
