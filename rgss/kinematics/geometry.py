"""Collision geometry: convex solids, each attached to a joint."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from rgss.errors import DefinitionError
from rgss.kinematics.collision_context import CollisionContext
from rgss.kinematics.description import link_frame, transform
from rgss.scenes import (
    CUP_LINK,
    GRIPPER_BASE_LINK,
    Box,
    ConvexPart,
    GripperGeometry,
    LyingCylinder,
    MeshShape,
    ObjectShape,
    Pose,
    Robot,
    Scene,
    Shape,
    convex_parts,
    finger_link,
    linkage_hulls,
)

# The engine accepts its flag by position only.
_KEEP_TRIANGLES = True


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Part:
    """One convex solid.

    Attributes:
        name: Its link, body or workpiece; several parts can share a name.
        chain: Number of its joint along the arm, 0 for the base; None if it belongs to the scene.
        joint: Index of that joint in the model; the universe for a fixed solid.
        placement: Transform of the solid to the joint's frame (to the world if the joint is the universe).
        shape: The solid.
    """

    name: str
    chain: int | None
    joint: int
    placement: Any
    shape: Any

    def can_meet(self, other: Part) -> bool:
        """True if the pair must be checked: the two move relative to each other and are not neighbouring links."""
        if self.joint == other.joint:
            return False
        if self.chain is None or other.chain is None:
            return True
        return abs(self.chain - other.chain) > 1


def collision_parts(
    model: Any, scene: Scene, gripper: GripperGeometry, situation: CollisionContext
) -> tuple[Part, ...]:
    """Solids of arm, gripper, workpiece and scene.

    Args:
        model: The arm's model in the world.
        scene: The scene.
        gripper: The gripper at the flange.
        situation: Opening of the gripper, and pose of the workpiece.
    """
    flange = link_frame(model, scene.robot.flange)
    joint, to_joint = flange.parentJoint, flange.placement
    parts = arm_parts(model, scene.robot)

    def held(name: str, placement: Any, shape: Shape) -> Part:
        return Part(name=name, chain=joint, joint=joint, placement=to_joint * placement, shape=solid_of(shape))

    if gripper.linkage is None:
        parts.append(held(GRIPPER_BASE_LINK, transform(gripper.base_pose), gripper.base))
        for finger in range(gripper.fingers):
            pose = gripper.finger_pose(finger, situation.opening_m)
            parts.append(held(finger_link(finger), transform(pose), gripper.finger))
    else:
        parts += [
            Part(name=name, chain=joint, joint=joint, placement=to_joint * transform(pose), shape=hull_of(corners))
            for name, pose, corners in linkage_hulls(gripper.linkage, situation.opening_m)
        ]
    if gripper.cup is not None:
        parts.append(held(CUP_LINK, transform(gripper.cup_pose), gripper.cup))
    workpiece = scene.workpiece
    if situation.carried is not None:
        carried = gripper.grasp_centre @ situation.carried
        parts += [
            Part(name=workpiece.id, chain=joint, joint=joint, placement=to_joint * transform(carried @ at), shape=solid)
            for solid, at in object_solids(workpiece.shape)
        ]
    if situation.standing is not None:
        parts += [
            Part(name=workpiece.id, chain=None, joint=0, placement=transform(situation.standing @ at), shape=solid)
            for solid, at in object_solids(workpiece.shape)
        ]
    parts += [
        Part(
            name=body.id,
            chain=None,
            joint=0,
            placement=transform(body.pose if at == Pose() else body.pose @ at),
            shape=solid,
        )
        for body in scene.bodies
        for solid, at in object_solids(body.shape)
    ]
    return tuple(parts)


def arm_parts(model: Any, robot: Robot) -> list[Part]:
    """Solids of an arm.

    Raises:
        DefinitionError: A collision shape of the URDF cannot be read.
    """
    import pinocchio

    _settle_box_supports()
    text, convex = convex_parts(robot.urdf)
    try:
        solids = pinocchio.buildGeomFromUrdfString(model, text, pinocchio.GeometryType.COLLISION)
    except (ValueError, RuntimeError) as error:
        raise DefinitionError(
            f"the collision shapes of the robot {robot.id} cannot be read",
            hint=str(error).strip() or "use boxes and cylinders only",
        ) from error
    primitive = [
        Part(
            name=model.frames[solid.parentFrame].name,
            chain=solid.parentJoint,
            joint=solid.parentJoint,
            placement=solid.placement,
            shape=solid.geometry,
        )
        for solid in solids.geometryObjects
    ]
    return primitive + [_convex_part(model, part) for part in convex]


def hull_of(vertices_m: Iterable[tuple[float, float, float]]) -> Any:
    """Convex hull of some points for the collision engine.

    Args:
        vertices_m: The points, in the frame of the solid.
    """
    return _hull(tuple(vertices_m))


@lru_cache(maxsize=512)
def _hull(vertices_m: tuple[tuple[float, float, float], ...]) -> Any:
    """Convex hull of some points, made once: a trial builds a dozen collision models of the same links."""
    import coal

    corners = coal.StdVec_Vec3s()
    for vertex in vertices_m:
        corners.append(np.array(vertex))
    return coal.ConvexBase.convexHull(corners, _KEEP_TRIANGLES, "Qt")


def object_solids(shape: ObjectShape) -> tuple[tuple[Any, Pose], ...]:
    """Solids of an object for the collision engine, each with its transform to the object's frame.

    Args:
        shape: The object's shape.
    """
    if isinstance(shape, MeshShape):
        return tuple((hull_of(part), Pose()) for part in shape.parts_m)
    if isinstance(shape, LyingCylinder):
        along_x = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, math.pi / 2, 0.0))
        return ((solid_of(shape.upright), along_x),)
    return ((solid_of(shape), Pose()),)


def solid_of(shape: Shape) -> Any:
    """Solid of a shape for the collision engine."""
    import coal

    if isinstance(shape, Box):
        _settle_box_supports()
        return coal.Box(*shape.size_m)
    return coal.Cylinder(shape.radius_m, shape.height_m)


@lru_cache(maxsize=1)
def _settle_box_supports() -> None:
    """Make distances from boxes independent of the first query of the process.

    Coal 3.0 enlarges the negative half of every box by a relative 1e-10 for the life of a process if the first
    direction in which it evaluates a box's support has a component of 0 (a static constant of `getShapeSupport`). A
    trial in a process that had checked a scene then differed from the same trial elsewhere in the last digits of a
    clearance. The query below is the first, and no component of its direction in the box's frame is 0.
    """
    import coal

    turned = Pose.from_roll_pitch_yaw((3.0, 0.2, 0.1), (0.4, 0.5, 0.6))
    place = transform(turned)
    coal.distance(
        coal.Cylinder(0.1, 0.2),
        coal.Transform3s.Identity(),
        coal.Box(0.1, 0.2, 0.3),
        coal.Transform3s(place.rotation, place.translation),
        coal.DistanceRequest(),
        coal.DistanceResult(),
    )


def _convex_part(model: Any, part: ConvexPart) -> Part:
    frame = link_frame(model, part.link)
    return Part(
        name=part.link,
        chain=frame.parentJoint,
        joint=frame.parentJoint,
        placement=frame.placement * transform(part.pose),
        shape=hull_of(part.vertices_m),
    )
