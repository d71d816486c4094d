"""Ribbed finger pads for contact engines: ribs at the ends of the contact line.

A flat pad touches a round wall along a line, whose contact wrenches are equivalent to forces at its two ends. An engine
that detects one point of a pair of shapes in a step builds up such a contact over several steps, while the object
rotates about the first point. Each pad therefore consists of two round ribs across the finger, one at each end of the
line. Each is a separate shape and touches the wall in exactly one point, which is detected at once; across the finger a
rib is as flat as the pad.
"""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.shapes import Cylinder

RIBS = 2
"""Number of ribs of a finger's pad."""

_LARGEST_RADIUS_M = 0.004
_RADIUS_SHARE = 0.25
# At this depth behind the ribs the finger's flat face makes no contact, and the ribs are still part of the finger.
_PROUD_SHARE = 0.75


@dataclass(frozen=True, slots=True, kw_only=True)
class PadRibs:
    """Ribs across the pad of every finger, tangent to the plane of the flat pad.

    Attributes:
        radius_m: Radius of each rib.
        proud_m: Height of the ribs above the rest of the finger.
        heights_m: Position of each rib along the finger, from its centre, positive away from the flange.
    """

    radius_m: float
    proud_m: float
    heights_m: tuple[float, float]


def pad_ribs(gripper: GripperGeometry, workpiece: Cylinder) -> PadRibs:
    """Ribs of a gripper that holds a workpiece at its centre with parallel axes."""
    base_m, (thickness_m, width_m, length_m) = gripper.base.height_m, gripper.finger.size_m
    start = max(base_m, gripper.grasp_depth_m - workpiece.half_height_m)
    end = min(base_m + length_m, gripper.grasp_depth_m + workpiece.half_height_m)
    radius = min(_LARGEST_RADIUS_M, _RADIUS_SHARE * min(thickness_m, width_m, end - start))
    centre = base_m + length_m / 2
    return PadRibs(
        radius_m=radius,
        proud_m=_PROUD_SHARE * radius,
        heights_m=(start + radius - centre, end - radius - centre),
    )
