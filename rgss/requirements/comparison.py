"""Comparison of a quantity with a limit, with a tolerance for binary rounding."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from enum import Enum
from types import MappingProxyType

RELATIVE_TOLERANCE = 1e-9
"""Relative difference below which a quantity counts as equal to its limit, so that binary rounding never decides."""

ZERO_TOLERANCE = 1e-10
"""Difference in SI units below which a quantity counts as equal to a limit of 0, of which there is no share."""


class Comparison(str, Enum):
    """Required relation of a quantity to a limit.

    A quantity within `RELATIVE_TOLERANCE` of the limit, or within `ZERO_TOLERANCE` of a limit of 0, counts as equal to
    it, both in verdicts and in mixed-integer programs.
    """

    AT_LEAST = ">="
    AT_MOST = "<="
    ABOVE = ">"
    BELOW = "<"

    @property
    def is_strict(self) -> bool:
        """True if equality does not satisfy the relation."""
        return self in (Comparison.ABOVE, Comparison.BELOW)

    @property
    def is_lower_bound(self) -> bool:
        """True for ``>`` and ``>=``."""
        return self in (Comparison.AT_LEAST, Comparison.ABOVE)

    def margin(self, quantity: float, limit: float) -> float:
        """Signed distance of a quantity from a limit; negative for a violation."""
        difference = quantity - limit
        return difference if self.is_lower_bound else -difference

    def holds(self, quantity: float | None, limit: float) -> bool:
        """True if a quantity satisfies the relation to a limit; an unknown one (None) does not.

        Args:
            quantity: The quantity, in the unit of the limit.
            limit: The limit.
        """
        if quantity is None:
            return False
        if math.isclose(quantity, limit, rel_tol=RELATIVE_TOLERANCE, abs_tol=0.0 if limit else ZERO_TOLERANCE):
            return not self.is_strict
        return _OPERATORS[self](quantity, limit)


_OPERATORS: Mapping[Comparison, Callable[[float, float], bool]] = MappingProxyType(
    {
        Comparison.AT_LEAST: operator.ge,
        Comparison.AT_MOST: operator.le,
        Comparison.ABOVE: operator.gt,
        Comparison.BELOW: operator.lt,
    }
)
