"""Drive of a gripper's linkage in PyBullet: a motor on one joint, gears to the others.

A gear of the engine holds two joints at a ratio as a constraint of the solver. Each joint is geared directly to the
leading one: along a chain of gears errors add up and the solver converges more slowly. The leading joint is the driven
one, unless that carries next to nothing; then it is the joint that carries most, and the motor acts there with the same
power. The gears transmit the motor's effort to both pads, so that a pad's force follows from the mechanism; they need
more iterations of the solver than sliding fingers.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rgss.physics.gears import add_gear
from rgss.physics.hands.linkage_motor import motor_command
from rgss.scenes import Linkage, leading_joint, link_names_of, motion_of

_LEAST_ITERATIONS, _ITERATIONS_A_FOLLOWER = 600, 400
_GEAR_FORCE = 1.0e4


def least_iterations(linkage: Linkage) -> int:
    """Iterations of the solver that keep the error of a linkage's joints within the bound of `docs/grippers.md`.

    Each joint that follows the driven one is a gear more. With too few iterations the gears of a hand of eight joints
    yield under 20 N, and the object slips by millimetres.
    """
    return max(_LEAST_ITERATIONS, _ITERATIONS_A_FOLLOWER * _follower_count(linkage))


def _follower_count(linkage: Linkage) -> int:
    return sum(link.kind is not None for link in linkage.links) - 1


class LinkageDrive:
    """Drive of the joints of one linkage in a physics client."""

    def __init__(
        self, engine: Any, client: int, robot: int, linkage: Linkage, joints: Mapping[str, int], *, step_s: float
    ) -> None:
        """Gear the joints together.

        Args:
            engine: The engine's module.
            client: The physics client.
            robot: The robot's body.
            linkage: The mechanism.
            joints: The engine's joint ids by name.
            step_s: Length of a step.
        """
        self._engine, self._client, self._robot = engine, client, robot
        self._step_s = step_s
        self._linkage, self._motion = linkage, motion_of(linkage)
        names = link_names_of(linkage)
        self._joints = {
            index: joints[f"{names[index]}_joint"] for index, link in enumerate(linkage.links) if link.kind is not None
        }
        self._leader = leading_joint(linkage)
        self._leading, self._leading_joint = linkage.links[self._leader], self._joints[self._leader]
        self._command: tuple[float, float] | None = None
        for joint in self._joints.values():
            # The engine's default motors would brake the joints.
            engine.setJointMotorControl2(robot, joint, engine.VELOCITY_CONTROL, force=0.0, physicsClientId=client)
        for index in self._joints:
            if index != self._leader:
                self._gear(index)

    @property
    def largest_error(self) -> float:
        """Greatest deviation of a joint from where the leading joint puts it, in rad or m."""
        driven = self._driven_position
        return max(
            abs(self._position(joint) - self._linkage.joint_position(index, driven))
            for index, joint in self._joints.items()
        )

    def reset(self, travel_m: float) -> None:
        """Put the mechanism at rest at a travel of each pad from open.

        Args:
            travel_m: The travel in m.
        """
        driven = self._motion.driven_at(travel_m)
        for index, joint in self._joints.items():
            position = self._linkage.joint_position(index, driven)
            self._engine.resetJointState(self._robot, joint, position, 0.0, physicsClientId=self._client)

    def hold(self, travel_m: float, *, stiff: bool = False) -> None:
        """Hold the mechanism at a travel of each pad from open.

        Args:
            travel_m: The travel in m.
            stiff: True to hold each joint by a motor of unlimited effort, for use without contact.
        """
        self._command = None
        driven = self._motion.driven_at(travel_m)
        for index, joint in self._joints.items() if stiff else ((self._leader, self._leading_joint),):
            self._engine.setJointMotorControl2(
                self._robot,
                joint,
                self._engine.POSITION_CONTROL,
                targetPosition=self._linkage.joint_position(index, driven),
                targetVelocity=0.0,
                force=_GEAR_FORCE if stiff else self._linkage.effort / abs(self._leading.multiplier),
                physicsClientId=self._client,
            )

    def drive(self, velocity_m_s: float, force_n: float) -> None:
        """Move each pad at a velocity (positive closes) with at most a force, from now on.

        Args:
            velocity_m_s: Velocity of each pad.
            force_n: Force of each pad; the effort of the driven joint limits it.
        """
        self._command = (velocity_m_s, force_n)
        self.before_step()

    def before_step(self) -> None:
        """Set the motor for the present position."""
        if self._command is None:
            return
        velocity_m_s, force_n = self._command
        velocity, effort = motor_command(
            self._linkage,
            self._driven_position,
            velocity_m_s=velocity_m_s,
            force_n=force_n,
            step_s=self._step_s,
        )
        self._engine.setJointMotorControl2(
            self._robot,
            self._leading_joint,
            self._engine.VELOCITY_CONTROL,
            targetVelocity=velocity * self._leading.multiplier,
            force=effort / abs(self._leading.multiplier),
            physicsClientId=self._client,
        )

    def travel_m(self) -> tuple[float, ...]:
        """Travel of each pad from open in m, from the leading joint."""
        travel_m = self._motion.travel_m(self._driven_position)
        return (travel_m,) * len(self._linkage.pads)

    @property
    def _driven_position(self) -> float:
        """Position of the driven joint that belongs to that of the leading one."""
        return (self._position(self._leading_joint) - self._leading.offset) / self._leading.multiplier

    def _position(self, joint: int) -> float:
        return float(self._engine.getJointState(self._robot, joint, self._client)[0])

    def _gear(self, index: int) -> None:
        """Tie a joint to the leading one."""
        link = self._linkage.links[index]
        ratio = link.multiplier / self._leading.multiplier
        add_gear(
            self._engine,
            self._client,
            self._robot,
            leading=self._leading_joint,
            following=self._joints[index],
            ratio=ratio,
            shift=self._leading.offset - link.offset / ratio,
        )
