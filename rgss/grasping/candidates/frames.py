"""Tool frames of grasps, in the frame of the object."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rgss.scenes import Approach, GripperGeometry, Pose, quaternion_of

Vector3 = tuple[float, float, float]
_TOLERANCE_RAD = math.radians(10.0)
_LEAST_GAP_M = 0.005


@dataclass(frozen=True, slots=True, kw_only=True)
class ToolFrame:
    """Candidate pose of the tool.

    Attributes:
        id: Its name.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
    """

    id: str
    tool_in_object: Pose


def tool_frame(name: str, centre_m: Vector3, *, towards: Vector3, closing: Vector3, azimuth_rad: float) -> ToolFrame:
    """Tool frame from an approach and a closing direction.

    Args:
        name: Its name.
        centre_m: The grasp centre in the object's frame.
        towards: Unit direction of the tool's axis, away from the flange.
        closing: Unit direction in which the first finger lies from the centre, perpendicular to the axis.
        azimuth_rad: Direction of the first finger about the tool's axis.
    """
    z, x = np.array(towards), np.array(closing)
    axes = np.column_stack([x, np.cross(z, x), z])
    turned = Pose(position_m=centre_m, quaternion_xyzw=quaternion_of(axes))
    if azimuth_rad:
        turned = turned @ Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, 0.0, -azimuth_rad))
    return ToolFrame(id=name, tool_in_object=turned)


def approach_of(tool_in_object: Pose) -> Approach | None:
    """Kind of approach of a tool to an object at rest; None from below."""
    down = -tool_in_object.rotate((0.0, 0.0, 1.0))[2]
    angle = math.acos(max(-1.0, min(1.0, down)))
    if angle <= _TOLERANCE_RAD:
        return Approach.ABOVE
    if angle < math.pi / 2 - _TOLERANCE_RAD:
        return Approach.OBLIQUE
    return Approach.SIDE if angle <= math.pi / 2 + _TOLERANCE_RAD else None


def depths_m(half_m: float, centre_m: float, heights: int, geometry: GripperGeometry) -> tuple[float, ...]:
    """Positions of the grasp centre along the approach in m, from the object's centre, positive towards the hand.

    The palm stays clear of the object, and the centre inside it. The position of the centre of mass comes first.

    Args:
        half_m: Half the object's extent along the approach.
        centre_m: Position of the centre of mass along the approach.
        heights: Number of positions.
        geometry: The gripper's shape.
    """
    palm_m = geometry.grasp_depth_m - geometry.palm_height_m
    low, high = max(-0.6 * half_m, half_m - palm_m + _LEAST_GAP_M), half_m
    if low > high:
        return ()
    high = max(low, min(high, 0.8 * half_m))
    first = min(max(centre_m, low), high)
    others = [low + (high - low) * (place + 0.5) / max(1, heights - 1) for place in range(heights - 1)]
    return tuple(dict.fromkeys(round(value, 6) for value in (first, *others)))
