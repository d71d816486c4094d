"""Position of a camera that shows the moving bodies of a trial and the fixed bodies near them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np
from numpy.typing import NDArray

from rgss.physics.stage import SeenSolid
from rgss.scenes import Pose

Array = NDArray[np.float64]

_NEAR, _AROUND, _BELOW = 0.1, 0.5, 0.05
"""Bodies so near to what moves are in view as far as they are so far around it, in multiples of its size."""

_BORDER = 1.04
"""Free border of a picture, as a factor of what is in view."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Framing:
    """Position of a camera and of its target.

    Attributes:
        eye_m: Its position in the world, shape (3,).
        target_m: Point at the centre of the picture in the world, amid what is in view, shape (3,).
    """

    eye_m: tuple[float, float, float]
    target_m: tuple[float, float, float]


def corners_of(solid: SeenSolid) -> Array:
    """Corners in the world of the box about a fixed solid along the axes of its frame, shape (8, 3)."""
    vertices = np.array(solid.surface.vertices_m, dtype=float)
    box = product(*zip(vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist(), strict=True))
    return np.array([(solid.pose @ Pose(position_m=corner)).position_m for corner in box])


def framed_corners(moving_m: Array, bodies_m: Sequence[Array]) -> Array:
    """Corners of what a picture has in view, in the world, shape (k, 3).

    Args:
        moving_m: Points of what moves, shape (n, 3).
        bodies_m: Points of each fixed body, shape (n, 3).
    """
    low, high = moving_m.min(axis=0), moving_m.max(axis=0)
    size = float(np.linalg.norm(high - low))

    def grown(share: float) -> tuple[Array, Array]:
        beside = np.array([share * size, share * size, 0.0])
        below, above = np.array([0.0, 0.0, _BELOW * size]), np.array([0.0, 0.0, np.inf])
        return low - beside - below, high + beside + above

    near, around = grown(_NEAR), grown(_AROUND)
    boxes = [(low, high)]
    for points in bodies_m:
        least, most = points.min(axis=0), points.max(axis=0)
        if (least <= near[1]).all() and (most >= near[0]).all():
            boxes.append((np.maximum(least, around[0]), np.minimum(most, around[1])))
    return np.array([corner for box in boxes for corner in product(*zip(*box, strict=True))])


def framing(
    corners_m: Array, *, azimuth_rad: float, elevation_rad: float, field_of_view_rad: float, aspect: float
) -> Framing:
    """Nearest place of a camera in a direction from which all corners are in the picture.

    Args:
        corners_m: The corners in the world, shape (k, 3).
        azimuth_rad: Azimuth of the camera seen from its target, from the world's x towards its y.
        elevation_rad: Its elevation above the horizontal, seen from there.
        field_of_view_rad: Angle between the upper and the lower edge of the picture.
        aspect: Width of the picture divided by its height.
    """
    rise, turn = elevation_rad, azimuth_rad
    ahead = -np.array([math.cos(rise) * math.cos(turn), math.cos(rise) * math.sin(turn), math.sin(rise)])
    right = np.array([-math.sin(turn), math.cos(turn), 0.0])
    up = np.cross(right, ahead)
    tall = math.tan(field_of_view_rad / 2) / _BORDER
    depths = corners_m @ ahead

    def between(axis: Array, slope: float) -> tuple[float, float]:
        # A corner is in the picture if |across - c| <= slope * (depth - d), with the camera at c across and d ahead.
        across = corners_m @ axis
        least, most = float((across - slope * depths).max()), float((across + slope * depths).min())
        return (least + most) / 2, (most - least) / (2 * slope)

    (c_right, d_right), (c_up, d_up) = between(right, tall * aspect), between(up, tall)
    eye = c_right * right + c_up * up + min(d_right, d_up) * ahead
    middle = float(depths.min() + depths.max()) / 2
    target = eye + (middle - float(eye @ ahead)) * ahead
    x, y, z = eye.tolist()
    u, v, w = target.tolist()
    return Framing(eye_m=(x, y, z), target_m=(u, v, w))
