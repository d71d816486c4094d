"""Contact kinematics: gap derivatives and relative tangential motion of two moving bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import ContactPoint, Matrix, Vector3
from rgss.grasping.screws import Twist

_AT_REST: Vector3 = (0.0, 0.0, 0.0)
_COINCIDENT_M = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True)
class BodyMotion:
    """Motion of a rigid body at one instant, in an inertial frame.

    Attributes:
        reference_m: Reference point of the body.
        twist: Angular velocity, and velocity of that point.
        angular_acceleration_rad_s2: Angular acceleration.
        linear_acceleration_m_s2: Acceleration of that point.
    """

    reference_m: Vector3
    twist: Twist
    angular_acceleration_rad_s2: Vector3 = _AT_REST
    linear_acceleration_m_s2: Vector3 = _AT_REST

    def velocity_at(self, point_m: Matrix) -> Matrix:
        """Velocity (m/s) of the body's point at a position, shape (3,)."""
        arm = point_m - np.array(self.reference_m)
        velocity: Matrix = np.array(self.twist.linear_m_s) + np.cross(self.twist.angular_rad_s, arm)
        return velocity

    def acceleration_at(self, point_m: Matrix) -> Matrix:
        """Acceleration (m/s²) of the body's point at a position, shape (3,)."""
        arm, spin = point_m - np.array(self.reference_m), np.array(self.twist.angular_rad_s)
        turning = np.cross(self.angular_acceleration_rad_s2, arm) + np.cross(spin, np.cross(spin, arm))
        acceleration: Matrix = np.array(self.linear_acceleration_m_s2) + turning
        return acceleration


@dataclass(frozen=True, slots=True, kw_only=True)
class Curvature:
    """Principal curvatures of a surface at a point: positive where it is convex, 1/R for a sphere, 0 for a plane.

    Attributes:
        along_per_m: Curvature along the direction.
        across_per_m: Curvature across it.
        direction: The first principal direction, projected onto the tangent plane.
    """

    along_per_m: float
    across_per_m: float
    direction: Vector3

    def tensor(self, normal: Matrix) -> Matrix:
        """Shape operator: change of the unit normal with the point on the surface, shape (3, 3), in 1/m.

        Raises:
            DefinitionError: The direction is along the normal.
        """
        across = np.cross(normal, self.direction)
        length = float(np.linalg.norm(across))
        if not length > 1e-6 * math.hypot(*self.direction):
            raise DefinitionError(
                f"the direction {self.direction} of a curvature is along the normal",
                hint="give a vector in the tangent plane",
            )
        across /= length
        along = np.cross(across, normal)
        tensor: Matrix = self.along_per_m * np.outer(along, along) + self.across_per_m * np.outer(across, across)
        return tensor


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactMotion:
    """Motion of the object relative to the finger at one contact.

    Attributes:
        gap_m: Distance along the normal, negative for penetration.
        gap_rate_m_s: Its first derivative.
        gap_acceleration_m_s2: Its second derivative; None if accelerations are unknown.
        tangential_velocity_m_s: Relative velocity in the tangent plane.
        tangential_acceleration_m_s2: Its derivative, projected onto that plane; None if unknown.
    """

    gap_m: float
    gap_rate_m_s: float
    gap_acceleration_m_s2: float | None
    tangential_velocity_m_s: Vector3
    tangential_acceleration_m_s2: Vector3 | None


def recorded_motion(contact: ContactPoint) -> ContactMotion:
    """Relative motion stored in a contact, without accelerations."""
    normal, velocity = np.array(contact.unit_normal()), np.array(contact.relative_velocity_m_s)
    rate = float(normal @ velocity)
    return ContactMotion(
        gap_m=contact.gap_m,
        gap_rate_m_s=rate,
        gap_acceleration_m_s2=None,
        tangential_velocity_m_s=tuple((velocity - rate * normal).tolist()),
        tangential_acceleration_m_s2=None,
    )


