"""Fit of gripper and object: fingers can enclose and touch it, or the cup can seal on it."""

from __future__ import annotations

from rgss.scenes.grasps import SuctionPoint
from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.objects import grasp_opening_m
from rgss.scenes.scene import Scene
from rgss.scenes.shapes import Box, Cylinder, ObjectShape


def too_wide(geometry: GripperGeometry, scene: Scene) -> str:
    """Reason why open fingers cannot enclose the object; empty if they can.

    Args:
        geometry: The gripper's shape.
        scene: The scene, with the object as its workpiece.
    """
    if geometry.cup is not None or (half_m := grasp_opening_m(scene, geometry)) < geometry.largest_opening_m:
        return ""
    return (
        f"{scene.workpiece.id}, {_millimetres(2 * half_m)} across, is too wide to enter {_named(geometry)}, "
        f"which opens to {_millimetres(2 * geometry.largest_opening_m)}"
    )


def too_narrow(geometry: GripperGeometry, scene: Scene) -> str:
    """Reason why closed fingers do not touch the object; empty if they do.

    Args:
        geometry: The gripper's shape.
        scene: The scene, with the object as its workpiece.
    """
    if geometry.cup is not None or (half_m := grasp_opening_m(scene, geometry)) > geometry.least_opening_m:
        return ""
    return (
        f"{scene.workpiece.id}, {_millimetres(2 * half_m)} across, is too narrow to be touched by {_named(geometry)}, "
        f"which closes to {_millimetres(2 * geometry.least_opening_m)}"
    )


def misfit(geometry: GripperGeometry, scene: Scene) -> str:
    """Reason why the object's size does not fit a gripper; empty if it does.

    Args:
        geometry: The gripper's shape.
        scene: The scene, with the object as its workpiece.
    """
    return too_wide(geometry, scene) or too_narrow(geometry, scene) or unsealed(geometry, scene)


def unsealed(geometry: GripperGeometry, scene: Scene) -> str:
    """Reason why a cup does not seal on an object; empty if it does, and for fingers.

    Args:
        geometry: The gripper's shape.
        scene: The scene, with the object as its workpiece.
    """
    taken, room_m = scene.task.grasp, suction_point_of(scene).room_m
    if geometry.cup is None or room_m >= geometry.cup.radius_m:
        return ""
    if (taken is None or taken.suction is None) and not isinstance(scene.workpiece.shape, (Box, Cylinder)):
        return (
            f"{_named(geometry)} takes {scene.workpiece.id} by candidates alone: the stated grasp of a cup is in the "
            "middle of the top of a box or an upright cylinder"
        )
    return (
        f"the top of {scene.workpiece.id} of {_millimetres(2 * room_m)} is smaller than the cup of "
        f"{_named(geometry)}, {_millimetres(2 * geometry.cup.radius_m)}"
    )


def suction_point_of(scene: Scene) -> SuctionPoint:
    """Position of a suction cup on the object: that of the chosen candidate, or the middle of its top."""
    taken, shape = scene.task.grasp, scene.workpiece.shape
    if taken is not None and taken.suction is not None:
        return taken.suction
    top = (0.0, 0.0, shape.half_height_m)
    return SuctionPoint(position_m=top, normal=(0.0, 0.0, 1.0), room_m=flat_top_radius_m(shape))


def flat_top_radius_m(shape: ObjectShape) -> float:
    """Radius in m of the largest flat circle about the middle of an object's top; 0 if the top is not flat."""
    if isinstance(shape, Cylinder):
        return shape.radius_m
    return min(shape.size_m[:2]) / 2 if isinstance(shape, Box) else 0.0


def _named(geometry: GripperGeometry) -> str:
    return f"gripper {geometry.id}" + (f" in its mounting {geometry.mounting}" if geometry.mounting else "")


def _millimetres(metres: float) -> str:
    return f"{metres * 1e3:.4g} mm"
