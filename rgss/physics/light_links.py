"""Least inertia of the links beside the followers of an arm, which the engine's solver needs."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rgss.scenes import JointKind, Robot

_LEAST_INERTIA = 0.03


def steady_light_links(engine: Any, client: int, body: int, robot: Robot, joints: Mapping[str, int]) -> None:
    """Raise the inertia of light links on both sides of a revolute follower to 3 % of what the joint moves at home.

    The solver treats one joint after another. Where a link is much lighter than what it carries, its joints disturb
    each other in every iteration, and hundreds do not suffice. In a parallelogram such a link does not turn, so that
    its inertia loads nothing; elsewhere the joint needs up to 3 % more torque to accelerate.

    Args:
        engine: The engine's module.
        client: The physics client.
        body: The robot's body.
        robot: The arm.
        joints: The engine's joint ids by name.
    """
    turning = [joints[one.name] for one in robot.followers if one.kind is JointKind.REVOLUTE]
    if not turning:
        return
    info = [engine.getJointInfo(body, joint, client) for joint in range(engine.getNumJoints(body, client))]
    moving = [one[0] for one in info if one[2] != engine.JOINT_FIXED]
    at = {joints[one.name]: home for one, home in zip(robot.joints, robot.home_rad, strict=True)}
    at |= {
        joints[one.name]: position
        for one, position in zip(robot.followers, robot.follower_positions(robot.home_rad), strict=True)
    }
    positions = [at.get(joint, 0.0) for joint in moving]
    masses = engine.calculateMassMatrix(body, positions, physicsClientId=client)
    for joint in turning:
        place = moving.index(joint)
        least = _LEAST_INERTIA * masses[place][place]
        for link in (joint, info[joint][16]):
            own = engine.getDynamicsInfo(body, link, client)[2]
            if min(own) < least:
                raised = [max(moment, least) for moment in own]
                engine.changeDynamics(body, link, localInertiaDiagonal=raised, physicsClientId=client)
