"""Gears of PyBullet: joints of one body that are held at a ratio, and the followers of an arm that use them."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from rgss.physics.light_links import steady_light_links
from rgss.physics.slipping import slipped
from rgss.scenes import Robot

_GEAR_FORCE = 1.0e4
_GEAR_CORRECTION = 0.2


def add_gear(
    engine: Any,
    client: int,
    body: int,
    *,
    leading: int,
    following: int,
    ratio: float,
    shift: float,
    effort: float = math.inf,
) -> None:
    """Tie a joint to another one as a constraint of the solver: q_following = ratio (q_leading - shift).

    Args:
        engine: The engine's module.
        client: The physics client.
        body: The body of both joints.
        leading: Id of the leading joint.
        following: Id of the joint that follows it.
        ratio: Displacement of the following joint per displacement of the leading one.
        shift: Position of the leading joint where the following one is at zero.
        effort: Greatest torque in N·m or force in N on the following joint.
    """
    gear = engine.createConstraint(
        body, leading, body, following, engine.JOINT_GEAR, [1, 0, 0], [0, 0, 0], [0, 0, 0], physicsClientId=client
    )
    engine.changeConstraint(
        gear,
        gearRatio=-1.0 / ratio,
        relativePositionTarget=shift,
        # The force of the constraint acts on the leading joint.
        maxForce=min(_GEAR_FORCE, effort * abs(ratio)),
        erp=_GEAR_CORRECTION,
        physicsClientId=client,
    )


class ArmGears:
    """Followers of an arm in a physics client, each geared to its driven joint.

    The gear transmits the torques of the followers to the driven joint, so that its motor carries them.
    """

    def __init__(self, engine: Any, client: int, body: int, robot: Robot, joints: Mapping[str, int]) -> None:
        """Gear the followers; no effect for an arm without.

        Args:
            engine: The engine's module.
            client: The physics client.
            body: The robot's body.
            robot: The arm.
            joints: The engine's joint ids by name.
        """
        self._engine, self._client, self._body, self._robot = engine, client, body, robot
        self._followers = [joints[one.name] for one in robot.followers]
        self._driven = [joints[joint.name] for joint in robot.joints]
        steady_light_links(engine, client, body, robot, joints)
        for one, joint in zip(robot.followers, self._followers, strict=True):
            # The engine's default motor would brake the joint.
            engine.setJointMotorControl2(body, joint, engine.VELOCITY_CONTROL, force=0.0, physicsClientId=client)
            add_gear(
                engine,
                client,
                body,
                leading=self._driven[one.driver],
                following=joint,
                ratio=one.multiplier,
                shift=-one.offset / one.multiplier,
                effort=one.effort,
            )

    def reset(self, driven: Sequence[float]) -> None:
        """Put the followers at rest where the driven joints put them.

        Args:
            driven: Positions of the driven joints in rad or m, shape (n,).
        """
        for joint, position in zip(self._followers, self._robot.follower_positions(driven), strict=True):
            self._engine.resetJointState(self._body, joint, position, 0.0, physicsClientId=self._client)

    @property
    def slipped(self) -> str:
        """Name of a follower whose gear has given way; empty if none has."""
        if not self._followers:
            return ""
        driven = [self._position(joint) for joint in self._driven]
        return slipped(self._robot, driven, [self._position(joint) for joint in self._followers])

    @property
    def largest_error(self) -> float:
        """Greatest deviation of a follower from where its driven joint puts it, in rad or m; 0 without followers."""
        if not self._followers:
            return 0.0
        driven = [self._position(joint) for joint in self._driven]
        wanted = self._robot.follower_positions(driven)
        return max(abs(self._position(joint) - at) for joint, at in zip(self._followers, wanted, strict=True))

    def _position(self, joint: int) -> float:
        return float(self._engine.getJointState(self._body, joint, self._client)[0])
