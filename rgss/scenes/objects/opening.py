"""Opening of a gripper round the object."""

from __future__ import annotations

from rgss.scenes.grasps import pad_patches
from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.scene import Scene
from rgss.scenes.shapes import Cylinder


def grasp_opening_m(scene: Scene, geometry: GripperGeometry) -> float:
    """Distance of the pads from the gripper's axis where they hold the object.

    Args:
        scene: The scene, with the grasp that is taken where one is chosen.
        geometry: The gripper's shape.

    Returns:
        The largest opening where a finger would close without touching; 0 for a suction cup.
    """
    if geometry.cup is not None:
        return 0.0
    taken, in_object = scene.task.grasp, scene.grasp_in_object
    if taken is not None:
        return taken.opening_m
    shape = scene.workpiece.shape
    if in_object is None:
        if not isinstance(shape, Cylinder):
            raise AssertionError("only a cylinder is held without a stated grasp")
        return shape.radius_m
    patches = pad_patches(shape, in_object, geometry)
    return geometry.largest_opening_m if patches is None else max(patch.opening_m for patch in patches)
