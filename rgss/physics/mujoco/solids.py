"""Solids of a finger and of the object for MuJoCo."""

from __future__ import annotations

import math

from rgss.physics.mujoco.robot_links import Capsule, Corners, Solid
from rgss.scenes import Box, GripperGeometry, LyingCylinder, MeshShape, ObjectShape, PadLayout, Pose


def finger_solids(geometry: GripperGeometry, pad: PadLayout) -> tuple[tuple[Solid, Pose], ...]:
    """Solids of a finger in its frame: the elements of its pad, and the rest.

    A flat box touches a round wall along a line, of which the engine detects both ends. If the box's edge touches the
    wall, because the object is off the hand's plane by more than half of the finger's width, the engine detects one
    point for the whole finger: the object rotates about it and is lost. Two ribs give one contact each.

    Args:
        geometry: The gripper's shape.
        pad: The elements of the pad.
    """
    x, y, z = geometry.finger.size_m
    solids: list[tuple[Solid, Pose]] = [
        (Box(size_m=(x - pad.proud_m, y, z)), Pose(position_m=(pad.proud_m / 2, 0.0, 0.0)))
    ]
    for element in pad.elements:
        solid: Solid = pad.radius_m
        if element.length_m > 0.0:
            solid = Capsule(radius_m=pad.radius_m, half_length_m=element.length_m / 2)
        at = (pad.radius_m - x / 2, element.across_m, element.height_m)
        roll = math.pi / 2 if element.is_across else 0.0
        solids.append((solid, Pose.from_roll_pitch_yaw(at, (roll, 0.0, 0.0))))
    return tuple(solids)


def object_solids(shape: ObjectShape) -> tuple[tuple[Solid | Corners, Pose], ...]:
    """Solids of the object in its frame.

    Args:
        shape: Its shape.
    """
    if isinstance(shape, MeshShape):
        return tuple((part, Pose()) for part in shape.parts_m)
    if isinstance(shape, LyingCylinder):
        return ((shape.upright, Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, math.pi / 2, 0.0))),)
    return ((shape, Pose()),)
