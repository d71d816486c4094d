"""Fit of an object's height to a gripper that grasps its centre from above."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.scene import Scene


@dataclass(frozen=True, slots=True, kw_only=True)
class PalmFit:
    """Heights above the grasp centre, along the tool's axis.

    Attributes:
        top_m: Height of the object's top.
        palm_m: Height of the palm, which the object must not reach.
    """

    top_m: float
    palm_m: float


def palm_fit(geometry: GripperGeometry, scene: Scene) -> PalmFit | None:
    """Heights of the object's top and of the palm at the grasp from above.

    None for a suction cup, and where the task chooses the grasp of candidates, whose height is its own.

    Args:
        geometry: The gripper's shape.
        scene: The scene, with the object as its workpiece.
    """
    if geometry.cup is not None or scene.task.candidates is not None or scene.task.grasp is not None:
        return None
    return PalmFit(top_m=scene.workpiece.shape.half_height_m, palm_m=geometry.grasp_depth_m - geometry.palm_height_m)
