"""Opening of a gripper at the object."""

from __future__ import annotations

from rgss.scenes.grasps import pad_patches
from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.scene import Scene
from rgss.scenes.shapes import Cylinder


def grasp_opening_m(scene: Scene, geometry: GripperGeometry) -> float:
    """Distance in m of the pads from the gripper's axis in contact with the object.

    Args:
        scene: The scene, with the chosen grasp if there are candidates.
        geometry: The gripper's shape.

    Returns:
        The largest opening if a finger would close without contact; 0 for a suction cup.
    """
    if geometry.cup is not None:
        return 0.0
    taken, in_object = scene.task.grasp, scene.grasp_in_object
    if taken is not None:
        return taken.opening_m
    shape = scene.workpiece.shape
    if in_object is None:
        if not isinstance(shape, Cylinder):
            raise AssertionError("only a cylinder can be held without a stated grasp")
        return shape.radius_m
    patches = pad_patches(shape, in_object, geometry)
    return geometry.largest_opening_m if patches is None else max(patch.opening_m for patch in patches)
