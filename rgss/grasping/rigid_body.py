"""Rigid-body norms (eq. 3.5) of displacement, velocity and load, with one characteristic length."""

from __future__ import annotations

import math

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.screws import Twist, Wrench
from rgss.scenes import Pose


def configuration_distance_m(first: Pose, second: Pose, characteristic_length_m: float) -> float:
    """Distance of two poses of a body, √(|Δp|² + (ρ Δφ)²), in m.

    Δp is the displacement of the body frame's origin, preferably at the centre of mass; Δφ is the rotation angle, from
    0 to π, between the two orientations. It is a metric, and invariant under changes of the inertial frame.

    Raises:
        DefinitionError: The length is not positive.
    """
    length = _positive(characteristic_length_m)
    relative = first.inverse() @ second
    x, y, z, w = relative.quaternion_xyzw
    angle = 2.0 * math.atan2(math.hypot(x, y, z), abs(w))
    return math.hypot(*relative.position_m, length * angle)


def velocity_norm_m_s(twist: Twist, characteristic_length_m: float) -> float:
    """Norm of a twist, √(|v|² + (ρ |ω|)²), in m/s; of the difference of two twists for a relative velocity.

    Raises:
        DefinitionError: The length is not positive.
    """
    return math.sqrt(twist_inner_product(twist, twist, characteristic_length_m))


def wrench_norm_n(wrench: Wrench, characteristic_length_m: float) -> float:
    """Norm of a wrench, √(|f|² + (|τ| / ρ)²), in N.

    It is dual to the velocity norm: the power of a wrench on a twist never exceeds the product of the two.

    Raises:
        DefinitionError: The length is not positive.
    """
    return math.sqrt(wrench_inner_product(wrench, wrench, characteristic_length_m))


def twist_inner_product(first: Twist, second: Twist, characteristic_length_m: float) -> float:
    """Inner product of two twists, v₁·v₂ + ρ² ω₁·ω₂, in m²/s².

    Raises:
        DefinitionError: The length is not positive.
    """
    length = _positive(characteristic_length_m)
    moving = float(np.dot(first.linear_m_s, second.linear_m_s))
    return moving + length**2 * float(np.dot(first.angular_rad_s, second.angular_rad_s))


def wrench_inner_product(first: Wrench, second: Wrench, characteristic_length_m: float) -> float:
    """Inner product of two wrenches, f₁·f₂ + τ₁·τ₂ / ρ², in N².

    Raises:
        DefinitionError: The length is not positive.
    """
    length = _positive(characteristic_length_m)
    return float(np.dot(first.force_n, second.force_n)) + float(np.dot(first.torque_n_m, second.torque_n_m)) / length**2


def _positive(characteristic_length_m: float) -> float:
    if not 0.0 < characteristic_length_m < math.inf:
        raise DefinitionError(
            f"a characteristic length must be positive, got {characteristic_length_m:g} m",
            hint="give a length above zero",
        )
    return characteristic_length_m
