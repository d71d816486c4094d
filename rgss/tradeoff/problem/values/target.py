"""Target value functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from pydantic import Field

from rgss.documents import DocumentModel
from rgss.errors import TradeoffError
from rgss.tradeoff.problem.values.anchors import Anchor, AnchorField
from rgss.tradeoff.problem.values.interpolation import Points, interpolated, interpolated_column
from rgss.tradeoff.problem.values.value_function import AnchoredValue, check_range

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class TargetKeys(DocumentModel):
    """Keys of a target value in a study."""

    target: AnchorField | None = Field(
        default=None, description="The level that is worth 1 where both more and less are worse."
    )
    too_low: AnchorField | None = Field(default=None, description="The level below the target that is worth 0.")
    too_high: AnchorField | None = Field(default=None, description="The level above the target that is worth 0.")


@dataclass(frozen=True, slots=True, kw_only=True)
class TargetValue:
    """Value function that is highest at a target and falls linearly on both sides.

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
            check_range(self.measure, end, self.target)
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
    def peak(self) -> float:
        """The target."""
        return self.target

    @property
    def breakpoints(self) -> Points:
        """The three points (quantity, value), by rising quantity."""
        return ((self.too_low, 0.0), (self.target, 1.0), (self.too_high, 0.0))

    def ends_at(self, quantity: float) -> tuple[float, float]:
        """The end that is too low or too high, on the side of a quantity, and the target."""
        return (self.too_low if quantity < self.target else self.too_high), self.target

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        return interpolated(self.breakpoints, quantity)

    def values_at(self, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each of many quantities, shape (n,)."""
        return interpolated_column(self.breakpoints, quantities)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredTarget(AnchoredValue):
    """A target value by its anchors.

    Attributes:
        measure: The measure.
        target: The quantity worth 1 from which the value falls on both sides.
        too_low: The quantity below the target that is worth 0.
        too_high: The quantity above the target that is worth 0.
    """

    required: ClassVar[tuple[str, ...]] = ("target", "too_low", "too_high")
    own: ClassVar[tuple[str, ...]] = ("target", "too_low", "too_high")
    label: ClassVar[str] = "a target"
    ends: ClassVar[tuple[str, str]] = ("too_low", "target")
    is_monotone: ClassVar[bool] = False

    measure: str
    target: Anchor
    too_low: Anchor
    too_high: Anchor

    def function(self, quantity_of: Callable[[Anchor], float]) -> TargetValue:
        """The value function; see `AnchoredValue.function`."""
        return TargetValue(
            measure=self.measure,
            target=quantity_of(self.target),
            too_low=quantity_of(self.too_low),
            too_high=quantity_of(self.too_high),
        )
