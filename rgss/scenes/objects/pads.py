"""Contact elements of the fingers' pads for all objects of a scene."""

from __future__ import annotations

from rgss.scenes.grasps import PadLayout, joined_layout, pad_layouts
from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.objects.several_objects import initial_placements, scene_about
from rgss.scenes.scene import Scene


def finger_pads(scene: Scene, geometry: GripperGeometry) -> tuple[PadLayout, ...]:
    """Contact elements of the pad of each finger, for the grasps of all objects.

    Args:
        scene: The scene.
        geometry: The gripper's shape.
    """
    placements = initial_placements(scene)
    views = [scene_about(scene, one.workpiece.id, place="", placements=placements) for one in scene.objects]
    layouts = [pad_layouts(geometry, view.workpiece.shape, view.grasp_in_object) for view in views]
    different = list(dict.fromkeys(layouts))
    return different[0] if len(different) == 1 else tuple(map(joined_layout, zip(*different, strict=True)))
