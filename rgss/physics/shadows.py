"""Shadows, by depth maps seen from the light.

The engine's own shadows darken everything outside the cone of its light and cost more than the
picture; here only what moves is drawn anew, and only what stands still receives shadows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.physics.rendering import AMBIENT, DIFFUSE, TOWARDS_LIGHT, Array, Lens, Vector, draw

_DISTANCE_M = 15.0
_NEIGHBOURS = (-1, 0, 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Receiver:
    """Points of a picture as a light sees them.

    Attributes:
        index: Pixel (height, width) of each point in the flattened depth map.
        depth: Its depth (height, width) there, less a tolerance; -1, before everything, where no shadow falls.
    """

    index: NDArray[np.int32]
    depth: Array


class Light:
    """A lamp so far away that its rays are almost parallel, directed at a part of the scene."""

    def __init__(self, target_m: Vector, *, reach_m: float, resolution: int, tolerance_m: float) -> None:
        """Direct the light.

        Args:
            target_m: The middle of what is lit.
            reach_m: Distance from it up to which shadows fall.
            resolution: Rows and columns of the depth map.
            tolerance_m: How far a point must lie behind another to be in its shadow.
        """
        x, y, z = (_DISTANCE_M / math.hypot(*TOWARDS_LIGHT) * part for part in TOWARDS_LIGHT)
        self._tolerance_m = tolerance_m
        self._lens = Lens(
            eye_m=(target_m[0] + x, target_m[1] + y, target_m[2] + z),
            target_m=target_m,
            field_of_view_rad=2 * math.atan(reach_m / _DISTANCE_M),
            width=resolution,
            height=resolution,
            near_m=_DISTANCE_M - 5.0,
            far_m=_DISTANCE_M + 5.0,
        )

    def receiver(self, points_m: Array) -> Receiver:
        """Coordinates in the light's view of points (height, width, 3) of the world."""
        lens = self._lens
        column, row, depth = lens.project(points_m)
        inside = (column >= 1) & (column < lens.width - 1) & (row >= 1) & (row < lens.height - 1)
        index = np.where(inside, row.astype(np.int32) * lens.width + column.astype(np.int32), lens.width + 1)
        # How much the depth grows by a metre along the ray, about the target.
        growth = lens.near_m * lens.far_m / (lens.far_m - lens.near_m) / _DISTANCE_M**2
        kept = np.where(inside, depth - np.float32(growth * self._tolerance_m), np.float32(-1.0))
        return Receiver(index=index.astype(np.int32), depth=kept.astype(np.float32))

    def depths_of(self, client: int) -> Array:
        """The depth map of a client's bodies: what is nearest to the light."""
        return draw(client, self._lens)[1]

    def shadow(self, depths: Array, receiver: Receiver) -> Array:
        """The share (height, width), 0 to 1, of the light that does not get to each point.

        Args:
            depths: A depth map of this light.
            receiver: The points as this light sees them.
        """
        seen = depths.ravel()
        # Neighbours in the map make the edge of the shadow soft.
        offsets = [row * self._lens.width + column for row in _NEIGHBOURS for column in _NEIGHBOURS]
        hidden = np.zeros(receiver.depth.shape, dtype=np.uint8)
        for offset in offsets:
            hidden += seen[receiver.index + offset] < receiver.depth
        share: Array = hidden / np.float32(len(offsets))
        return share


def darkness(points_m: Array) -> Array:
    """The share (height, width) of its colour that each point (height, width, 3) of a surface loses in the shadow.

    A surface that faces away from the light loses nothing.
    """
    across, down = np.gradient(points_m, axis=1), np.gradient(points_m, axis=0)
    normals = np.cross(down, across)
    scale = math.hypot(*TOWARDS_LIGHT) * np.maximum(np.linalg.norm(normals, axis=-1), np.float32(1e-12))
    cosine = np.maximum(normals @ np.array(TOWARDS_LIGHT, dtype=np.float32) / scale, 0.0)
    lit = DIFFUSE * cosine
    lost: Array = (lit / (AMBIENT + lit)).astype(np.float32)
    return lost
