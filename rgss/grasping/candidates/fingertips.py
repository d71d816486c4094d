"""Grasps of low objects with the ends of the fingers, which stay clear of the support."""

from __future__ import annotations

import math

from rgss.grasping.candidates.frames import ToolFrame, approach_of
from rgss.scenes import Approach, GripperGeometry, Pose

_ROOM_M = 1e-3
_LEAST_OVERLAP_M = 5e-3


def too_low(height_m: float, clearance_m: float) -> str:
    """Reason why an object cannot be held from above with the ends of fingers that keep clear of its support.

    Empty if they hold enough of it.

    Args:
        height_m: The object's height.
        clearance_m: Clearance of planned paths.
    """
    needed_m = clearance_m + _ROOM_M
    if height_m >= needed_m + _LEAST_OVERLAP_M:
        return ""
    held_m = height_m - needed_m
    held = f"{held_m * 1e3:.4g} mm" if held_m > 0.0 else "none"
    return (
        f"from above, fingers that keep the clearance of {clearance_m * 1e3:.4g} mm from its support hold {held} of "
        f"its height of {height_m * 1e3:.4g} mm, and need {_LEAST_OVERLAP_M * 1e3:g} mm"
    )


def off_support(frame: ToolFrame, *, half_height_m: float, clearance_m: float, geometry: GripperGeometry) -> ToolFrame:
    """A frame from above, raised along the tool's axis until the fingers' ends keep the clearance of the support.

    Others are returned as they are, and so are those from which the pads would hold less than 5 mm of the object.

    Args:
        frame: The frame.
        half_height_m: Height of the centre of the object's shape above the support.
        clearance_m: Clearance of planned paths.
        geometry: The gripper's shape.
    """
    tool = frame.tool_in_object
    if approach_of(tool) is not Approach.ABOVE:
        return frame
    down = -tool.rotate((0.0, 0.0, 1.0))[2]
    tips_m = geometry.tip_height_m - geometry.grasp_depth_m
    radius_m = geometry.largest_opening_m + geometry.finger.size_m[0]
    lowest_m = half_height_m + tool.position_m[2] - tips_m * down - radius_m * math.sqrt(max(0.0, 1.0 - down**2))
    needed_m = clearance_m + _ROOM_M
    if lowest_m >= needed_m or too_low(2 * half_height_m, clearance_m):
        return frame
    raised = tool @ Pose(position_m=(0.0, 0.0, -(needed_m - lowest_m) / down))
    return ToolFrame(id=f"{frame.id}:tips", tool_in_object=raised)
