"""Deviation of the tool from a pose, and its linearisation for damped least squares."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.kinematics.cross_product import cross_product
from rgss.kinematics.serial_chain import ChainState

Array = NDArray[np.float64]

_LEAST_SINE = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PoseResidual:
    """Residual between tool and target; a radian counts as a metre.

    Attributes:
        position_m: Position of the target in the world, shape (3,).
        rotation: Its orientation, shape (3, 3).
        is_axis_alone: True if only the tool's axis, z, of the orientation is requested.
    """

    position_m: Array
    rotation: Array
    is_axis_alone: bool = False

    def linearised(self, state: ChainState) -> tuple[Array, Array]:
        """Residuals and their Jacobians with respect to the joint positions.

        Args:
            state: State of the chain in k configurations.

        Returns:
            Residuals, shape (k, 6), of which the last three are a rotation vector, and Jacobians, shape (k, 6, n).
        """
        linear = self.position_m - state.position_m
        if not self.is_axis_alone:
            angular = _rotation_vectors(self.rotation @ state.rotation.transpose(0, 2, 1))
            return np.concatenate([linear, angular], axis=1), state.jacobian
        axes = state.rotation[:, :, 2]
        crossed = cross_product(axes, self.rotation[:, 2])
        sines = np.linalg.norm(crossed, axis=1, keepdims=True)
        angles = np.arctan2(sines, (axes @ self.rotation[:, 2])[:, None])
        angular = crossed * (angles / np.maximum(sines, _LEAST_SINE))
        across = np.eye(3) - axes[:, :, None] * axes[:, None, :]
        jacobian = np.concatenate([state.jacobian[:, :3], across @ state.jacobian[:, 3:]], axis=1)
        return np.concatenate([linear, angular], axis=1), jacobian

    def deviation(self, state: ChainState) -> Array:
        """Greatest deviation in m and in the entries of the rotation matrix, shape (k,)."""
        turned = np.abs(state.rotation - self.rotation)
        turned = turned[:, :, 2:] if self.is_axis_alone else turned
        moved = np.abs(state.position_m - self.position_m)
        found: Array = np.maximum(np.max(turned, axis=(1, 2)), np.max(moved, axis=1))
        return found


def _rotation_vectors(rotations: Array) -> Array:
    """Rotation vectors, axis times angle in rad, of rotation matrices (k, 3, 3), shape (k, 3)."""
    doubled = np.stack(
        [
            rotations[:, 2, 1] - rotations[:, 1, 2],
            rotations[:, 0, 2] - rotations[:, 2, 0],
            rotations[:, 1, 0] - rotations[:, 0, 1],
        ],
        axis=1,
    )
    sines = np.linalg.norm(doubled, axis=1) / 2
    cosines = (np.trace(rotations, axis1=1, axis2=2) - 1) / 2
    scale = np.arctan2(sines, cosines) / np.maximum(sines, _LEAST_SINE)
    found: Array = doubled / 2 * np.where(sines > _LEAST_SINE, scale, 1.0)[:, None]
    return found
