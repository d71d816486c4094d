"""The Pareto front, and which of its points some weights can choose."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from rgss.tradeoff.milp import solve_linear
from rgss.tradeoff.problem import Array, Mask, checked_values, classes, nondominated
from rgss.tradeoff.weights import THINNEST, Polytope, WeightSet, winning_polytope

SMALLEST_WEIGHT = 1e-6
"""A weight below it counts as zero: the solver's tolerance would pass for it."""


class Support(str, Enum):
    """Kind of Pareto optimality with respect to weighted sums, after Könen and Stiglmayr.

    "On supportedness in multi-objective combinatorial optimization", 2025, separates two notions that earlier work
    mixes: weights that are all positive, and weights of which some may be zero.

    Attributes:
        EXTREME: The only best one for some weights; a corner of the front's convex hull.
        SUPPORTED: Among the best for weights that are all positive, but never alone.
        WEAKLY_SUPPORTED: Among the best only where some weight is zero.
        UNSUPPORTED: On the front, and best for no weights.
        DOMINATED: Not on the front: another is at least as good in all measures and better in one.
    """

    EXTREME = "extreme"
    SUPPORTED = "supported"
    WEAKLY_SUPPORTED = "weakly_supported"
    UNSUPPORTED = "unsupported"
    DOMINATED = "dominated"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ParetoPoint:
    """One alternative and its place.

    Attributes:
        row: The alternative.
        support: Its place.
        shortfall: The least by which the best alternative is worth more, over all weights; 0 where
            it is best for some, None where it is dominated.
        dominated_by: The first alternative that dominates it; None on the front.
    """

    row: int
    support: Support
    shortfall: float | None
    dominated_by: int | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ParetoFront:
    """Every feasible alternative and its place.

    Attributes:
        points: One for each feasible alternative, by ascending row.
    """

    points: tuple[ParetoPoint, ...]

    @property
    def rows(self) -> tuple[int, ...]:
        """The alternatives on the front, ascending."""
        return tuple(point.row for point in self.points if point.support is not Support.DOMINATED)


def pareto_front(values: Array, feasible: Mask) -> ParetoFront:
    """Place every feasible alternative on the front or behind it.

    Dominance is decided by comparisons alone. Support is decided by linear programs over the
    weights: an alternative is among the best for some weights if and only if its region is not
    empty, alone if the region has an interior, and for positive weights if the largest least
    weight in the region is positive. Alternatives of the same values share their place.

    Args:
        values: The single values, shape (n, m), more being better; those of alternatives that are
            not feasible may be NaN.
        feasible: Mask of the alternatives that can be chosen, shape (n,).

    Raises:
        TradeoffError: A value of a feasible alternative is not a number from 0 to 1.
    """
    rows = np.flatnonzero(feasible)
    if not len(rows):
        return ParetoFront(points=())
    distinct, membership = classes(checked_values(values[rows]))
    front = nondominated(distinct)
    efficient = distinct[front]
    weights = WeightSet.simplex(distinct.shape[1])
    places: list[tuple[Support, float | None, int | None]] = []
    seen = 0
    for kind, is_efficient in enumerate(front):
        if is_efficient:
            places.append((*_support(efficient, seen, weights), None))
            seen += 1
            continue
        better = (distinct >= distinct[kind]).all(axis=1) & (distinct > distinct[kind]).any(axis=1)
        places.append((Support.DOMINATED, None, int(rows[membership == int(better.argmax())][0])))
    return ParetoFront(
        points=tuple(
            ParetoPoint(row=int(row), support=places[kind][0], shortfall=places[kind][1], dominated_by=places[kind][2])
            for row, kind in zip(rows, membership, strict=True)
        )
    )


def _support(values: Array, row: int, weights: WeightSet) -> tuple[Support, float]:
    region = winning_polytope(values, row, weights)
    ball = region.largest_ball()
    if ball is None:
        return Support.UNSUPPORTED, _shortfall(values, row)
    if ball[1] > THINNEST or not weights.directions().shape[1]:
        return Support.EXTREME, 0.0
    positive = _least_weight(region) > SMALLEST_WEIGHT
    return (Support.SUPPORTED if positive else Support.WEAKLY_SUPPORTED), 0.0


def _shortfall(values: Array, row: int) -> float:
    """The least t with (v_j - v_i) w <= t for every j and some weights w."""
    differences = np.delete(values, row, axis=0) - values[row]
    size = values.shape[1]
    answer = solve_linear(
        np.concatenate([np.zeros(size), [1.0]]),
        np.hstack([differences, -np.ones((len(differences), 1))]),
        np.zeros(len(differences)),
        np.concatenate([np.ones(size), [0.0]])[None, :],
        np.ones(1),
        [(0.0, None)] * size + [(None, None)],
    )
    return 0.0 if answer is None else float(answer[-1])


def _least_weight(region: Polytope) -> float:
    """The largest number below which no weight of some point of the region lies."""
    size = region.weights.size
    answer = solve_linear(
        np.concatenate([np.zeros(size), [-1.0]]),
        np.vstack(
            [
                np.hstack([region.rows, np.zeros((len(region.rows), 1))]),
                np.hstack([-np.eye(size), np.ones((size, 1))]),
            ]
        ),
        np.concatenate([region.limits + THINNEST, np.zeros(size)]),
        np.concatenate([np.ones(size), [0.0]])[None, :],
        np.ones(1),
        [(None, None)] * (size + 1),
    )
    return 0.0 if answer is None else float(answer[-1])
