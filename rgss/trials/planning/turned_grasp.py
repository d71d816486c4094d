"""Other rotations of the hand about the vertical with which the arm serves the stops of a stated grasp."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

from rgss.grasping.candidates import has_opposed_fingers
from rgss.scenes import GripperGeometry, Scene
from rgss.tasks import TaskProgram
from rgss.trials.grasp_choice import with_stated_suction
from rgss.trials.planning.goal_reasons import GoalReason, Obstacle
from rgss.trials.planning.task_stops import every_stop_is_feasible, infeasible_waypoints
from rgss.trials.route import Stop
from rgss.trials.workcell import Workcell

_NOT_OF_YAW = (Obstacle.OUT_OF_REACH, Obstacle.TILT)
_YAWS_DEG = (30, -30, 60, -60, 90, -90, 120, -120, 150, -150, 180)


def objects_served_turned(
    scene: Scene, geometry: GripperGeometry, unserved: Collection[Stop], *, clearance_m: float, task: TaskProgram
) -> frozenset[str]:
    """Objects with an unserved stop, all of whose stops the arm serves with the hand turned by 180 deg.

    None for a hand whose pads a half turn does not exchange, and for a grasp that is chosen or free of a yaw.

    Args:
        scene: The scene.
        geometry: The gripper's shape.
        unserved: The stops without a configuration.
        clearance_m: Clearance of planned paths.
        task: The task.
    """
    stated = scene.task
    objects = {stop.object or scene.workpiece.id for stop in unserved}
    if not objects or stated.candidates is not None or stated.is_yaw_free or not has_opposed_fingers(geometry):
        return frozenset()
    turned = replace(stated, grasp_yaw_rad=stated.grasp_yaw_rad + math.pi, place_yaw_rad=stated.place_yaw_rad + math.pi)
    cell = Workcell(replace(scene, task=turned), geometry, clearance_m=clearance_m, task=task)
    return frozenset(objects - {stop.object or scene.workpiece.id for stop in infeasible_waypoints(cell)})


def serving_place_yaw(
    scene: Scene,
    geometry: GripperGeometry,
    unserved: Mapping[Stop, GoalReason],
    *,
    clearance_m: float,
    task: TaskProgram,
) -> float | None:
    """Yaw in rad at the place with which the arm serves every stop, where stops at places alone are unserved.

    Tried are turns in steps of 30 deg, the smallest first. None if no such turn serves, if another property than the
    yaw is in the way, and for a grasp that is chosen or free of a yaw.

    Args:
        scene: The scene.
        geometry: The gripper's shape.
        unserved: The stops without a configuration, and why.
        clearance_m: Clearance of planned paths.
        task: The task.
    """
    stated = scene.task
    if not unserved or stated.candidates is not None or stated.is_yaw_free:
        return None
    if any(not stop.is_at_place or why.obstacle in _NOT_OF_YAW for stop, why in unserved.items()):
        return None
    for turn_deg in _YAWS_DEG:
        yaw_rad = math.remainder(stated.place_yaw_rad + math.radians(turn_deg), math.tau)
        turned = with_stated_suction(replace(scene, task=replace(stated, place_yaw_rad=yaw_rad)), geometry)
        if every_stop_is_feasible(Workcell(turned, geometry, clearance_m=clearance_m, task=task)):
            return yaw_rad
    return None
