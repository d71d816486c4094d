"""Joint paths: polylines in joint space."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike, NDArray

Vector = NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class JointPath:
    """A polyline in joint space.

    Attributes:
        points_rad: Its corners in rad, shape (n, joints), n at least 1; read-only.
    """

    points_rad: Vector

    def __post_init__(self) -> None:
        points = np.array(self.points_rad, dtype=float)
        points.setflags(write=False)
        object.__setattr__(self, "points_rad", points)


def path_length(positions: ArrayLike) -> float:
    """Summed distance between consecutive rows, in their unit.

    Args:
        positions: Points, shape (n, dimensions).
    """
    points = np.asarray(positions, dtype=float)
    return float(np.sum(np.linalg.norm(np.diff(points, axis=0), axis=1)))


def segment_states(start: Vector, end: Vector, resolution_rad: float, *, density: int = 1) -> Vector:
    """Evenly spaced states of a segment, without its start, at most the resolution apart.

    Args:
        start: First end, not itself among the states.
        end: Second end, the last of the states.
        resolution_rad: Greatest Euclidean distance between neighbours, at density 1.
        density: How many times as many states to give; those of density 1 are among them.
    """
    count = density * max(1, math.ceil(float(np.linalg.norm(end - start)) / resolution_rad))
    fractions = np.arange(1, count + 1)[:, None] / count
    states: Vector = start + fractions * (end - start)
    states[-1] = end
    return states


@lru_cache(maxsize=1024)
def coarse_to_fine(count: int) -> tuple[int, ...]:
    """Indices 0..count-1 in bisection order, the last first, so that an invalid segment is detected early."""
    order = [count - 1] if count else []
    gaps = [(-1, count - 1)]
    for low, high in gaps:
        if high - low > 1:
            middle = (low + high) // 2
            order.append(middle)
            gaps.extend(((low, middle), (middle, high)))
    return tuple(order)
