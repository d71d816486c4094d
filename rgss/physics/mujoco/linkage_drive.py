"""Motor of a gripper's linkage in MuJoCo, on its leading joint."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from rgss.physics.hands import motor_command
from rgss.physics.mujoco.engine import mujoco
from rgss.scenes import Linkage, leading_joint, motion_of


class MujocoLinkageDrive:
    """Velocity control of the leading joint with a limited effort.

    In each step the effort changes by what would bring the joint to its target velocity in that step, with the inertia
    of the whole mechanism reflected to the joint. Free, the joint has its velocity at once, however light its links
    are; against an object the effort rises to its limit within some steps.
    """

    def __init__(self, model: Any, data: Any, linkage: Linkage, joints: Mapping[int, str], *, step_s: float) -> None:
        """Look up the joints.

        Args:
            model: The engine's model.
            data: Its state.
            linkage: The mechanism.
            joints: Name of the joint of each link by the index of the link.
            step_s: Length of a step.
        """
        self._model, self._data, self._linkage, self._step_s = model, data, linkage, step_s
        self._positions = {index: int(model.joint(name).qposadr[0]) for index, name in joints.items()}
        leader = leading_joint(linkage)
        self._leading, self._leader_at = linkage.links[leader], self._positions[leader]
        self._speed = int(model.joint(joints[leader]).dofadr[0])
        self._motor = int(model.actuator(joints[leader]).id)
        self._ratios, self._inertias = np.zeros(model.nv), np.zeros(model.nv)
        for index, name in joints.items():
            self._ratios[int(model.joint(name).dofadr[0])] = linkage.links[index].multiplier / self._leading.multiplier
        self._command, self._effort, self._speed_before = (0.0, 0.0), 0.0, 0.0

    @property
    def largest_error(self) -> float:
        """Greatest deviation of a joint from where the leading joint puts it, in rad or m."""
        qpos, driven = self._data.qpos, self._driven_position
        return max(
            abs(float(qpos[at]) - self._linkage.joint_position(index, driven)) for index, at in self._positions.items()
        )

    def reset(self) -> None:
        """Put the mechanism at rest, open."""
        for index, at in self._positions.items():
            self._data.qpos[at] = self._linkage.joint_position(index, self._linkage.opened)
        self._effort = self._speed_before = 0.0

    def drive(self, velocity_m_s: float, force_n: float) -> None:
        """Move each pad at a velocity (positive closes) with at most a force, from now on.

        Args:
            velocity_m_s: Velocity of each pad.
            force_n: Force of each pad; the effort of the driven joint limits it.
        """
        self._command = (velocity_m_s, force_n)

    def before_step(self) -> None:
        """Set the motor's effort, after the engine has computed the mass matrix of the step."""
        velocity_m_s, force_n = self._command
        data = self._data
        velocity, greatest = motor_command(
            self._linkage,
            self._driven_position,
            velocity_m_s=velocity_m_s,
            force_n=force_n,
            step_s=self._step_s,
        )
        velocity, greatest = velocity * self._leading.multiplier, greatest / abs(self._leading.multiplier)
        mujoco().mj_mulM(self._model, data, self._inertias, self._ratios)
        inertia, speed = float(self._ratios @ self._inertias), float(data.qvel[self._speed])
        # The acceleration of the last step shows the other forces, which are taken to persist.
        wanted, present = (velocity - speed) / self._step_s, (speed - self._speed_before) / self._step_s
        self._effort = min(max(self._effort + inertia * (wanted - present), -greatest), greatest)
        self._speed_before = speed
        data.ctrl[self._motor] = self._effort

    def travel_m(self) -> tuple[float, ...]:
        """Travel of each pad from open in m, from the leading joint."""
        travel_m = motion_of(self._linkage).travel_m(self._driven_position)
        return (travel_m,) * len(self._linkage.pads)

    @property
    def _driven_position(self) -> float:
        """Position of the driven joint that belongs to that of the leading one."""
        return (float(self._data.qpos[self._leader_at]) - self._leading.offset) / self._leading.multiplier
