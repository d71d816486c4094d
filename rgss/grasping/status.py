"""Contact status: separated, touching or penetrating; rolling or slipping."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np

from rgss.grasping.contact import ContactPoint, Vector3
from rgss.grasping.kinematics import ContactMotion
from rgss.grasping.screws import Twist, Wrench, reciprocal_product


class ContactState(str, Enum):
    """Contact state by the gap between two bodies."""

    SEPARATED = "separated"
    TOUCHING = "touching"
    PENETRATING = "penetrating"


class Tendency(str, Enum):
    """Tendency of the gap: growing, constant or shrinking (penetrating, if in contact)."""

    SEPARATING = "separating"
    STAYING = "staying"
    PENETRATING = "penetrating"


class Sliding(str, Enum):
    """Relative motion of the surfaces in the tangent plane.

    Attributes:
        ROLLING: No relative tangential motion.
        SLIP_EMERGING: No relative velocity, but a relative acceleration.
        SLIPPING: Relative tangential motion.
    """

    ROLLING = "rolling"
    SLIP_EMERGING = "slip_emerging"
    SLIPPING = "slipping"


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactTolerances:
    """Tolerances: smaller gaps, speeds and accelerations count as zero."""

    gap_m: float = 1e-6
    speed_m_s: float = 1e-6
    acceleration_m_s2: float = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactStatus:
    """Status of a contact.

    Attributes:
        state: State by the gap.
        tendency: Tendency by the first non-zero derivative of the gap.
        sliding: State of the tangential motion; None if the bodies are separated.
    """

    state: ContactState
    tendency: Tendency
    sliding: Sliding | None


def contact_status(motion: ContactMotion, tolerances: ContactTolerances | None = None) -> ContactStatus:
    """Status of a contact.

    A contact lasts only while the gap and its derivatives are zero; the first non-zero one gives the direction of its
    change. An unknown acceleration counts as zero.
    """
    limits = tolerances or ContactTolerances()
    state = ContactState.TOUCHING
    if abs(motion.gap_m) > limits.gap_m:
        state = ContactState.SEPARATED if motion.gap_m > 0.0 else ContactState.PENETRATING
    tendency = _tendency(motion.gap_rate_m_s, limits.speed_m_s)
    if tendency is Tendency.STAYING and motion.gap_acceleration_m_s2 is not None:
        tendency = _tendency(motion.gap_acceleration_m_s2, limits.acceleration_m_s2)
    sliding: Sliding | None = None
    if state is not ContactState.SEPARATED:
        change = motion.tangential_acceleration_m_s2
        sliding = Sliding.ROLLING
        if math.hypot(*motion.tangential_velocity_m_s) > limits.speed_m_s:
            sliding = Sliding.SLIPPING
        elif change is not None and math.hypot(*change) > limits.acceleration_m_s2:
            sliding = Sliding.SLIP_EMERGING
    return ContactStatus(state=state, tendency=tendency, sliding=sliding)


def contact_normal_wrench(contact: ContactPoint, reference_m: Vector3) -> Wrench:
    """Wrench of a force of 1 N along a contact's normal, about a reference point."""
    offset = np.subtract(reference_m, contact.position_m)
    return Wrench(force_n=contact.normal).moved(tuple(offset.tolist()))


def twist_tendency(
    twist: Twist,
    contact: ContactPoint,
    reference_m: Vector3,
    *,
    finger_velocity_m_s: Vector3 = (0.0, 0.0, 0.0),
    tolerance_m_s: float = 1e-9,
) -> Tendency:
    """Tendency of a contact under a twist of the object: breaking, maintained or penetrating.

    Decided by the power of a unit force along the normal: tᵀW must be at least the finger's speed along the normal (eq.
    2.5 to 2.8); for a resting finger tᵀW ≥ 0.

    Args:
        twist: Motion of the object about the reference point.
        contact: The contact.
        reference_m: The reference point.
        finger_velocity_m_s: Velocity of the finger's point.
        tolerance_m_s: Speeds up to it count as zero.
    """
    power = reciprocal_product(twist, contact_normal_wrench(contact, reference_m))
    return _tendency(power - float(np.dot(contact.normal, finger_velocity_m_s)), tolerance_m_s)


def _tendency(value: float, tolerance: float) -> Tendency:
    if abs(value) <= tolerance:
        return Tendency.STAYING
    return Tendency.SEPARATING if value > 0.0 else Tendency.PENETRATING
