"""Screws: twists (motion of a rigid body) and wrenches (load on it)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from rgss.grasping.contact import Vector3


@dataclass(frozen=True, slots=True, kw_only=True)
class Twist:
    """Twist: velocity of a rigid body, t = (ω, v) (eq. 2.3).

    Attributes:
        angular_rad_s: Angular velocity.
        linear_m_s: Velocity of the body at the reference point.
    """

    angular_rad_s: Vector3 = (0.0, 0.0, 0.0)
    linear_m_s: Vector3 = (0.0, 0.0, 0.0)

    def moved(self, offset_m: Vector3) -> Twist:
        """The same motion with the reference point shifted by an offset: v + ω × offset."""
        return Twist(
            angular_rad_s=self.angular_rad_s,
            linear_m_s=_triple(np.add(self.linear_m_s, np.cross(self.angular_rad_s, offset_m))),
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class Wrench:
    """Wrench: load on a rigid body, W = (τ, f) (eq. 2.4).

    Attributes:
        torque_n_m: Torque about the reference point.
        force_n: Force.
    """

    torque_n_m: Vector3 = (0.0, 0.0, 0.0)
    force_n: Vector3 = (0.0, 0.0, 0.0)

    def moved(self, offset_m: Vector3) -> Wrench:
        """The same load with the reference point shifted by an offset: τ - offset × f."""
        return Wrench(
            torque_n_m=_triple(np.subtract(self.torque_n_m, np.cross(offset_m, self.force_n))), force_n=self.force_n
        )


def reciprocal_product(twist: Twist, wrench: Wrench) -> float:
    """Reciprocal product: power of a wrench on a twist about the same reference point, tᵀW = ω·τ + v·f, in W (eq. 2.7).

    Zero for a reciprocal pair: the load does no work on the motion.
    """
    return float(np.dot(twist.angular_rad_s, wrench.torque_n_m) + np.dot(twist.linear_m_s, wrench.force_n))


def _triple(vector: np.typing.ArrayLike) -> Vector3:
    x, y, z = np.asarray(vector, dtype=float).tolist()
    return x, y, z
