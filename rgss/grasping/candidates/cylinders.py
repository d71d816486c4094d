"""Grasp candidates of a cylinder: along its axis, across it, and by its ends, at several yaw angles."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import replace

from rgss.grasping.candidates.frames import ToolFrame, Vector3, depths_m, tool_frame
from rgss.scenes import Cylinder, GripperGeometry, LyingCylinder, Pose

_LYING = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, math.pi / 2, 0.0))


def cylinder_frames(
    shape: Cylinder | LyingCylinder, centre_of_mass_m: Vector3, *, heights: int, yaws: int, geometry: GripperGeometry
) -> Iterator[ToolFrame]:
    """Tool frames at which the fingers close on the wall or the ends of a cylinder.

    Args:
        shape: The cylinder.
        centre_of_mass_m: Its centre of mass.
        heights: Number of depths or places along the axis.
        yaws: Number of yaw angles about the axis.
        geometry: The gripper's shape.
    """
    if isinstance(shape, LyingCylinder):
        centre = _LYING.inverse_rotate(centre_of_mass_m)
        for one in _upright_frames(shape.upright, centre, heights, yaws, geometry):
            yield replace(one, tool_in_object=_LYING @ one.tool_in_object)
    else:
        yield from _upright_frames(shape, centre_of_mass_m, heights, yaws, geometry)


def _upright_frames(
    shape: Cylinder, centre: Vector3, heights: int, yaws: int, geometry: GripperGeometry
) -> Iterator[ToolFrame]:
    azimuth, half_m = geometry.azimuths_rad[0], shape.half_height_m
    reach = 0.8 * half_m
    others = [reach * (2 * (place + 0.5) / max(1, heights - 1) - 1) for place in range(heights - 1)]
    places = dict.fromkeys(round(value, 6) for value in (min(max(centre[2], -reach), reach), *others))
    for turn in range(yaws):
        yaw = math.tau * turn / yaws
        outward, across = (math.cos(yaw), math.sin(yaw), 0.0), (-math.sin(yaw), math.cos(yaw), 0.0)
        for end, name in ((1.0, "+"), (-1.0, "-")):
            for number, depth_m in enumerate(depths_m(half_m, end * centre[2], heights, geometry)):
                yield tool_frame(
                    f"cylinder:axial{name}:{turn}:{number}",
                    (0.0, 0.0, end * depth_m),
                    towards=(0.0, 0.0, -end),
                    closing=outward,
                    azimuth_rad=azimuth,
                )
        towards = (-outward[0], -outward[1], 0.0)
        depths = depths_m(shape.radius_m, 0.0, heights, geometry)
        for number, (place_m, depth_m) in enumerate(itertools.product(places, depths)):
            for sign in (1.0, -1.0):
                closing = (sign * across[0], sign * across[1], 0.0)
                yield tool_frame(
                    f"cylinder:across{'+' if sign > 0 else '-'}:{turn}:{number}",
                    (depth_m * outward[0], depth_m * outward[1], place_m),
                    towards=towards,
                    closing=closing,
                    azimuth_rad=azimuth,
                )
        for number, depth_m in enumerate(depths):
            for sign in (1.0, -1.0):
                yield tool_frame(
                    f"cylinder:ends{'+' if sign > 0 else '-'}:{turn}:{number}",
                    (depth_m * outward[0], depth_m * outward[1], 0.0),
                    towards=towards,
                    closing=(0.0, 0.0, sign),
                    azimuth_rad=azimuth,
                )
