"""Linear interpolation between points of a value function."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Points = tuple[tuple[float, float], ...]


def interpolated(points: Points, quantity: float) -> float:
    """The value at a quantity of points in rising or falling order; level outside of them."""
    direction = 1.0 if points[-1][0] > points[0][0] else -1.0
    for (start, start_value), (end, end_value) in itertools.pairwise(points):
        if direction * quantity <= direction * start:
            return start_value
        if direction * quantity < direction * end:
            return start_value + (end_value - start_value) * ((quantity - start) / (end - start))
    return points[-1][1]


def interpolated_column(points: Sequence[tuple[float, float]], quantities: NDArray[np.float64]) -> NDArray[np.float64]:
    """The value at each of many quantities of points in rising order; NaN where the quantity is."""
    import numpy as np

    column = np.array(points, dtype=np.float64)
    return np.asarray(np.interp(quantities, column[:, 0], column[:, 1]), dtype=np.float64)
