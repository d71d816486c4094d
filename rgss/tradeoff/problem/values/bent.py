"""Value functions bent to be concave or convex."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

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
