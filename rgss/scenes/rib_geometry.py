"""Finger pads for contact engines: ribs at the ends of the line that a pad touches.

A flat pad touches a round wall along a line, and what that line can resist, forces at its two ends
resist as well. An engine that finds one point of a pair of shapes in a step builds such a contact up
over several steps, and the object turns about the first point meanwhile. So each pad is given to the
engine as two round ribs across the finger, one at each end of the line. Each is a shape of its own and
meets the wall in exactly one point, which is found at once; across the finger a rib is as flat as the pad.
"""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.shapes import Cylinder

RIBS = 2
"""Ribs of a finger's pad."""

_LARGEST_RADIUS_M = 0.004
_RADIUS_SHARE = 0.25
# So far behind the ribs the finger's flat face makes no contact, and the ribs are still part of the finger.
_PROUD_SHARE = 0.75


@dataclass(frozen=True, slots=True, kw_only=True)
class PadRibs:
    """Ribs across the pad of every finger, their fronts where the flat pad would be.

    Attributes:
        radius_m: Radius of each rib.
        proud_m: How far the ribs stand out of the rest of the finger.
        heights_m: Where each rib is along the finger, from the finger's centre, away from the flange positive.
    """

    radius_m: float
    proud_m: float
    heights_m: tuple[float, float]


def pad_ribs(gripper: GripperGeometry, workpiece: Cylinder) -> PadRibs:
    """The ribs with which a gripper holds a workpiece at its centre, the axes parallel.

    Args:
        gripper: The gripper.
        workpiece: What it grasps.
    """
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
