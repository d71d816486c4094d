"""Shadow mapping by depth maps seen from the light.

The engine's own shadows darken everything outside the cone of its light and take longer than the picture; here only
moving bodies are rendered again, and only fixed bodies receive shadows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.physics.pictures.rendering import AMBIENT, DIFFUSE, TOWARDS_LIGHT, Array, Lens, Vector, draw

_DISTANCE_M = 15.0
_NEIGHBOURS = (-1, 0, 1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Receiver:
    """Points of a picture in the depth map of a light.

    Attributes:
        index: Pixel (height, width) of each point in the flattened depth map.
        depth: Its depth (height, width) there minus a tolerance; -1, in front of everything, where no shadow is cast.
    """

    index: NDArray[np.int32]
    depth: Array


class Light:
    """Distant light with almost parallel rays, directed at a part of the scene."""

    def __init__(self, target_m: Vector, *, reach_m: float, resolution: int, tolerance_m: float) -> None:
        """Direct the light.

        Args:
            target_m: Centre of the lit region in the world.
            reach_m: Radius of the region in which shadows are cast.
            resolution: Rows and columns of the depth map.
            tolerance_m: Least distance in m behind another point for a point to be in its shadow.
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
        # Increase of the depth value for a metre along the ray, near the target.
        growth = lens.near_m * lens.far_m / (lens.far_m - lens.near_m) / _DISTANCE_M**2
        kept = np.where(inside, depth - np.float32(growth * self._tolerance_m), np.float32(-1.0))
        return Receiver(index=index.astype(np.int32), depth=kept.astype(np.float32))

    def depths_of(self, client: int) -> Array:
        """Depth map of a client's bodies as seen from the light."""
        return draw(client, self._lens)[1]

    def shadow(self, depths: Array, receiver: Receiver) -> Array:
        """Occlusion (height, width) of each point, from 0, lit, to 1, in shadow.

        Args:
            depths: A depth map of this light.
            receiver: The points in the depth map of this light.
        """
        seen = depths.ravel()
        # Averaging over neighbours in the map softens the edge of the shadow.
        offsets = [row * self._lens.width + column for row in _NEIGHBOURS for column in _NEIGHBOURS]
        hidden = np.zeros(receiver.depth.shape, dtype=np.uint8)
        for offset in offsets:
            hidden += seen[receiver.index + offset] < receiver.depth
        share: Array = hidden / np.float32(len(offsets))
        return share


def darkness(points_m: Array) -> Array:
    """Share (height, width) of its colour that each point (height, width, 3) of a surface loses in full shadow.

    A surface that faces away from the light loses nothing.
    """
    across, down = np.gradient(points_m, axis=1), np.gradient(points_m, axis=0)
    normals = np.cross(down, across)
    scale = math.hypot(*TOWARDS_LIGHT) * np.maximum(np.linalg.norm(normals, axis=-1), np.float32(1e-12))
    cosine = np.maximum(normals @ np.array(TOWARDS_LIGHT, dtype=np.float32) / scale, 0.0)
    lit = DIFFUSE * cosine
    lost: Array = (lit / (AMBIENT + lit)).astype(np.float32)
    return lost
