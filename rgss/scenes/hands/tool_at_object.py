"""Pose of the tool at an object, and of the object in the hand, with the pads in contact.

The grasp centre of a gripper is fixed on its flange. The pads of a linkage move along the tool axis while they close:
on an object of another width than that for which the grasp centre was fitted, they meet before or beyond it. The tool
then stays farther from the object or comes nearer by the difference.
"""

from __future__ import annotations

import math
from functools import lru_cache

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.hands.linkage_shape import at_opening
from rgss.scenes.objects import grasp_opening_m
from rgss.scenes.pose import Pose
from rgss.scenes.scene import Scene

_SAME_M = 1.0e-9


def tool_with_pads_at(pads: Pose, scene: Scene, geometry: GripperGeometry) -> Pose:
    """Transform of the grasp-centre frame, which is fixed on the flange, to the world.

    Args:
        pads: Transform of the wanted grasp to the world, the pads in contact.
        scene: The scene, with the object as its workpiece.
        geometry: The gripper's shape.
    """
    beyond_m = pads_beyond_m(scene, geometry)
    return pads if beyond_m == 0.0 else pads @ Pose(position_m=(0.0, 0.0, -beyond_m))


def object_in_hand(scene: Scene, geometry: GripperGeometry) -> Pose | None:
    """Transform of the held object to the grasp-centre frame.

    None for a cylinder gripped along its axis from above with its middle at the grasp centre.

    Args:
        scene: The scene, with the object as its workpiece.
        geometry: The gripper's shape.
    """
    in_object, beyond_m = scene.grasp_in_object, pads_beyond_m(scene, geometry)
    if beyond_m == 0.0:
        return None if in_object is None else in_object.inverse()
    middle = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (math.pi, 0.0, scene.task.grasp_yaw_rad))
    return Pose(position_m=(0.0, 0.0, beyond_m)) @ (in_object or middle).inverse()


def pads_beyond_m(scene: Scene, geometry: GripperGeometry) -> float:
    """Distance along the tool axis from the grasp centre to that of the pads in contact with the object.

    Args:
        scene: The scene, with the object as its workpiece.
        geometry: The gripper's shape.

    Returns:
        Negative if the pads are nearer to the flange; 0 for sliding fingers and for a suction cup.
    """
    return 0.0 if geometry.linkage is None else _beyond_m(geometry, grasp_opening_m(scene, geometry))


@lru_cache(maxsize=64)
def _beyond_m(geometry: GripperGeometry, opening_m: float) -> float:
    beyond_m = at_opening(geometry, opening_m).grasp_depth_m - geometry.grasp_depth_m
    # The tolerance covers rounding at the object for which the grasp centre was fitted.
    return beyond_m if abs(beyond_m) > _SAME_M else 0.0
