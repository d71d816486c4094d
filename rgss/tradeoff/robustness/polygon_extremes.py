"""Convex polygons in the plane of two quantities, and the least of a sum of two functions on them."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Function = Callable[[NDArray[np.float64]], NDArray[np.float64]]


def zonotope(centre: Points, generators: Points) -> Points:
    """The corners of the set of points ``centre + sum t_k g_k`` with every t_k from -1 to 1.

    Args:
        centre: Shape (2,).
        generators: The g_k, shape (p, 2).

    Returns:
        The corners in counter-clockwise order, shape (v, 2); two where all generators are parallel,
        one where all are zero.
    """
    upward = np.where((generators[:, 1] < 0.0) | ((generators[:, 1] == 0.0) & (generators[:, 0] < 0.0)), -1.0, 1.0)
    steps = generators * upward[:, None]
    steps = steps[np.abs(steps).max(axis=1) > 0.0] if len(steps) else steps
    if not len(steps):
        return np.asarray(centre, dtype=np.float64)[None, :]
    steps = steps[np.argsort(np.arctan2(steps[:, 1], steps[:, 0]), kind="stable")]
    lowest = centre - steps.sum(axis=0)
    rising = lowest + 2.0 * np.vstack([np.zeros(2), np.cumsum(steps, axis=0)])
    falling = 2.0 * centre - rising[1:-1]
    return np.vstack([rising, falling])


def clip(polygon: Points, axis: int, limit: float, *, keep_below: bool) -> Points:
    """Clip a convex polygon at a line (Sutherland and Hodgman, 1974).

    Args:
        polygon: Vertices in order, shape (v, 2); one or two are a point or a segment.
        axis: The limited coordinate.
        limit: The limit, inclusive.
        keep_below: True to keep the side below the limit.

    Returns:
        The remaining vertices, shape (0, 2) if there are none.
    """
    side = (limit - polygon[:, axis]) * (1.0 if keep_below else -1.0)
    kept: list[Points] = []
    for index in range(len(polygon)):
        here, after = polygon[index], polygon[(index + 1) % len(polygon)]
        depth, next_depth = float(side[index]), float(side[(index + 1) % len(polygon)])
        if depth >= 0.0:
            kept.append(here)
        if depth * next_depth < 0.0:
            crossing = here + (after - here) * (depth / (depth - next_depth))
            crossing[axis] = limit
            kept.append(crossing)
    return np.array(kept, dtype=np.float64).reshape(-1, 2)


def lowest_separable(
    polygon: Points, first_kinks: Points, second_kinks: Points, first: Function, second: Function
) -> tuple[float, Points]:
    """The least of ``first(x) + second(y)`` over a convex polygon, both being piecewise linear.

    The sum is linear on each cell that the lines of the kinks cut from the polygon, so its least
    value is at a corner of a cell: a corner of the polygon, a crossing of a side with such a line,
    or a crossing of two such lines inside.

    Args:
        polygon: Corners in order, shape (v, 2), v >= 1.
        first_kinks: Where `first` has its kinks.
        second_kinks: Where `second` has them.
        first: A function of the first coordinate.
        second: A function of the second coordinate.

    Returns:
        The least value and where it is, shape (2,).
    """
    candidates = [polygon]
    ends = np.roll(polygon, -1, axis=0)
    for axis, kinks in ((0, first_kinks), (1, second_kinks)):
        for kink in kinks:
            start, end = polygon[:, axis] - kink, ends[:, axis] - kink
            crossed = start * end < 0.0
            share = (start[crossed] / (start[crossed] - end[crossed]))[:, None]
            crossing = polygon[crossed] + (ends[crossed] - polygon[crossed]) * share
            crossing[:, axis] = kink
            candidates.append(crossing)
    inner = np.array([(x, y) for x in first_kinks for y in second_kinks], dtype=np.float64).reshape(-1, 2)
    candidates.append(inner[_inside(inner, polygon)])
    points = np.vstack(candidates)
    sums = first(points[:, 0]) + second(points[:, 1])
    least = int(sums.argmin())
    return float(sums[least]), points[least]


def _inside(points: Points, polygon: Points) -> NDArray[np.bool_]:
    """Mask of the points inside a convex polygon in counter-clockwise order; none in a segment."""
    if len(polygon) < 3:
        return np.zeros(len(points), dtype=np.bool_)
    ends = np.roll(polygon, -1, axis=0)
    sides = ends - polygon
    slack = 1e-12 * math.hypot(*np.ptp(polygon, axis=0)) ** 2
    offsets = points[:, None, :] - polygon[None, :, :]
    cross = sides[None, :, 0] * offsets[..., 1] - sides[None, :, 1] * offsets[..., 0]
    return np.asarray((cross >= -slack).all(axis=1), dtype=np.bool_)
