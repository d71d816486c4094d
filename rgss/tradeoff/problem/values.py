"""What a quantity of a measure is worth: linear, piecewise, exponential and target value functions.

Every function is anchored on quantities that are fixed beforehand (a requirement's threshold, a
goal), never on the sample, so the value of one alternative does not change when another comes or
goes, and no range of a sample is ever divided by.
"""

from __future__ import annotations

import itertools
import math
import sys
from dataclasses import dataclass
from typing import Protocol

from rgss.errors import TradeoffError

TIE_TOLERANCE = 1e-9
"""Alternatives whose value is within it of the best are tied."""

STEEPEST_EXPONENT = 100.0
"""The largest curvature of an exponential value; beyond it the function is a step."""


class ValueFunction(Protocol):
    """The value, from 0 to 1, of each quantity of one measure."""

    @property
    def measure(self) -> str:
        """The measure that is valued."""
        ...

    @property
    def more_is_better(self) -> bool | None:
        """Whether the value rises with the quantity; None where it rises and falls."""
        ...

    def value_at(self, quantity: float) -> float:
        """The value of a quantity.

        Args:
            quantity: The measure of one alternative, in the measure's unit; finite.

        Returns:
            A number from 0 to 1.
        """
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class PiecewiseValue:
    """A value that is linear, or piecewise linear, between two anchors.

    More is better where ``best > worst``, less is better where ``best < worst``. Outside the
    anchors the value is cut to 0 and 1.

    Attributes:
        measure: The measure that is valued.
        worst: The quantity worth 0, in the measure's unit.
        best: The quantity worth 1, in the measure's unit.
        interior: Further points (quantity, value) between worst and best, in that order; the
            value is linear between neighbours and never falls towards best.

    Raises:
        TradeoffError: There is no range between worst and best, or the points are out of order.
    """

    measure: str
    worst: float
    best: float
    interior: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        _check_anchors(self.measure, self.worst, self.best)
        for (quantity, value), (next_quantity, next_value) in itertools.pairwise(self.points):
            towards_best = (next_quantity - quantity) / (self.best - self.worst)
            # A NaN fails every comparison, so the conditions are stated as what must hold.
            if not (towards_best > 0.0 and next_value >= value):
                raise TradeoffError(
                    f"the value function of {self.measure!r} is out of order at ({next_quantity:g}, {next_value:g})",
                    hint="list points from worst to best, with values that do not fall and lie between 0 and 1",
                )

    @property
    def more_is_better(self) -> bool:
        """Whether the value rises with the quantity."""
        return self.best > self.worst

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """All points (quantity, value) from worst to best, the anchors included."""
        return ((self.worst, 0.0), *self.interior, (self.best, 1.0))

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        return _interpolated(self.points, quantity)


@dataclass(frozen=True, slots=True, kw_only=True)
class ExponentialValue:
    """A value whose gain grows or shrinks steadily from worst to best.

    ``v(z) = (1 - exp(-ρ z)) / (1 - exp(-ρ))`` with ``z = (quantity - worst) / (best - worst)``, cut
    to 0 and 1 outside of the anchors; ρ follows from the quantity that is worth one half, which is
    what people can be asked for (Kirkwood, *Strategic Decision Making*, 1997, section 4.3). A
    quantity half-way in value that lies nearer to worst makes the function concave: the first
    gains count most.

    Attributes:
        measure: The measure that is valued.
        worst: The quantity worth 0, in the measure's unit.
        best: The quantity worth 1, in the measure's unit.
        halfway: The quantity worth 0.5, between them.

    Raises:
        TradeoffError: There is no range between worst and best, or halfway is not well inside it.
    """

    measure: str
    worst: float
    best: float
    halfway: float

    def __post_init__(self) -> None:
        _check_anchors(self.measure, self.worst, self.best)
        # At the largest curvature, half of the value lies within ln 2 / ρ of an anchor.
        nearest = math.log(2.0) / STEEPEST_EXPONENT
        if not nearest <= self._share(self.halfway) <= 1.0 - nearest:
            raise TradeoffError(
                f"the value function of {self.measure!r} has no half-way quantity at {self.halfway:g}",
                hint=f"name a quantity between {self.worst:g} and {self.best:g}, at least 1 % away from both",
            )

    @property
    def more_is_better(self) -> bool:
        """Whether the value rises with the quantity."""
        return self.best > self.worst

    @property
    def exponent(self) -> float:
        """The curvature ρ: positive where the function is concave, 0 where it is linear."""
        share = self._share(self.halfway)
        low, high = -STEEPEST_EXPONENT, STEEPEST_EXPONENT
        # The value at a fixed share rises with ρ, so bisection finds the one at which it is a half.
        while True:
            middle = (low + high) / 2.0
            if middle in (low, high):
                return middle
            if _exponential(middle, share) < 0.5:
                low = middle
            else:
                high = middle

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        return _exponential(self.exponent, min(max(self._share(quantity), 0.0), 1.0))

    def _share(self, quantity: float) -> float:
        return (quantity - self.worst) / (self.best - self.worst)


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetValue:
    """A value that is highest at a target and falls linearly on both sides.

    Attributes:
        measure: The measure that is valued.
        target: The quantity worth 1, in the measure's unit.
        too_low: The quantity below the target at which nothing is left of the value.
        too_high: The quantity above the target at which nothing is left of the value.

    Raises:
        TradeoffError: The target does not lie between the two.
    """

    measure: str
    target: float
    too_low: float
    too_high: float

    def __post_init__(self) -> None:
        for end in (self.too_low, self.too_high):
            _check_anchors(self.measure, end, self.target)
        if not self.too_low < self.target < self.too_high:
            raise TradeoffError(
                f"the target {self.target:g} of {self.measure!r} is not between {self.too_low:g} and {self.too_high:g}",
                hint="give what is too low, the target and what is too high, in rising order",
            )

    @property
    def more_is_better(self) -> None:
        """Neither more nor less is better throughout."""
        return

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """The three points (quantity, value), by rising quantity."""
        return ((self.too_low, 0.0), (self.target, 1.0), (self.too_high, 0.0))

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        return _interpolated(self.points, quantity)


def _check_anchors(measure: str, worst: float, best: float) -> None:
    if not math.isfinite(best - worst):
        raise TradeoffError(
            f"the value function of {measure!r} is not anchored: worst {worst:g}, best {best:g}",
            hint="give two finite numbers",
        )
    # A range below the smallest normal number has a slope that no float can hold.
    if abs(best - worst) < sys.float_info.min:
        raise TradeoffError(
            f"the value function of {measure!r} has no range: worst and best are both {best:g}",
            hint="set worst to what is worth nothing and best to what is worth 1, such as threshold and goal",
        )


def _interpolated(points: tuple[tuple[float, float], ...], quantity: float) -> float:
    """The value at a quantity of points in rising or falling order; level outside of them."""
    direction = 1.0 if points[-1][0] > points[0][0] else -1.0
    for (start, start_value), (end, end_value) in itertools.pairwise(points):
        if direction * quantity <= direction * start:
            return start_value
        if direction * quantity < direction * end:
            return start_value + (end_value - start_value) * ((quantity - start) / (end - start))
    return points[-1][1]


def _exponential(exponent: float, share: float) -> float:
    # Below this curvature the function and the straight line differ by less than a tie.
    return share if abs(exponent) < 1e-9 else math.expm1(-exponent * share) / math.expm1(-exponent)
