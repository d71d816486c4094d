"""Tool-tracking control law by differential inverse kinematics."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics import DifferentialInverse
from rgss.scenes import Joint

Array = NDArray[np.float64]

_BRAKING_STEPS = 10


class ToolFrames(Protocol):
    """Kinematics of the tool: its pose and its Jacobian."""

    def tool_matrix(self, q: Sequence[float] | Array) -> Array:
        """Homogeneous transform of the tool-centre frame to the world, shape (4, 4)."""

    def tool_jacobian(self, q: Sequence[float] | Array) -> Array:
        """Jacobian at the tool centre along the axes of the world, shape (6, n)."""


class ToolTrackingLaw:
    """Commanded acceleration g (q̇_c - q̇), with the q̇_c that gives the tool the velocity V_d + k e.

    V_d is the velocity of the tool at the target, e the error of its pose: a displacement, and the rotation vector from
    the tool to the target. Redundancy is resolved by the joint speeds of the target plus k times the joint error. The
    differential inverse keeps joint speeds and ranges within their limits.
    """

    def __init__(
        self,
        tool: ToolFrames,
        joints: Sequence[Joint],
        *,
        position_gain_1_s: Array,
        velocity_gain_1_s: Array,
        step_s: float,
    ) -> None:
        """Set the gains.

        Args:
            tool: Kinematics of the tool.
            joints: The arm's joints, in order.
            position_gain_1_s: k of each joint, shape (n,); that of the tool is the least.
            velocity_gain_1_s: g of each joint, shape (n,).
            step_s: Time between two commands.
        """
        self._tool = tool
        self._inverse = DifferentialInverse(joints, braking_s=_BRAKING_STEPS * step_s)
        self._position_gain = position_gain_1_s
        self._velocity_gain = velocity_gain_1_s
        self._step_s = step_s

    def __call__(self, target: Array, speed: Array, acceleration: Array, q: Array, dq: Array) -> Array:
        """Acceleration over the coming step, each of shape (n,).

        Args:
            target: Present target positions.
            speed: Target speeds of the previous step.
            acceleration: Change of the target speeds to the coming step, divided by its length.
            q: Present positions.
            dq: Present speeds.
        """
        ahead = speed + self._step_s * acceleration
        there, here = self._tool.tool_matrix(target), self._tool.tool_matrix(q)
        error = np.concatenate([there[:3, 3] - here[:3, 3], _rotation_vector(there[:3, :3] @ here[:3, :3].T)])
        velocity = self._tool.tool_jacobian(target) @ ahead + self._position_gain.min() * error
        preferred = ahead + self._position_gain * (target - q)
        commanded = self._inverse.speeds(self._tool.tool_jacobian(q), velocity, q, preferred)
        wanted: Array = self._velocity_gain * (commanded - dq)
        return wanted


def _rotation_vector(rotation: Array) -> Array:
    """Rotation vector, axis times angle in rad, of a rotation matrix, shape (3,)."""
    from scipy.spatial.transform import Rotation

    found: Array = Rotation.from_matrix(rotation).as_rotvec()
    return found
