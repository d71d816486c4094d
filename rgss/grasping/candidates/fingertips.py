"""Grasps of low objects with the ends of the fingers, which stay clear of the support."""

from __future__ import annotations

import math

from rgss.grasping.candidates.frames import ToolFrame, approach_of
from rgss.scenes import Approach, GripperGeometry, Pose

_ROOM_M = 1e-3
_LEAST_OVERLAP_M = 5e-3


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
    if lowest_m >= needed_m or 2 * half_height_m < needed_m + _LEAST_OVERLAP_M:
        return frame
    raised = tool @ Pose(position_m=(0.0, 0.0, -(needed_m - lowest_m) / down))
    return ToolFrame(id=f"{frame.id}:tips", tool_in_object=raised)
