"""Grasps of the object of a payload bench, which is lifted from above."""

from __future__ import annotations

import math
from functools import lru_cache

from rgss.grasping.candidates import ranked_grasps, ranked_suction
from rgss.scenes import (
    Approach,
    Cylinder,
    GraspCandidates,
    Gripper,
    GripperGeometry,
    ObjectShape,
    Pose,
    Scene,
    SuctionPoint,
    Workpiece,
    centre_of_mass,
    suction_point_of,
)

_FROM_ABOVE = GraspCandidates(approaches=(Approach.ABOVE,), heights=1)


def suction_from_above(scene: Scene, gripper: Gripper) -> tuple[SuctionPoint | None, Pose | None]:
    """Place of a cup on the object: the stated one, or the best from above if the task chooses among candidates.

    Returns:
        The place, and the transform of the grasp-centre frame to the object's frame; None if there is no place.
    """
    workpiece, geometry = scene.workpiece, gripper.geometry
    if scene.task.candidates is None:
        point = suction_point_of(scene)
        return point, Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (math.pi, 0.0, 0.0))
    return _best_place(_sample(workpiece.shape, centre_of_mass(workpiece)), geometry, gripper.grip_coefficient(1.0))


@lru_cache(maxsize=64)
def grasp_from_above(shape: ObjectShape, geometry: GripperGeometry, friction: float) -> Pose | None:
    """Best grasp from above of an object other than an upright cylinder; None if there is none.

    Args:
        shape: The object's solid.
        geometry: The gripper's shape, with fingers.
        friction: Coulomb coefficient of a finger on the object.
    """
    if isinstance(shape, Cylinder):
        return None
    found = ranked_grasps(_sample(shape, (0.0, 0.0, 0.0)), geometry, _FROM_ABOVE, friction=friction).grasps
    return found[0].tool_in_object if found else None


@lru_cache(maxsize=64)
def _best_place(
    sample: Workpiece, geometry: GripperGeometry, tangential_1: float
) -> tuple[SuctionPoint | None, Pose | None]:
    """Best place of a cup from above, and the grasp; None if there is none. Each trial of a design asks for it."""
    found = ranked_suction(sample, geometry, _FROM_ABOVE, tangential_1=tangential_1).grasps
    return (found[0].suction, found[0].tool_in_object) if found else (None, None)


def _sample(shape: ObjectShape, centre_m: tuple[float, float, float]) -> Workpiece:
    """Object of a shape: a grasp depends on no mass property other than the centre of mass."""
    x, y, z = centre_m
    return Workpiece(
        id="object",
        shape=shape,
        mass_kg=1.0,
        friction=1.0,
        force_limit_n=1.0,
        centre_of_mass_m=z,
        centre_of_mass_across_m=(x, y),
        pose=Pose(),
        colour=(0.0, 0.0, 0.0, 1.0),
    )
