"""Protocols of value functions: the function of quantities, and its form with anchors."""

from __future__ import annotations

import math
import sys
from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.values.anchors import Anchor

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

TIE_TOLERANCE = 1e-9
"""Alternatives whose value is within it of the best are tied."""


class ValueFunction(Protocol):
    """Value, from 0 to 1, of each quantity of one measure."""

    @property
    def measure(self) -> str:
        """The measure that is valued."""
        ...

    @property
    def more_is_better(self) -> bool | None:
        """True if the value rises with the quantity; None where it rises and falls."""
        ...

    @property
    def peak(self) -> float | None:
        """The quantity worth 1 where both more and less are worth less; None where the function is monotone."""
        ...

    @property
    def breakpoints(self) -> tuple[tuple[float, float], ...] | None:
        """Points (quantity, value) by rising quantity, linear between and level beyond; None where it is curved."""
        ...

    def ends_at(self, quantity: float) -> tuple[float, float]:
        """The quantities worth 0 and 1 on the side of a quantity."""
        ...

    def __hash__(self) -> int:
        """Hash consistent with equality, for caches keyed by functions."""
        ...

    def value_at(self, quantity: float) -> float:
        """The value of a quantity.

        Args:
            quantity: The measure of one alternative, in the measure's unit; finite.

        Returns:
            A number from 0 to 1.
        """
        ...

    def values_at(self, quantities: NDArray[np.float64]) -> NDArray[np.float64]:
        """The value of each of many quantities, computed in NumPy and apart from `value_at`.

        Args:
            quantities: Quantities, shape (n,); NaN where unknown.

        Returns:
            Values from 0 to 1, shape (n,); NaN where the quantity is.
        """
        ...


@dataclass(frozen=True, slots=True, kw_only=True)
class MonotoneValue:
    """Base class of the monotone value functions between two anchors.

    Attributes:
        measure: The valued measure.
        worst: The quantity of value 0, in the measure's unit.
        best: The quantity of value 1, in the measure's unit.

    Raises:
        TradeoffError: Worst and best are equal.
    """

    measure: str
    worst: float
    best: float

    def __post_init__(self) -> None:
        check_range(self.measure, self.worst, self.best)

    @property
    def more_is_better(self) -> bool:
        """True if the value rises with the quantity."""
        return self.best > self.worst

    @property
    def peak(self) -> None:
        """None: the function is monotone."""
        return

    @property
    def breakpoints(self) -> tuple[tuple[float, float], ...] | None:
        """None where the function is curved."""
        return None

    def ends_at(self, _quantity: float) -> tuple[float, float]:
        """Worst and best, at every quantity."""
        return self.worst, self.best

    def share(self, quantity: float) -> float:
        """Position of a quantity between the anchors: 0 at worst, 1 at best."""
        return (quantity - self.worst) / (self.best - self.worst)


class AnchoredValue(ABC):
    """Base of the frozen dataclasses that state a value function by its anchors, one for each shape.

    The fields of a dataclass are the shape's keys in a study; `keys` with a default of None or ``()``
    are optional.

    Attributes:
        measure: The measure that is valued.
        required: Keys that the shape needs.
        optional: Further keys that it may have.
        numbers: Those of the keys that are pure numbers, such as an exponent, and no anchors.
        own: Keys of which each marks an entry as being of this shape.
        label: The shape in messages, before a key that does not belong to it.
        ends: The keys of a quantity worth 0 and of one worth 1.
        is_monotone: Whether the value only rises, or only falls, with the quantity.
    """

    __slots__ = ()

    required: ClassVar[tuple[str, ...]]
    optional: ClassVar[tuple[str, ...]] = ()
    numbers: ClassVar[tuple[str, ...]] = ()
    own: ClassVar[tuple[str, ...]]
    label: ClassVar[str]
    ends: ClassVar[tuple[str, str]]
    is_monotone: ClassVar[bool] = True

    measure: str

    @abstractmethod
    def function(self, quantity_of: Callable[[Anchor], float]) -> ValueFunction:
        """The value function.

        Args:
            quantity_of: Quantity of an anchor, in the measure's unit.

        Raises:
            TradeoffError: The anchors make no value function.
        """

    @property
    def anchors(self) -> Mapping[str, Anchor]:
        """The anchors that have a key of their own, by key."""
        found = {key: getattr(self, key) for key in (*self.required, *self.optional) if key not in self.numbers}
        return {key: anchor for key, anchor in found.items() if anchor is not None and not isinstance(anchor, tuple)}

    @property
    def worst_anchor(self) -> Anchor:
        """An anchor worth 0."""
        return self.anchors[self.ends[0]]

    @property
    def best_anchor(self) -> Anchor:
        """The anchor worth 1."""
        return self.anchors[self.ends[1]]

    def with_anchor(self, key: str, quantity: float) -> AnchoredValue:
        """The same with another quantity at a key of `anchors`."""
        moved: dict[str, Any] = {key: quantity}
        return replace(self, **moved)  # type: ignore[type-var]


@dataclass(frozen=True, slots=True, kw_only=True)
class AnchoredBetween(AnchoredValue):
    """Base of the shapes between a quantity worth 0 and one worth 1.

    Attributes:
        measure: The measure.
        worst: The quantity worth 0.
        best: The quantity worth 1.
    """

    ends: ClassVar[tuple[str, str]] = ("worst", "best")

    measure: str
    worst: Anchor
    best: Anchor


def check_range(measure: str, worst: float, best: float) -> None:
    """Check that a value function has a range between two anchors.

    Raises:
        TradeoffError: An anchor is not finite, or the range is empty.
    """
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
