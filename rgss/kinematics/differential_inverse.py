"""Differential inverse kinematics: joint speeds that track a tool velocity within the joints' limits."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import Joint

Vector = NDArray[np.float64]


class DifferentialInverse:
    """Joint speeds that track a velocity of the tool within the limits of the joints.

    They minimise

        |J q̇ - V|² + λ |q̇ - q̇_0|²   with   l <= q̇ <= u

    where V is the velocity of the tool and q̇_0 are preferred joint speeds, which resolve the redundancy and damp q̇
    near a singularity. The bounds are the joints' speeds, and near the end of a joint's range the speed with which it
    would reach the end in a stated time, so that it never leaves the range. The least-squares problem with bounds is
    solved exactly (J. L. Stark and R. L. Parker, "Bounded-variable least squares", Computational Statistics 10, 1995).
    The velocity damper at the ends is that of B. Faverjon and P. Tournassoud, ICRA 1987.
    """

    def __init__(self, joints: Sequence[Joint], *, braking_s: float, damping: float = 1.0e-6) -> None:
        """Precompute the limits.

        Args:
            joints: The arm's joints, in order.
            braking_s: Time in which a joint would reach the end of its range at the greatest speed that is allowed
                there; at least the time between two calls.
            damping: λ in m²; a radian of the tool's rotation counts as a metre.
        """
        self._lower = np.array([joint.lower_rad for joint in joints])
        self._upper = np.array([joint.upper_rad for joint in joints])
        self._fastest = np.array([joint.speed_rad_s for joint in joints])
        self._braking_s = braking_s
        self._weight = np.sqrt(damping)

    def speeds(self, jacobian: Vector, velocity: Vector, q: Vector, preferred: Vector) -> Vector:
        """Joint speeds, shape (n,).

        Args:
            jacobian: Jacobian J of the tool, shape (6, n): linear rows first.
            velocity: V, shape (6,): linear in m/s, angular in rad/s.
            q: Joint positions, shape (n,).
            preferred: q̇_0, shape (n,).
        """
        from scipy.optimize import lsq_linear

        lower = np.maximum(-self._fastest, np.minimum(0.0, (self._lower - q) / self._braking_s))
        upper = np.minimum(self._fastest, np.maximum(0.0, (self._upper - q) / self._braking_s))
        # A joint outside its range by a rounding error may still go back.
        upper = np.maximum(upper, lower + 1.0e-12)
        matrix = np.vstack([jacobian, self._weight * np.eye(len(q))])
        wanted = np.concatenate([velocity, self._weight * preferred])
        free = np.linalg.lstsq(matrix, wanted, rcond=None)[0]
        if np.all(free >= lower) and np.all(free <= upper):
            return np.asarray(free)
        found: Vector = lsq_linear(matrix, wanted, bounds=(lower, upper), method="bvls").x
        return found
