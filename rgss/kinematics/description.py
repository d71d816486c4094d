"""Rigid-body model of the arm in the world, read from its URDF."""

from __future__ import annotations

from typing import Any

from rgss.errors import DefinitionError
from rgss.scenes import Pose, Robot, convex_parts


def build_model(robot: Robot) -> Any:
    """Build the Pinocchio model of an arm with its base at the scene's pose.

    Every frame of the model, and gravity, is expressed in the world, so that a tilted base needs no special case. The
    model has the followers as joints of their own; a `Coupling` gives their positions.

    Raises:
        DefinitionError: The URDF cannot be read, or its joints or links are not those of the robot.
    """
    import pinocchio

    try:
        model = pinocchio.buildModelFromXML(convex_parts(robot.urdf)[0])
    except (ValueError, RuntimeError) as error:
        raise DefinitionError(
            f"the URDF of the robot {robot.id} cannot be read", hint=str(error).strip() or "it must be a valid URDF"
        ) from error
    found = tuple(model.names)[1:]
    wanted = tuple(joint.name for joint in robot.joints)
    followers = [one.name for one in robot.followers]
    driven = tuple(name for name in found if name not in followers)
    if driven != wanted or len(found) != len(wanted) + len(followers):
        raise DefinitionError(
            f"the robot {robot.id} has the joints {', '.join(wanted)}, but its URDF has {', '.join(driven) or 'none'}",
            hint="name the movable joints as the URDF does, from base to flange",
        )
    if not model.existFrame(robot.flange):
        links = [frame.name for frame in model.frames if frame.type == pinocchio.FrameType.BODY]
        raise DefinitionError(
            f"the robot {robot.id} has no link {robot.flange} to carry the gripper",
            hint=f"the links are {', '.join(links)}",
        )
    base = transform(robot.base)
    # A joint's placement is relative to its parent joint; that of the universe is the base frame.
    for index in range(1, model.njoints):
        if model.parents[index] == 0:
            model.jointPlacements[index] = base * model.jointPlacements[index]
    for frame in model.frames:
        if frame.parentJoint == 0 and frame.name != "universe":
            frame.placement = base * frame.placement
    return model


def link_frame(model: Any, link: str) -> Any:
    """Frame of a link in a Pinocchio model; a joint may have the same name."""
    import pinocchio

    return model.frames[model.getFrameId(link, pinocchio.FrameType.BODY)]


def transform(pose: Pose) -> Any:
    """Pose as Pinocchio's SE3."""
    import numpy as np
    import pinocchio

    return pinocchio.XYZQUATToSE3(np.array([*pose.position_m, *pose.quaternion_xyzw]))


def pose_of(placement: Any) -> Pose:
    """Pose from Pinocchio's SE3."""
    import pinocchio

    x, y, z, qx, qy, qz, qw = (float(value) for value in pinocchio.SE3ToXYZQUAT(placement))
    return Pose(position_m=(x, y, z), quaternion_xyzw=(qx, qy, qz, qw))
