"""Measures that are sums over levels: where the combinations are too many to list, they stay linear."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

from rgss.errors import TradeoffError
from rgss.requirements import RELATIVE_TOLERANCE, ZERO_TOLERANCE, Comparison
from rgss.tradeoff.problem import ValueFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearQuantity:
    """The quantity of a measure as a linear expression.

    Attributes:
        measure: The measure.
        expression: The CVXPY expression, in the measure's unit.
        low: The least that it can be.
        high: The most that it can be.
        require: Takes constraints on further variables that terms need.
        valued: The value by each function that was compiled, so that terms share its variables.
    """

    measure: str
    expression: Any
    low: float
    high: float
    require: Callable[[Any], None]
    valued: dict[ValueFunction, Any] = field(default_factory=dict)

    @property
    def span(self) -> float:
        """Its range, the scale of its constraints; 1 if it has none."""
        return self.high - self.low or 1.0


def value_of_sum(quantity: LinearQuantity, function: ValueFunction) -> Any:
    """The value of a linear quantity, as a CVXPY expression.

    The quantity lies in one of the segments between the points of the value function: a boolean
    variable says in which, and the quantity is that segment's (the multiple-choice model of
    piecewise linear functions; Vielma, Ahmed and Nemhauser, "Mixed-integer models for nonseparable
    piecewise-linear optimization", 2010).

    Raises:
        TradeoffError: The function is not piecewise linear.
    """
    if function.breakpoints is None:
        raise TradeoffError(
            f"{quantity.measure!r} is a sum over too many levels for a value that is not piecewise linear",
            hint="value it linearly, by points or by a target",
        )
    if function not in quantity.valued:
        quantity.valued[function] = _piecewise(quantity, function.breakpoints)
    return quantity.valued[function]


def _piecewise(quantity: LinearQuantity, points: Sequence[tuple[float, float]]) -> Any:
    import cvxpy
    import numpy as np

    segments = _segments(points, quantity.low, quantity.high)
    if len(segments) == 1:
        ((start, start_value), (end, end_value)) = segments[0]
        slope = (end_value - start_value) / (end - start) if end > start else 0.0
        return start_value + slope * (quantity.expression - start)
    starts = np.array([start for (start, _), _ in segments])
    ends = np.array([end for _, (end, _) in segments])
    values = np.array([value for (_, value), _ in segments])
    slopes = np.array([(after - before) / (end - start) for (start, before), (end, after) in segments])
    within = cvxpy.Variable(len(segments), boolean=True)
    parts = cvxpy.Variable(len(segments))
    span = quantity.span
    quantity.require(cvxpy.sum(within) == 1.0)
    quantity.require((cvxpy.sum(parts) - quantity.expression) / span == 0.0)
    quantity.require((parts - cvxpy.multiply(starts, within)) / span >= 0.0)
    quantity.require((parts - cvxpy.multiply(ends, within)) / span <= 0.0)
    return (values - slopes * starts) @ within + slopes @ parts


def limit_of_sum(quantity: LinearQuantity, sense: Comparison, limit: float) -> Any:
    """CVXPY constraint that a linear quantity keeps a limit."""
    slack = RELATIVE_TOLERANCE * abs(limit) if limit else ZERO_TOLERANCE
    distance = (quantity.expression - limit) / quantity.span
    return distance >= -slack / quantity.span if sense is Comparison.AT_LEAST else distance <= slack / quantity.span


def order_of_sum(quantity: LinearQuantity, sense: Comparison) -> Any:
    """A linear quantity as an objective that is maximised, on a scale from 0 to a million."""
    share = (quantity.expression - quantity.low) / quantity.span
    return 1e6 * (share if sense is Comparison.AT_LEAST else 1.0 - share)


def _segments(
    points: Sequence[tuple[float, float]], low: float, high: float
) -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """The segments of a function that lie within a range, level beyond its points."""
    (first, first_value), (last, last_value) = points[0], points[-1]
    line = list(points)
    if low < first:
        line.insert(0, (low, first_value))
    if high > last:
        line.append((high, last_value))
    found: list[tuple[tuple[float, float], tuple[float, float]]] = []
    for (start, start_value), (end, end_value) in itertools.pairwise(line):
        slope = (end_value - start_value) / (end - start)
        left, right = max(start, low), min(end, high)
        if left < right or (low == high == left == right and not found):
            found.append(((left, start_value + slope * (left - start)), (right, start_value + slope * (right - start))))
    return found
