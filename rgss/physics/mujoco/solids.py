"""Solids of the engine, and those that a finger consists of."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rgss.scenes import Box, Cylinder, GripperGeometry, Pose, Shape, pad_ribs


@dataclass(frozen=True, slots=True, kw_only=True)
class Capsule:
    """A cylinder with a hemisphere on each end, centred in its frame, its axis along z.

    Attributes:
        radius_m: Radius of cylinder and hemispheres.
        half_length_m: Half of the cylinder's length.
    """

    radius_m: float
    half_length_m: float


Solid = Shape | Capsule | float
"""A solid of the engine; a number is the radius (m) of a sphere."""


def finger_solids(geometry: GripperGeometry, workpiece: Cylinder) -> tuple[tuple[Solid, Pose], ...]:
    """The solids of a finger in its frame: a rib at each end of the line that its pad touches, and the rest.

    A flat box touches a round wall along a line, of which the engine finds both ends. Where the box's edge touches
    the wall, because the object stands off the hand's plane by more than half of the finger's width, it finds one
    point for a whole finger: the object turns about it and is lost. Two ribs are found each by itself.

    Args:
        geometry: The gripper's shape.
        workpiece: What it grasps.
    """
    ribs = pad_ribs(geometry, workpiece)
    x, y, z = geometry.finger.size_m
    rest = Box(size_m=(x - ribs.proud_m, y, z))
    rib = Capsule(radius_m=ribs.radius_m, half_length_m=y / 2 - ribs.radius_m)
    return (
        (rest, Pose(position_m=(ribs.proud_m / 2, 0.0, 0.0))),
        *(
            (rib, Pose.from_roll_pitch_yaw((ribs.radius_m - x / 2, 0.0, height_m), (math.pi / 2, 0.0, 0.0)))
            for height_m in ribs.heights_m
        ),
    )
