"""Largest joint error of several assumed numbers that the choice survives, at their worst corner."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.milp import solve_linear
from rgss.tradeoff.problem import TIE_TOLERANCE, Array, Mask
from rgss.tradeoff.robustness.polygon_extremes import clip, lowest_separable, zonotope

PRECISION = 1e-9
"""Tolerance of the bisection of the factor."""

_SLACK = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BoxProblem:
    """A choice in which one measure is a sum of assumed numbers.

    The measure of alternative j is ``base_j + coefficients_j c``, for instance a total cost in the
    prices c. Every other measure is as it is.

    Attributes:
        base: Part of the measure that does not depend on the assumptions, shape (n,).
        coefficients: Shape (n, p).
        assumed: The assumed numbers c, shape (p,); none is negative.
        points: The measure's value function as points (quantity, value) by rising quantity,
            level outside of them, shape (k, 2).
        weight: The measure's weight.
        rest: The weighted value of all other measures, shape (n,); NaN only where not feasible.
        feasible: Mask of the alternatives that meet every threshold on other measures, shape (n,).
        at_least: The least quantity that the thresholds on the measure allow; -inf if any will do.
        at_most: The largest; inf if any will do.
    """

    base: Array
    coefficients: Array
    assumed: Array
    points: Array
    weight: float
    rest: Array
    feasible: Mask
    at_least: float
    at_most: float


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BoxRange:
    """Largest joint error of all assumed numbers.

    Attributes:
        factor: The largest x such that the choice stays best whatever the numbers are within
            ``c (1 - x)`` to ``c (1 + x)``; None where it does up to `most`.
        most: Up to where was looked; 1 is ±100 %.
        corner: Numbers at the edge of that box at which the choice is lost just beyond it, shape
            (p,); None where it is not lost.
        overtaken_by: The alternatives that are then as good, ascending; empty where the choice
            itself misses a threshold.
    """

    factor: float | None
    most: float
    corner: Array | None
    overtaken_by: tuple[int, ...]


def box_range(problem: BoxProblem, chosen: int, *, most: float = 1.0) -> BoxRange:
    """The largest relative error of all assumed numbers together that the choice survives.

    For each rival the least lead over the box is found exactly: the two quantities of the pair,
    the choice's and the rival's, range over a zonotope, and the lead is linear on each cell that
    the kinks of the value function cut from it. It shrinks as the box grows, so that bisection
    finds where it vanishes. A rival that a lower number would make feasible counts.

    Args:
        problem: The choice.
        chosen: The alternative that is best at the assumed numbers, alone or tied.
        most: The largest factor that is examined.

    Raises:
        TradeoffError: An assumed number is negative, or the choice is not best to begin with.
    """
    if (problem.assumed < 0.0).any():
        raise TradeoffError("a box of ±x % needs assumed numbers of at least 0", hint="vary negative ones alone")
    rivals = [int(row) for row in np.flatnonzero(problem.feasible) if row != chosen]
    if _violation(problem, chosen, 0.0) or any(_lead(problem, chosen, row, 0.0)[0] < -TIE_TOLERANCE for row in rivals):
        raise TradeoffError(
            f"alternative {chosen} is not the best at the assumed numbers", hint="pass the one that is best"
        )
    factor = most
    own = _violation(problem, chosen, most)
    if own:
        factor = _bisect(lambda x: _violation(problem, chosen, x), most)
    overtaken = False
    for rival in rivals:
        # A rival that does not draw level before the nearest one so far need not be bisected.
        if _lead(problem, chosen, rival, factor)[0] < -TIE_TOLERANCE:
            factor = _bisect(lambda x, rival=rival: _lead(problem, chosen, rival, x)[0] < -TIE_TOLERANCE, factor)  # type: ignore[misc]
            overtaken = True
    if not own and not overtaken:
        return BoxRange(factor=None, most=most, corner=None, overtaken_by=())
    edge = min(factor + 2.0 * PRECISION, most)
    first = [rival for rival in rivals if _lead(problem, chosen, rival, edge)[0] < -TIE_TOLERANCE]
    if not first:
        return BoxRange(factor=factor, most=most, corner=_own_corner(problem, chosen, factor), overtaken_by=())
    return BoxRange(
        factor=factor, most=most, corner=_corner(problem, chosen, first[0], edge), overtaken_by=tuple(first)
    )


def _bisect(lost: Callable[[float], bool], most: float) -> float:
    inside, outside = 0.0, most
    while outside - inside > PRECISION:
        middle = 0.5 * (inside + outside)
        if lost(middle):
            outside = middle
        else:
            inside = middle
    return inside


def _violation(problem: BoxProblem, chosen: int, factor: float) -> bool:
    """True if the choice itself can miss a threshold on the measure within the box."""
    centre = float(problem.base[chosen] + problem.coefficients[chosen] @ problem.assumed)
    reach = factor * float(np.abs(problem.coefficients[chosen] * problem.assumed).sum())
    slack = 1e-12 * max(1.0, abs(centre))
    return centre + reach > problem.at_most + slack or centre - reach < problem.at_least - slack


def _lead(problem: BoxProblem, chosen: int, rival: int, factor: float) -> tuple[float, NDArray[np.float64] | None]:
    """The least lead of the choice over a rival in the box, and the two quantities where it is."""
    pair = [chosen, rival]
    centre = problem.base[pair] + problem.coefficients[pair] @ problem.assumed
    polygon = zonotope(centre, factor * (problem.coefficients[pair] * problem.assumed).T)
    for limit, below in ((problem.at_most, True), (problem.at_least, False)):
        if math.isfinite(limit):
            polygon = clip(polygon, 1, limit, keep_below=below)
    if not len(polygon):
        return math.inf, None
    knots = problem.points[:, 0]

    def worth(quantity: NDArray[np.float64]) -> NDArray[np.float64]:
        return problem.weight * np.interp(quantity, knots, problem.points[:, 1])

    least, where = lowest_separable(polygon, knots, knots, worth, lambda quantity: -worth(quantity))
    return float(problem.rest[chosen] - problem.rest[rival]) + least, where


def _corner(problem: BoxProblem, chosen: int, rival: int, factor: float) -> Array | None:
    """Numbers in the box with the least lead over a rival; of several those that move the least in all.

    The lead is linear on each cell between kinks, so that a linear program finds them in each of
    the cells that meet where the least lead is.
    """
    least, where = _lead(problem, chosen, rival, factor)
    if where is None:
        return None
    moves = factor * problem.coefficients[[chosen, rival]] * problem.assumed
    centre = problem.base[[chosen, rival]] + problem.coefficients[[chosen, rival]] @ problem.assumed
    allowed = float(problem.rest[rival] - problem.rest[chosen]) + least + TIE_TOLERANCE / 2.0
    found: list[Array] = []
    for own in _cells(problem.points, float(where[0])):
        for other in _cells(problem.points, float(where[1])):
            # A rival counts only where it meets the thresholds.
            ends = np.array([own.low, own.high, max(other.low, problem.at_least), min(other.high, problem.at_most)])
            rows = np.vstack([-moves[0], moves[0], -moves[1], moves[1]])
            limits = np.array([-1.0, 1.0, -1.0, 1.0]) * (ends - centre[[0, 0, 1, 1]])
            slopes = problem.weight * np.array([own.slope, -other.slope])
            # w (v(q_i) - v(q_j)) <= allowed, with both values linear in the cell.
            level = problem.weight * (own.at(centre[0]) - other.at(centre[1]))
            answer = _least_moves(
                np.vstack([rows, slopes @ moves]), np.concatenate([limits, [allowed - level]]), len(problem.assumed)
            )
            if answer is not None:
                found.append(answer)
    if not found:
        return None
    best = min(found, key=lambda move: float(np.abs(move).sum()))
    return np.asarray(problem.assumed * (1.0 + factor * np.round(best, 9)), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class _Cell:
    """A piece of a value function on which it is linear."""

    low: float
    high: float
    slope: float
    knot: float
    value: float

    def at(self, quantity: float) -> float:
        return self.value + self.slope * (quantity - self.knot)


def _cells(points: Array, quantity: float) -> list[_Cell]:
    """The pieces that a quantity lies in; two at a kink."""
    knots, values = points[:, 0], points[:, 1]
    ends = [-math.inf, *knots, math.inf]
    slopes = [0.0, *(np.diff(values) / np.diff(knots)), 0.0]
    starts = [0, *range(len(knots))]
    near = 1e-9 * max(1.0, abs(quantity))
    return [
        _Cell(low=low, high=high, slope=float(slope), knot=float(knots[start]), value=float(values[start]))
        for low, high, slope, start in zip(ends, ends[1:], slopes, starts, strict=False)
        if low - near <= quantity <= high + near
    ]


def _least_moves(rows: Array, limits: Array, count: int) -> Array | None:
    """The t with |t_k| <= 1 and rows t <= limits whose absolute values sum to the least."""
    kept = np.isfinite(limits)
    scale = np.maximum(np.abs(rows[kept]).max(axis=1, initial=0.0), 1e-12)
    unit, nothing = np.eye(count), np.zeros((int(kept.sum()), count))
    answer = solve_linear(
        np.concatenate([np.zeros(count), np.ones(count)]),
        np.vstack(
            [np.hstack([rows[kept] / scale[:, None], nothing]), np.hstack([unit, -unit]), np.hstack([-unit, -unit])]
        ),
        np.concatenate([limits[kept] / scale + _SLACK, np.zeros(2 * count)]),
        np.zeros((0, 2 * count)),
        np.zeros(0),
        [(-1.0, 1.0)] * count + [(0.0, 1.0)] * count,
    )
    return None if answer is None else answer[:count]


def _own_corner(problem: BoxProblem, chosen: int, factor: float) -> Array:
    centre = float(problem.base[chosen] + problem.coefficients[chosen] @ problem.assumed)
    moves = problem.coefficients[chosen] * problem.assumed
    upward = centre + (factor + PRECISION) * float(np.abs(moves).sum()) > problem.at_most
    return np.asarray(problem.assumed * (1.0 + factor * np.sign(moves) * (1.0 if upward else -1.0)), dtype=np.float64)
