"""Exponential value functions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from pydantic import Field

from rgss.documents import DocumentModel
from rgss.errors import TradeoffError
from rgss.tradeoff.problem.values.anchors import Anchor, AnchorField
from rgss.tradeoff.problem.values.value_function import AnchoredBetween, MonotoneValue

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


STEEPEST_EXPONENT = 100.0
"""The largest curvature of an exponential value; beyond it the function is a step."""


class ExponentialKeys(DocumentModel):
    """Keys of an exponential value in a study, in addition to ``worst`` and ``best``."""

    halfway: AnchorField | None = Field(default=None, description="The level that is worth one half.")


@dataclass(frozen=True, slots=True, kw_only=True)
class ExponentialValue(MonotoneValue):
    """Exponential value function: the gain grows or shrinks steadily from worst to best.

    ``v(z) = (1 - exp(-ρ z)) / (1 - exp(-ρ))`` with ``z = (quantity - worst) / (best - worst)``, clipped to 0 and 1
    outside the anchors; ρ follows from the quantity of value one half, which can be elicited (Kirkwood, *Strategic
    Decision Making*, 1997, section 4.3). A quantity half-way in value that lies nearer to worst makes the function
    concave: the first gains count most.

    Attributes:
        halfway: The quantity of value 0.5, between them.

    Raises:
        TradeoffError: Worst and best are equal, or halfway is not well between them.
    """

    halfway: float

    def __post_init__(self) -> None:
        MonotoneValue.__post_init__(self)
        # At the largest curvature, half of the value lies within ln 2 / ρ of an anchor.
        nearest = math.log(2.0) / STEEPEST_EXPONENT
        if not nearest <= self.share(self.halfway) <= 1.0 - nearest:
            raise TradeoffError(
                f"the value function of {self.measure!r} has no half-way quantity at {self.halfway:g}",
                hint=f"name a quantity between {self.worst:g} and {self.best:g}, at least 1 % away from both",
            )

    @property
    def exponent(self) -> float:
        """The curvature ρ: positive where the function is concave, 0 where it is linear."""
        share = self.share(self.halfway)
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
        return _exponential(self.exponent, min(max(self.share(quantity), 0.0), 1.0))

    def values_at(self, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each of many quantities, shape (n,)."""
        import numpy as np

        share = np.clip((quantities - self.worst) / (self.best - self.worst), 0.0, 1.0)
        half = self.exponent / 2.0
        if abs(half) < 5e-10:
            return np.asarray(share, dtype=np.float64)
        # (1 - e^{-ρ z}) / (1 - e^{-ρ}), with a half of each exponent taken out.
        return np.asarray(np.exp(half * (1.0 - share)) * np.sinh(half * share) / np.sinh(half), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredExponential(AnchoredBetween):
    """An exponential value by its anchors.

    Attributes:
        halfway: The quantity worth one half.
    """

    required: ClassVar[tuple[str, ...]] = ("worst", "best", "halfway")
    own: ClassVar[tuple[str, ...]] = ("halfway",)
    label: ClassVar[str] = "'halfway'"

    halfway: Anchor

    def function(self, quantity_of: Callable[[Anchor], float]) -> ExponentialValue:
        """The value function; see `AnchoredValue.function`."""
        worst, best = quantity_of(self.worst), quantity_of(self.best)
        return ExponentialValue(measure=self.measure, worst=worst, best=best, halfway=quantity_of(self.halfway))


def _exponential(exponent: float, share: float) -> float:
    # Below this curvature the function and the straight line differ by less than a tie.
    return share if abs(exponent) < 1e-9 else math.expm1(-exponent * share) / math.expm1(-exponent)
