"""Cells under an arm whose tool always points down where it is, as that of a gantry does."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rgss.studies.robot_project.layout import Layout

Array = NDArray[np.float64]

_TABLE_M = 0.6
_DOWN_COSINE = math.cos(math.radians(2.0))
_FEWEST = 32
# The ends of the range of each coordinate, in per cent of the samples: the corners of a workspace are left out.
_ENDS = (1.0, 99.0)
_SHARES_OF_HALF_LENGTH = (0.6, 0.5, 0.7, 0.4)
_SHARES_OF_DEPTH = (0.1, 0.2, 0.3, 0.05)
_LENGTH_OF_DEPTH = 2.0
_LEAST_SIZE_M = 0.05


def overhead_layouts(positions_m: Array, axes: Array, *, tool_m: float, scale: float = 1.0) -> Iterator[Layout]:
    """Layouts to try: the tables in the middle of where the tool points down, along the longer side of it.

    Args:
        positions_m: Sampled positions of the flange in the frame of the base, shape (k, 3).
        axes: Its z axis there, shape (k, 3).
        tool_m: Distance of the grasp centre of the longest gripper from the flange.
        scale: Scale of the object.
    """
    down = positions_m[axes[:, 2] < -_DOWN_COSINE]
    if len(down) < _FEWEST:
        return
    low, high = np.percentile(down, _ENDS, axis=0)
    middle, size = (low + high) / 2, high - low
    # The longer side lies along the y axis of the world.
    yaw_rad = 0.0 if size[1] >= size[0] else math.pi / 2
    length_m, depth_m = float(max(size[:2])), float(size[2])
    if min(length_m, depth_m) < _LEAST_SIZE_M:
        return
    cosine, sine = round(math.cos(yaw_rad)), round(math.sin(yaw_rad))
    x = -(cosine * middle[0] - sine * middle[1])
    y = -(sine * middle[0] + cosine * middle[1])
    for depth in _SHARES_OF_DEPTH:
        for share in _SHARES_OF_HALF_LENGTH:
            lowest_m = float(low[2]) + depth * depth_m
            layout = Layout(
                reach_m=min(length_m, _LENGTH_OF_DEPTH * depth_m),
                x_m=0.0,
                y_m=share * length_m / 2,
                table_m=_TABLE_M,
                base_yaw_rad=yaw_rad,
                is_overhead=True,
                scale=scale,
            )
            base_m = _TABLE_M + layout.cup_half_height_m + tool_m - lowest_m
            place = (round(float(x), 3) + 0.0, round(float(y), 3) + 0.0, round(base_m, 3))
            yield replace(layout, base_m=place)
