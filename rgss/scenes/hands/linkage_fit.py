"""Grasp centre at the object, which depends on the object's top for a cup, and on its width for a linkage."""

from __future__ import annotations

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.hands.linkage_shape import at_opening
from rgss.scenes.hands.vacuum_gripper import at_top
from rgss.scenes.objects import grasp_opening_m
from rgss.scenes.scene import Scene
from rgss.scenes.shapes import half_extents_m

_ROUNDS = 3


def at_object(geometry: GripperGeometry, scene: Scene) -> GripperGeometry:
    """Gripper with its grasp centre at the pads or cup in contact with the object; sliding fingers unchanged.

    The pads of a linkage may move along the tool axis while they close. If grasps are chosen among candidates, the
    object's least width is used.

    Args:
        geometry: The gripper's shape.
        scene: The scene, with the object as its workpiece.
    """
    if geometry.linkage is None:
        return at_top(geometry, scene.workpiece.shape)
    for _ in range(_ROUNDS):
        if scene.task.candidates is not None and scene.task.grasp is None:
            opening_m = min(half_extents_m(scene.workpiece.shape)[:2])
        else:
            opening_m = grasp_opening_m(scene, geometry)
        geometry = at_opening(geometry, opening_m)
    return geometry