def relative_motion(
    contact: ContactPoint,
    finger: BodyMotion,
    grasped: BodyMotion,
    *,
    finger_curvature: Curvature | None = None,
    object_curvature: Curvature | None = None,
) -> ContactMotion:
    """Derivatives of the gap and of the tangential motion from the motions of the two bodies.

    With the normal n from the finger (1) to the object (2), the nearest points c₁ and c₂ = c₁ + P n, the velocities v
    and accelerations a of the bodies' points there, and the rates s at which the nearest points move over the surfaces:

        dP/dt   = n·(v₂ - v₁)                                                            (eq. 2.1)
        d²P/dt² = n·(a₂ - a₁) + n·(ω₂ × s₂ - ω₁ × s₁) + dn/dt·(v₂ - v₁)                  (eq. 2.2)
        dn/dt   = ω₁ × n + K₁ s₁ = ω₂ × n - K₂ s₂,     s₂ - s₁ = P dn/dt - (v₂ - v₁) in the tangent plane

    The last line is Montana's (The kinematics of contact and grasp, 1988) with a gap. If both surfaces are straight in
    the same direction the nearest points are not unique; those with the least motion over the finger are used.

    Args:
        contact: Position on the object, normal and gap; its recorded motion is ignored.
        finger: Motion of the finger.
        grasped: Motion of the object.
        finger_curvature: Curvature of the finger's surface; None for a sharp tip, whose nearest point is fixed.
        object_curvature: Curvature of the object's surface; None for a flat face.
    """
    axes = contact.axes()
    normal, tangents, gap = axes[0], axes[1:], contact.gap_m
    on_object = np.array(contact.position_m)
    on_finger = on_object - gap * normal
    velocity = grasped.velocity_at(on_object) - finger.velocity_at(on_finger)
    acceleration = grasped.acceleration_at(on_object) - finger.acceleration_at(on_finger)
    finger_spin, object_spin = np.array(finger.twist.angular_rad_s), np.array(grasped.twist.angular_rad_s)

    slip = tangents @ velocity
    finger_turn, object_turn = (tangents @ np.cross(spin, normal) for spin in (finger_spin, object_spin))
    object_bend = _in_plane(object_curvature, normal, tangents)
    if finger_curvature is None:
        over_finger = np.zeros(2)
        over_object = _least(np.eye(2) + gap * object_bend, gap * object_turn - slip)
        normal_rate = object_turn - object_bend @ over_object
    else:
        finger_bend = _in_plane(finger_curvature, normal, tangents)
        spread = np.eye(2) + gap * finger_bend
        over_finger = _least(
            finger_bend + object_bend @ spread, object_turn - finger_turn + object_bend @ (slip - gap * finger_turn)
        )
        normal_rate = finger_turn + finger_bend @ over_finger
        over_object = over_finger + gap * normal_rate - slip

    carried = np.cross(object_spin, over_object @ tangents) - np.cross(finger_spin, over_finger @ tangents)
    change = acceleration + carried
    rate = float(normal @ velocity)
    # The tangent plane rotates too: that term of the normal velocity belongs to the tangential motion.
    tangential_change = tangents @ change - rate * normal_rate
    return ContactMotion(
        gap_m=gap,
        gap_rate_m_s=rate,
        gap_acceleration_m_s2=float(normal @ change + normal_rate @ slip),
        tangential_velocity_m_s=tuple((slip @ tangents).tolist()),
        tangential_acceleration_m_s2=tuple((tangential_change @ tangents).tolist()),
    )


def gap_between(finger_point_m: Vector3, finger_normal: Vector3, object_point_m: Vector3) -> float:
    """Signed distance in m of two facing points along the finger's unit outward normal (eq. 2.9, 2.13)."""
    return float(np.dot(np.subtract(object_point_m, finger_point_m), finger_normal))


def is_potential_contact(
    finger_point_m: Vector3,
    finger_normal: Vector3,
    object_point_m: Vector3,
    object_normal: Vector3,
    *,
    tolerance: float = 1e-6,
) -> bool:
    """True if two points satisfy the direction conditions of nearest points of two surfaces (eq. 2.11, 2.12).

    The outward normals are opposed, and the line between the points is along them.

    Args:
        finger_point_m: Point on the finger.
        finger_normal: Its unit outward normal.
        object_point_m: Point on the object.
        object_normal: Its unit outward normal.
        tolerance: Greatest sine of an angle that counts as zero.
    """
    between = np.subtract(object_point_m, finger_point_m)
    opposed = np.dot(finger_normal, object_normal) < 0.0
    aside = max(float(np.linalg.norm(np.cross(between, normal))) for normal in (finger_normal, object_normal))
    skew = float(np.linalg.norm(np.cross(finger_normal, object_normal)))
    return bool(opposed and skew <= tolerance and aside <= tolerance * float(np.linalg.norm(between)) + _COINCIDENT_M)


def _in_plane(curvature: Curvature | None, normal: Matrix, tangents: Matrix) -> Matrix:
    if curvature is None:
        return np.zeros((2, 2))
    projected: Matrix = tangents @ curvature.tensor(normal) @ tangents.T
    return projected


def _least(matrix: Matrix, right: Matrix) -> Matrix:
    solution: Matrix = np.linalg.pinv(matrix, rcond=1e-9) @ right
    return solution
