"""Points of a Sobol sequence, computed here: to import a library of statistics takes longer than planning a move."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]

_BITS = 30

# Of each dimension from the second on: its primitive polynomial, with the coefficients as bits, and the first direction
# integers; Joe and Kuo (2008), doi:10.1137/070709359, table new-joe-kuo-6.21201.
_DIRECTIONS = (
    (3, (1,)),
    (7, (1, 3)),
    (11, (1, 3, 1)),
    (13, (1, 1, 1)),
    (19, (1, 1, 3, 3)),
    (25, (1, 3, 5, 13)),
    (37, (1, 1, 5, 5, 17)),
    (41, (1, 1, 5, 5, 5)),
    (47, (1, 1, 7, 11, 19)),
    (55, (1, 1, 5, 1, 1)),
    (59, (1, 1, 1, 3, 11)),
    (61, (1, 3, 5, 5, 31)),
    (67, (1, 3, 3, 9, 7, 49)),
    (91, (1, 1, 1, 15, 21, 21)),
    (97, (1, 3, 1, 13, 27, 49)),
)


@lru_cache(maxsize=16)
def sobol_points(dimensions: int, count: int) -> Points:
    """First points of the Sobol sequence in the unit cube, from its corner 0; the values of `scipy.stats.qmc.Sobol`.

    Args:
        dimensions: Number of dimensions.
        count: Number of points, below 2^30.

    Returns:
        Shape (count, dimensions); read-only.
    """
    points = _of_many_dimensions(dimensions, count) if dimensions > len(_DIRECTIONS) + 1 else _of(dimensions, count)
    points.setflags(write=False)
    return points


def _of(dimensions: int, count: int) -> Points:
    indices = np.arange(count)
    gray = indices ^ (indices >> 1)
    directions = np.array([_direction_numbers(dimension) for dimension in range(dimensions)])
    found = np.zeros((count, dimensions), dtype=np.int64)
    for bit in range(count.bit_length()):
        found ^= ((gray >> bit) & 1)[:, None] * directions[:, bit]
    points: Points = found / 2.0**_BITS
    return points


def _direction_numbers(dimension: int) -> list[int]:
    """Direction numbers of a dimension, which the recurrence of its polynomial continues; the first has all ones."""
    if dimension == 0:
        return [1 << (_BITS - 1 - bit) for bit in range(_BITS)]
    polynomial, first = _DIRECTIONS[dimension - 1]
    degree, found = len(first), [*first]
    for bit in range(degree, _BITS):
        value = found[bit - degree]
        for lag in range(1, degree + 1):
            if (polynomial >> (degree - lag)) & 1:
                value ^= found[bit - lag] << lag
        found.append(value)
    return [value << (_BITS - 1 - bit) for bit, value in enumerate(found)]


def _of_many_dimensions(dimensions: int, count: int) -> Points:
    from scipy.stats.qmc import Sobol

    points: Points = Sobol(dimensions, scramble=False).random_base2((count - 1).bit_length())[:count].copy()
    return points
