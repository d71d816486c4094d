"""What a measure is worth, and how much each measure weighs."""

from __future__ import annotations

import itertools
import math
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.errors import TradeoffError

WEIGHT_SUM_TOLERANCE = 1e-9
"""How far the weights may be from a sum of exactly 1."""

TIE_TOLERANCE = 1e-9
"""Alternatives whose weighted value is within it of the best are tied."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ValueFunction:
    """The value, from 0 to 1, of a measure: linear or piecewise linear between two anchors.

    The anchors are fixed by the requirement (its threshold and its goal), not by the sample, so
    the value of one alternative does not change when another comes or goes. More is better where
    ``best > worst``, less is better where ``best < worst``. Outside the anchors the value is cut
    to 0 and 1.

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
        if not math.isfinite(self.best - self.worst):
            raise TradeoffError(
                f"the value function of {self.measure!r} is not anchored: worst {self.worst:g}, best {self.best:g}",
                hint="give two finite numbers",
            )
        # A range below the smallest normal number has a slope that no float can hold.
        if abs(self.best - self.worst) < sys.float_info.min:
            raise TradeoffError(
                f"the value function of {self.measure!r} has no range: worst and best are both {self.best:g}",
                hint="set worst to what is worth nothing and best to what is worth 1, such as threshold and goal",
            )
        points = self.points
        for (quantity, value), (next_quantity, next_value) in itertools.pairwise(points):
            towards_best = (next_quantity - quantity) / (self.best - self.worst)
            # A NaN fails every comparison, so the conditions are stated as what must hold.
            if not (towards_best > 0.0 and next_value >= value):
                raise TradeoffError(
                    f"the value function of {self.measure!r} is out of order at ({next_quantity:g}, {next_value:g})",
                    hint="list points from worst to best, with values that do not fall and lie between 0 and 1",
                )

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """All points (quantity, value) from worst to best, the anchors included."""
        return ((self.worst, 0.0), *self.interior, (self.best, 1.0))

    def value_at(self, quantity: float) -> float:
        """The value of a quantity.

        Args:
            quantity: The measure of one alternative, in the measure's unit; finite.

        Returns:
            A number from 0 to 1.
        """
        direction = 1.0 if self.best > self.worst else -1.0
        points = self.points
        for (start, start_value), (end, end_value) in itertools.pairwise(points):
            if direction * quantity <= direction * start:
                return start_value
            if direction * quantity < direction * end:
                return start_value + (end_value - start_value) * ((quantity - start) / (end - start))
        return 1.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Weighting:
    """The weight of every measure in the value of an alternative.

    Attributes:
        weights: Weight by measure; none is negative and they sum to 1. A measure of weight 0 is
            listed but decides nothing, so it needs no evidence.

    Raises:
        TradeoffError: There are no weights, one is negative or not finite, or they do not sum to 1.
    """

    weights: Mapping[str, float] = field(hash=False)

    def __post_init__(self) -> None:
        if not self.weights:
            raise TradeoffError("there are no weights", hint="give a weight to at least one measure")
        for measure, weight in self.weights.items():
            if not (math.isfinite(weight) and weight >= 0.0):
                raise TradeoffError(f"the weight of {measure!r} is {weight:g}", hint="a weight is a number from 0 to 1")
        total = math.fsum(self.weights.values())
        if abs(total - 1.0) > WEIGHT_SUM_TOLERANCE:
            raise TradeoffError(
                f"the weights sum to {total:.12g}, not to 1",
                hint=f"change them by {1.0 - total:+.12g} in all, or divide each by {total:.12g}"
                if total > 0.0
                else "give a positive weight to at least one measure",
            )

    @property
    def deciding_measures(self) -> tuple[str, ...]:
        """The measures whose weight is above 0, in the order in which they are given."""
        return tuple(measure for measure, weight in self.weights.items() if weight > 0.0)
