"""Forward kinematics and Jacobians of many configurations at once, as products of exponentials."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.arm import Arm
from rgss.kinematics.cross_product import cross_product

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class ChainState:
    """Tool frames and Jacobians of a chain in k configurations.

    Attributes:
        position_m: Position of the tool centre in the world, shape (k, 3).
        rotation: Orientation of the tool-centre frame in the world, shape (k, 3, 3).
        jacobian: Jacobian at the tool centre along the axes of the world, linear rows first, shape (k, 6, n).
    """

    position_m: Array
    rotation: Array
    jacobian: Array


class SerialChain:
    """Product-of-exponentials form of a serial arm: its axes and points at the zero configuration.

    Source: K. M. Lynch, F. C. Park, "Modern Robotics", Cambridge University Press 2017, chapter 4.

    Args:
        arm: The arm with its tool.
    """

    def __init__(self, arm: Arm) -> None:
        directions, steps = arm.joint_axes()
        self._coupling = arm.coupling
        self._slides = arm.coupling.slides
        self._axes = directions
        self._first_m, self._steps = steps[0], steps[1:]
        self._at_zero = arm.tool_rotation_at_zero()
        along = directions[:, :, None] * directions[:, None, :]
        x, y, z = directions.T
        zero = np.zeros_like(x)
        self._cross = np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]]).transpose(2, 0, 1)
        self._along, self._across = along, np.eye(3) - along

    def state(self, qs: Array) -> ChainState:
        """Tool frames and Jacobians.

        Args:
            qs: Joint positions, shape (k, n).
        """
        qs = self._coupling.positions(qs)
        count, joints = qs.shape
        angles = np.where(self._slides, 0.0, qs)[:, :, None, None]
        turns = self._along + np.cos(angles) * self._across + np.sin(angles) * self._cross
        rotation = np.broadcast_to(np.eye(3), (count, 3, 3))
        position = np.tile(self._first_m, (count, 1))
        axes, origins = np.empty((count, joints, 3)), np.empty((count, joints, 3))
        for joint in range(joints):
            axes[:, joint] = rotation @ self._axes[joint]
            origins[:, joint] = position
            if self._slides[joint]:
                position = position + qs[:, joint, None] * axes[:, joint]
            else:
                rotation = rotation @ turns[:, joint]
            position = position + rotation @ self._steps[joint]
        turning = np.where(self._slides[:, None], 0.0, axes)
        moving = np.where(self._slides[:, None], axes, cross_product(axes, position[:, None] - origins))
        jacobian = self._coupling.reduced(np.concatenate([moving, turning], axis=2).transpose(0, 2, 1))
        return ChainState(position_m=position, rotation=rotation @ self._at_zero, jacobian=jacobian)
