"""Value functions bent to be concave or convex."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.values.anchors import Anchor
from rgss.tradeoff.problem.values.exponential import STEEPEST_EXPONENT
from rgss.tradeoff.problem.values.value_function import AnchoredValue, ValueFunction

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

STRAIGHT = 1e-9
"""Below this curvature the bent and the straight function differ by less than a tie."""


def bent_values(values: NDArray[np.float64], curvature: float) -> NDArray[np.float64]:
    """Values mapped through an exponential that keeps 0 and 1.

    ``g(v) = (1 - exp(-c v)) / (1 - exp(-c))``. A linear value function so becomes the exponential one of
    Kirkwood, *Strategic Decision Making*, 1997, section 4.3, whose risk tolerance is ``ρ = R / c`` with R the
    range from worst to best: with c > 0 it is concave (the first gains count most), with c < 0 convex.

    Args:
        values: Values from 0 to 1, any shape; NaN where unknown.
        curvature: The curvature c; 0 leaves the values as they are.
    """
    import numpy as np

    if abs(curvature) < STRAIGHT:
        return values
    return np.asarray(np.expm1(-curvature * values) / math.expm1(-curvature), dtype=np.float64)


def half_value_share(curvature: float) -> float:
    """The share of the range from worst to best at which a linear function, bent so, is worth one half."""
    if abs(curvature) < STRAIGHT:
        return 0.5
    return -math.log1p(0.5 * math.expm1(-curvature)) / curvature


@dataclass(frozen=True, slots=True, kw_only=True)
class BentFunction:
    """Value function whose values are mapped by `bent_values`.

    Attributes:
        straight: The function before it is bent.
        curvature: The curvature c, not 0.
    """

    straight: ValueFunction
    curvature: float

    @property
    def measure(self) -> str:
        """The measure that is valued."""
        return self.straight.measure

    @property
    def more_is_better(self) -> bool | None:
        """As before: the mapping rises."""
        return self.straight.more_is_better

    @property
    def peak(self) -> float | None:
        """As before: the mapping keeps 1."""
        return self.straight.peak

    @property
    def breakpoints(self) -> None:
        """None: the function is curved."""
        return

    def ends_at(self, quantity: float) -> tuple[float, float]:
        """As before: the mapping keeps 0 and 1."""
        return self.straight.ends_at(quantity)

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        return math.expm1(-self.curvature * self.straight.value_at(quantity)) / math.expm1(-self.curvature)

    def values_at(self, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each of many quantities, shape (n,)."""
        return bent_values(self.straight.values_at(quantities), self.curvature)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredBent(AnchoredValue):
    """A value function by its anchors, bent by a curvature; not a shape of its own in a study.

    Attributes:
        measure: The measure.
        straight: The function before it is bent.
        curvature: The curvature c of `bent_values`.

    Raises:
        TradeoffError: The curvature is not finite, or so large that the function is a step.
    """

    required: ClassVar[tuple[str, ...]] = ()
    own: ClassVar[tuple[str, ...]] = ()
    label: ClassVar[str] = "a curvature"

    measure: str
    straight: AnchoredValue
    curvature: float

    def __post_init__(self) -> None:
        if not abs(self.curvature) <= STEEPEST_EXPONENT:
            raise TradeoffError(
                f"curvature of the value of {self.measure!r} must be from {-STEEPEST_EXPONENT:g} to "
                f"{STEEPEST_EXPONENT:g}, got {self.curvature:g}",
                hint="beyond it the value is a step",
            )

    @property
    def ends(self) -> tuple[str, str]:  # type: ignore[override]  # The shape before it is bent decides.
        """The keys of a quantity worth 0 and of one worth 1."""
        return self.straight.ends

    @property
    def anchors(self) -> Mapping[str, Anchor]:
        """The anchors of the function before it is bent."""
        return self.straight.anchors

    @property
    def worst_anchor(self) -> Anchor:
        """An anchor worth 0."""
        return self.straight.worst_anchor

    @property
    def best_anchor(self) -> Anchor:
        """The anchor worth 1."""
        return self.straight.best_anchor

    def with_anchor(self, key: str, quantity: float) -> AnchoredBent:
        """The same with another quantity at a key of `anchors`."""
        return replace(self, straight=self.straight.with_anchor(key, quantity))

    def function(self, quantity_of: Callable[[Anchor], float]) -> ValueFunction:
        """The value function; see `AnchoredValue.function`."""
        straight = self.straight.function(quantity_of)
        return straight if abs(self.curvature) < STRAIGHT else BentFunction(straight=straight, curvature=self.curvature)
