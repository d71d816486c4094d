"""Bounds on a stage's objective, and whether its constraints can hold, over intervals of quantities.

Interval arithmetic in NumPy, independent of the compiled program. Where an interval is a point, the bound
is the objective itself and the constraints hold or do not.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import (
    Constraint,
    EvidenceConstraint,
    ObjectiveTerm,
    QuantityRank,
    Stage,
    WeightedValue,
    WorstOf,
)
from rgss.tradeoff.problem import ChanceBound, Comparison, Risk, TailBound, Threshold
from rgss.tradeoff.programs import keeps

Column = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Intervals:
    """Interval of a measure's quantity for each of n partial designs.

    Attributes:
        low: Lower ends, shape (n,).
        high: Upper ends, shape (n,); below `low` where the quantity is unknown.
    """

    low: Column
    high: Column

    @property
    def known(self) -> Mask:
        """Mask of where the quantity can be known."""
        return np.asarray(self.low <= self.high)


Quantities = Callable[[str], Intervals]


def stage_bound(stage: Stage, constraints: Sequence[Constraint], quantities: Quantities) -> Column:
    """Upper bound on a stage's objective for each partial design.

    Args:
        stage: The stage. Of one that optimises a quantity, the quantity with the sign of the aim takes the
            place of its rank.
        constraints: The constraints of every stage.
        quantities: The intervals of each measure.

    Returns:
        Bounds, shape (n,); minus infinity where a constraint cannot hold.
    """
    bound = sum((objective_bound(term, quantities) for term in stage.objective), start=np.float64(0.0))
    possible = np.ones(np.shape(bound), dtype=np.bool_)
    for constraint in (*constraints, *stage.constraints):
        possible &= can_hold(constraint, quantities)
    return np.where(possible & ~np.isnan(bound), bound, -np.inf)


@singledispatch
def objective_bound(term: ObjectiveTerm, quantities: Quantities) -> Column:  # noqa: ARG001 - read by the terms' own
    """Upper bound of an objective term, shape (n,).

    Raises:
        TradeoffError: The kind of term has no bound.
    """
    raise TradeoffError(
        f"an objective with {type(term).__name__} has no independent bound", hint="register one with objective_bound"
    )


@objective_bound.register
def _(term: WeightedValue, quantities: Quantities) -> Column:
    if term.replicate is not None:
        raise TradeoffError("levels that are chosen by tables have no replicates", hint="value the estimates")
    of = quantities(term.function.measure)
    # A measure that cannot be known has no value; the constraints exclude it.
    low, high = np.where(of.known, of.low, 0.0), np.where(of.known, of.high, 0.0)
    best = np.maximum(term.function.values_at(low), term.function.values_at(high))
    peak = term.function.peak
    if peak is not None:
        best = np.where((low <= peak) & (peak <= high), 1.0, best)
    return np.asarray(term.weight * best)


@objective_bound.register
def _(term: QuantityRank, quantities: Quantities) -> Column:
    of = quantities(term.measure)
    return np.asarray(np.where(of.known, of.high if term.sense is Comparison.AT_LEAST else -of.low, -np.inf))


@objective_bound.register
def _(term: WorstOf, quantities: Quantities) -> Column:
    sums = [
        constant + sum((objective_bound(one, quantities) for one in terms), start=np.float64(0.0))
        for constant, terms in term.scenarios
    ]
    return np.asarray(np.minimum.reduce(sums))


@singledispatch
def can_hold(constraint: Constraint, quantities: Quantities) -> Mask:  # noqa: ARG001 - read by the terms' own
    """True where a constraint can be satisfied, shape (n,).

    Raises:
        TradeoffError: The kind of constraint has no such test.
    """
    raise TradeoffError(
        f"a constraint of the kind {type(constraint).__name__} has no independent test",
        hint="register one with can_hold",
    )


@can_hold.register
def _(constraint: Threshold, quantities: Quantities) -> Mask:
    of = quantities(constraint.measure)
    end = of.high if constraint.sense is Comparison.AT_LEAST else of.low
    return np.asarray(of.known & keeps(constraint.sense, np.where(of.known, end, 0.0), constraint.limit))


@can_hold.register(ChanceBound)
@can_hold.register(TailBound)
def _(constraint: Risk, quantities: Quantities) -> Mask:  # noqa: ARG001
    raise TradeoffError("levels that are chosen by tables have no replicates", hint="bound the estimates")


@can_hold.register
def _(constraint: EvidenceConstraint, quantities: Quantities) -> Mask:
    return quantities(constraint.measure).known


def shortfall_of(constraint: Constraint, quantities: Quantities) -> Column:
    """By how much a constraint fails at least, shape (n,), in the measure's unit; 1 where it is unknown."""
    possible = can_hold(constraint, quantities)
    if not isinstance(constraint, Threshold):
        return np.where(possible, 0.0, 1.0)
    of = quantities(constraint.measure)
    end = of.high if constraint.sense is Comparison.AT_LEAST else of.low
    return np.where(possible, 0.0, np.where(of.known, np.abs(np.where(of.known, end, 0.0) - constraint.limit), 1.0))
