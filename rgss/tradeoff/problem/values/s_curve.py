"""S-shaped value functions."""

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

STEEPNESS = 10.0
"""Range from worst to best in units of the logistic function's scale."""


class SCurveKeys(DocumentModel):
    """Keys of an S-shaped value in a study, in addition to ``worst`` and ``best``."""

    steepest: AnchorField | None = Field(default=None, description="The level at which a change counts most.")


@dataclass(frozen=True, slots=True, kw_only=True)
class SCurveValue(MonotoneValue):
    """Logistic value function: small gains near both anchors, the greatest at the steepest quantity.

    ``v(z) = (s(z) - s(0)) / (s(1) - s(0))`` with ``z = (quantity - worst) / (best - worst)``, clipped to 0 and 1
    outside the anchors, ``s(z) = tanh(k (z - c) / 2)``, ``k = 10`` and ``c`` the share of the steepest quantity; it has
    the form of the scoring functions of Wymore (*Model-Based Systems Engineering*, 1993).

    Attributes:
        steepest: The quantity between them with the greatest slope.

    Raises:
        TradeoffError: Worst and best are equal, or steepest is not between them.
    """

    steepest: float

    def __post_init__(self) -> None:
        MonotoneValue.__post_init__(self)
        if not 0.0 < self.share(self.steepest) < 1.0:
            raise TradeoffError(
                f"the steepest quantity {self.steepest:g} of {self.measure!r} is not between "
                f"{self.worst:g} and {self.best:g}",
                hint="name the quantity at which a change counts most",
            )

    def value_at(self, quantity: float) -> float:
        """The value of a quantity, from 0 to 1."""
        at = min(max(self.share(quantity), 0.0), 1.0)
        centre = self.share(self.steepest)
        low, here, high = (math.tanh(STEEPNESS * (share - centre) / 2.0) for share in (0.0, at, 1.0))
        return (here - low) / (high - low)

    def values_at(self, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each of many quantities, shape (n,)."""
        import numpy as np

        at = np.clip((quantities - self.worst) / (self.best - self.worst), 0.0, 1.0)
        # The same by the addition theorem: tanh a - tanh b = sinh(a - b) / (cosh a cosh b).
        centre, half = self.share(self.steepest), STEEPNESS / 2.0
        scale = math.cosh(half * (1.0 - centre)) / math.sinh(half)
        return np.asarray(scale * np.sinh(half * at) / np.cosh(half * (at - centre)), dtype=np.float64)


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredSCurve(AnchoredBetween):
    """An S-shaped value by its anchors.

    Attributes:
        steepest: The quantity at which a change counts most.
    """

    required: ClassVar[tuple[str, ...]] = ("worst", "best", "steepest")
    own: ClassVar[tuple[str, ...]] = ("steepest",)
    label: ClassVar[str] = "'steepest'"

    steepest: Anchor

    def function(self, quantity_of: Callable[[Anchor], float]) -> SCurveValue:
        """The value function; see `AnchoredValue.function`."""
        worst, best = quantity_of(self.worst), quantity_of(self.best)
        return SCurveValue(measure=self.measure, worst=worst, best=best, steepest=quantity_of(self.steepest))
