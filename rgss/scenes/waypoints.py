"""Waypoints of the task as poses of the grasp centre in the world."""

from __future__ import annotations

from enum import Enum

from rgss.scenes.pose import Pose
from rgss.scenes.scene import Scene


class Waypoint(str, Enum):
    """Waypoints of the task, in their order."""

    GRASP_APPROACH = "grasp_approach"
    GRASP = "grasp"
    LIFT = "lift"
    GRASP_DEPARTURE = "grasp_departure"
    PLACE_APPROACH = "place_approach"
    PLACE = "place"


def waypoint_poses(scene: Scene) -> dict[Waypoint, Pose]:
    """Transforms of the grasp-centre frame to the world at each waypoint."""
    task, grasp, place = scene.task, scene.grasp, scene.place_pose
    approach = grasp.raised(task.approach_height_m)
    if task.grasp is not None:
        approach = grasp @ Pose(position_m=(0.0, 0.0, -task.approach_height_m))
    return {
        Waypoint.GRASP_APPROACH: approach,
        Waypoint.GRASP: grasp,
        Waypoint.LIFT: grasp.raised(task.lift_height_m),
        Waypoint.GRASP_DEPARTURE: grasp.raised(task.departure_height_m),
        Waypoint.PLACE_APPROACH: place.raised(task.place_approach_height_m),
        Waypoint.PLACE: place,
    }
