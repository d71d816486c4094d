"""Cross products of few vectors, for which the general function of numpy takes longer than the products."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def cross_product(first: Array, second: Array) -> Array:
    """Cross products along the last axis, to the bits of `numpy.cross`.

    Args:
        first: Vectors, shape (..., 3).
        second: Vectors, shape (..., 3), broadcast with the first.
    """
    a, b, c = first[..., 0], first[..., 1], first[..., 2]
    x, y, z = second[..., 0], second[..., 1], second[..., 2]
    return np.stack([b * z - c * y, c * x - a * z, a * y - b * x], axis=-1)
