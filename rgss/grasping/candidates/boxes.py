"""Grasp candidates of a box: each pair of faces, from each direction along the two other axes, at several depths."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.grasping.candidates.frames import ToolFrame, Vector3, depths_m, tool_frame
from rgss.scenes import Box, GripperGeometry

_NAMES = "xyz"


def box_frames(shape: Box, centre_of_mass_m: Vector3, heights: int, geometry: GripperGeometry) -> Iterator[ToolFrame]:
    """Tool frames at which the fingers close on faces of a box.

    Args:
        shape: The box.
        centre_of_mass_m: Its centre of mass, on which the hand is centred along the third axis.
        heights: Number of depths from each direction.
        geometry: The gripper's shape.
    """
    for closing in range(3):
        for approach in (axis for axis in range(3) if axis != closing):
            third = 3 - closing - approach
            for outward in (1.0, -1.0):
                depths = depths_m(shape.size_m[approach] / 2, outward * centre_of_mass_m[approach], heights, geometry)
                for number, depth_m in enumerate(depths):
                    centre = [0.0, 0.0, 0.0]
                    centre[approach], centre[third] = outward * depth_m, centre_of_mass_m[third]
                    for turned in (1.0, -1.0):
                        yield tool_frame(
                            f"box:{_sign(turned)}{_NAMES[closing]}:from{_sign(outward)}{_NAMES[approach]}:{number}",
                            (centre[0], centre[1], centre[2]),
                            towards=_axis(approach, -outward),
                            closing=_axis(closing, turned),
                            azimuth_rad=geometry.azimuths_rad[0],
                        )


def _axis(axis: int, sign: float) -> Vector3:
    found = [0.0, 0.0, 0.0]
    found[axis] = sign
    return found[0], found[1], found[2]


def _sign(value: float) -> str:
    return "+" if value > 0.0 else "-"
