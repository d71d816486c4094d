"""Bounds on weights: intervals and orders, as people state them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.weighting import WEIGHT_SUM_TOLERANCE

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, kw_only=True)
class ElicitedInterval:
    """The weight of a criterion lies in an interval.

    Attributes:
        name: The criterion: a measure or a group.
        measures: The measures whose weights sum to its weight.
        within: The measures of the group that its weight is a share of; empty for the whole.
        least: The smallest share, from 0 to 1.
        most: The largest share, from 0 to 1.

    Raises:
        TradeoffError: The interval is empty or leaves the range from 0 to 1.
    """

    name: str
    measures: tuple[str, ...]
    least: float
    most: float
    within: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if not 0.0 <= self.least <= self.most <= 1.0:
            raise TradeoffError(
                f"the weight of {self.name!r} cannot lie between {self.least:g} and {self.most:g}",
                hint="give the smaller and then the larger of two numbers from 0 to 1",
            )

    def rows(self) -> tuple[Mapping[str, float], ...]:
        """Coefficients of weights whose sums must not be above 0, or 1's share for the whole."""
        group = self.within
        upper = dict.fromkeys(group, -self.most)
        lower = dict.fromkeys(group, self.least)
        for measure in self.measures:
            upper[measure] = upper.get(measure, 0.0) + 1.0
            lower[measure] = lower.get(measure, 0.0) - 1.0
        return (upper, lower)

    def limits(self) -> tuple[float, float]:
        """The right-hand sides of `rows`."""
        return (0.0, 0.0) if self.within else (self.most, -self.least)


@dataclass(frozen=True, slots=True, kw_only=True)
class ElicitedOrder:
    """One criterion weighs at least a multiple of another.

    Attributes:
        heavier: Name of the one.
        heavier_measures: The measures whose weights sum to its weight.
        lighter: Name of the other.
        lighter_measures: Its measures.
        times: The multiple.

    Raises:
        TradeoffError: The multiple is not a positive number.
    """

    heavier: str
    heavier_measures: tuple[str, ...]
    lighter: str
    lighter_measures: tuple[str, ...]
    times: float = 1.0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.times) and self.times > 0.0):
            raise TradeoffError(
                f"{self.heavier!r} cannot weigh {self.times:g} times {self.lighter!r}", hint="give a positive number"
            )

    def row(self) -> Mapping[str, float]:
        """Coefficients of weights whose sum must not be above 0."""
        found = dict.fromkeys(self.lighter_measures, self.times)
        for measure in self.heavier_measures:
            found[measure] = found.get(measure, 0.0) - 1.0
        return found


@dataclass(frozen=True, slots=True, kw_only=True)
class WeightBounds:
    """Admitted weights: all elicited bounds, in addition to the sum of 1."""

    intervals: tuple[ElicitedInterval, ...] = ()
    orders: tuple[ElicitedOrder, ...] = ()

    def check(self, weights: Mapping[str, float]) -> None:
        """Check that weights agree with the bounds.

        Raises:
            TradeoffError: They do not, so weights and bounds contradict each other.
        """
        for interval in self.intervals:
            whole = math.fsum(weights[measure] for measure in interval.within) if interval.within else 1.0
            weight = math.fsum(weights[measure] for measure in interval.measures)
            slack = WEIGHT_SUM_TOLERANCE * whole
            if not interval.least * whole - slack <= weight <= interval.most * whole + slack:
                share = weight / whole if whole else 0.0
                raise TradeoffError(
                    f"the weight of {interval.name!r} is {share:g}, outside of its bounds {interval.least:g} to "
                    f"{interval.most:g}",
                    hint="change the weight or the bounds",
                )
        for order in self.orders:
            heavier = math.fsum(weights[measure] for measure in order.heavier_measures)
            lighter = math.fsum(weights[measure] for measure in order.lighter_measures)
            if heavier < order.times * lighter - WEIGHT_SUM_TOLERANCE:
                times = "" if order.times == 1.0 else f"{order.times:g} times "
                raise TradeoffError(
                    f"the weight of {order.heavier!r} is {heavier:g}, below {times}that of {order.lighter!r}, "
                    f"{lighter:g}",
                    hint="change the weights or their order",
                )

    def system(self, measures: Sequence[str]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The bounds as a system of linear inequalities ``A w <= b``, a fixed weight as two of them.

        Neither ``w >= 0`` nor ``sum(w) = 1`` is part of it.

        Args:
            measures: The measures, in the order of the columns.

        Returns:
            The matrix A, shape (k, m), and the right-hand side b, shape (k,).
        """
        import numpy as np

        bounds: list[tuple[Mapping[str, float], float]] = []
        for interval in self.intervals:
            if interval.least < interval.most:
                bounds += zip(interval.rows(), interval.limits(), strict=True)
        bounds += [(order.row(), 0.0) for order in self.orders]
        fixed = [interval for interval in self.intervals if interval.least == interval.most]
        bounds += [(interval.rows()[end], interval.limits()[end]) for end in (0, 1) for interval in fixed]
        matrix = np.array([[row.get(measure, 0.0) for measure in measures] for row, _ in bounds], dtype=np.float64)
        return matrix.reshape(len(bounds), len(measures)), np.array([limit for _, limit in bounds], dtype=np.float64)
