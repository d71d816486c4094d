"""Stated grasps of a suction cup on objects of other heights than the first."""

from __future__ import annotations

import math
from dataclasses import replace

from rgss.scenes import ChosenGrasp, GripperGeometry, Pose, Scene, SceneObject, suction_point_of


def with_stated_suction(scene: Scene, geometry: GripperGeometry) -> Scene:
    """Scene in which a cup comes to the top of each object; unchanged for fingers, and where grasps are chosen.

    The grasp centre of a cup is fitted to the first object, half of its height below the lip.

    Args:
        scene: The scene.
        geometry: The gripper's shape.
    """
    if geometry.cup is None or scene.task.candidates is not None:
        return scene
    first_m = scene.workpiece.shape.half_height_m
    others = [one for one in scene.others if one.workpiece.shape.half_height_m != first_m]
    return scene.with_grasps({one.workpiece.id: _on_top(scene, one, first_m) for one in others}) if others else scene


def _on_top(scene: Scene, other: SceneObject, depth_m: float) -> ChosenGrasp:
    """Grasp of an object at the middle of its top, the grasp centre at a depth below it."""
    shape, task = other.workpiece.shape, scene.task
    height_m = shape.half_height_m - depth_m
    return ChosenGrasp(
        id="stated",
        tool_in_object=Pose.from_roll_pitch_yaw((0.0, 0.0, height_m), (math.pi, 0.0, task.grasp_yaw_rad)),
        opening_m=0.0,
        place_yaw_rad=task.place_yaw_rad - task.grasp_yaw_rad,
        quality_1=math.nan,
        com_distance_m=math.nan,
        candidates=1,
        rejected=0,
        suction=suction_point_of(replace(scene, workpiece=other.workpiece)),
    )
