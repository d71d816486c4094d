"""Half turn of a stated grasp about the approach: the same pads on the object, by other configurations of the arm."""

from __future__ import annotations

import math
from collections.abc import Collection
from dataclasses import replace

from rgss.grasping.candidates import has_opposed_fingers
from rgss.scenes import GripperGeometry, Scene
from rgss.tasks import TaskProgram
from rgss.trials.planning.task_stops import infeasible_waypoints
from rgss.trials.route import Stop
from rgss.trials.workcell import Workcell


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
