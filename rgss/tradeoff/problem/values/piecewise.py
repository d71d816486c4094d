"""Linear and piecewise linear value functions."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, ClassVar

from pydantic import Field

from rgss.documents import DocumentModel
from rgss.errors import TradeoffError
from rgss.tradeoff.problem.values.anchors import Anchor, AnchorField, PointEntry
from rgss.tradeoff.problem.values.interpolation import Points, interpolated, interpolated_column
from rgss.tradeoff.problem.values.value_function import AnchoredBetween, MonotoneValue

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class PiecewiseKeys(DocumentModel):
    """Keys of a piecewise linear value in a study."""

    worst: AnchorField | None = Field(default=None, description="The level that is worth 0.")
    best: AnchorField | None = Field(default=None, description="The level that is worth 1.")
    between: Annotated[tuple[PointEntry, ...], Field(min_length=1)] | None = Field(
        default=None, description="Points of the value function between worst and best."
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class PiecewiseValue(MonotoneValue):
    """Linear or piecewise linear value function between two anchors.

    More is better where ``best > worst``, less is better where ``best < worst``. Outside the anchors the value is
    clipped to 0 and 1.

    Attributes:
        interior: Further points (quantity, value) between worst and best, in that order; the value is linear between
        neighbours and non-decreasing towards best.

    Raises:
        TradeoffError: Worst and best are equal, or the points are out of order.
    """

    interior: tuple[tuple[float, float], ...] = ()

    def __post_init__(self) -> None:
        MonotoneValue.__post_init__(self)
        for (quantity, value), (next_quantity, next_value) in itertools.pairwise(self.points):
            towards_best = (next_quantity - quantity) / (self.best - self.worst)
            # A NaN fails every comparison, so the conditions are stated as what must hold.
            if not (towards_best > 0.0 and next_value >= value):
                raise TradeoffError(
                    f"the value function of {self.measure!r} is out of order at ({next_quantity:g}, {next_value:g})",
                    hint="list points from worst to best, with values that do not fall and lie between 0 and 1",
                )

    @property
    def breakpoints(self) -> Points:
        """The points by rising quantity."""
        return tuple(sorted(self.points))

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """All points (quantity, value) from worst to best, the anchors included."""
        return ((self.worst, 0.0), *self.interior, (self.best, 1.0))

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        return interpolated(self.points, quantity)

    def values_at(self, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each of many quantities, shape (n,)."""
        return interpolated_column(self.breakpoints, quantities)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredPiecewise(AnchoredBetween):
    """Linear value function with anchors; piecewise linear with points between.

    Attributes:
        between: Points: quantities and their values.
    """

    required: ClassVar[tuple[str, ...]] = ("worst", "best")
    optional: ClassVar[tuple[str, ...]] = ("between",)
    own: ClassVar[tuple[str, ...]] = ("between",)
    label: ClassVar[str] = "'between'"

    between: tuple[tuple[Anchor, float], ...] = ()

    def function(self, quantity_of: Callable[[Anchor], float]) -> PiecewiseValue:
        """The value function; see `AnchoredValue.function`."""
        worst, best = quantity_of(self.worst), quantity_of(self.best)
        interior = tuple((quantity_of(at), worth) for at, worth in self.between)
        return PiecewiseValue(measure=self.measure, worst=worst, best=best, interior=interior)
