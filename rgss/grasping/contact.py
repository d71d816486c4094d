"""Contact point of a finger and an object: position, normal, friction and kind."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError

Vector3 = tuple[float, float, float]
"""Vector of three components in a right-handed frame."""

Matrix = NDArray[np.float64]
"""Array of floats; its shape is given where it is used."""

_UNIT_LENGTH_TOLERANCE = 1e-6
_NEARLY_VERTICAL = 0.9
_NEARLY_PARALLEL = 1e-6


class ContactKind(str, Enum):
    """Contact model: the forces that a contact transmits besides its normal force.

    Attributes:
        FRICTIONLESS: None.
        HARD: Friction in the tangent plane (a point contact with friction).
        SOFT: Friction in the tangent plane and a torque about the normal (a soft finger).
    """

    FRICTIONLESS = "frictionless"
    HARD = "hard"
    SOFT = "soft"


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactPoint:
    """One point of contact between a finger and the grasped object.

    All vectors are in one frame. Friction cones are replaced by pyramids whose edges start from `tangent`, so give
    contacts in a frame fixed to the object, or give tangents: the results are then invariant under rotation of the
    object.

    Attributes:
        position_m: The point on the object.
        normal: Unit vector that points into the object.
        kind: The contact model.
        friction: Coulomb's coefficient of the pair of surfaces; ignored for a frictionless contact.
        torsional_friction_m: Greatest torque about the normal over the normal force; for a soft contact only.
        normal_force_n: Present force along the normal.
        friction_force_n: Present friction force on the object.
        gap_m: Distance between finger and object along the normal, negative for penetration.
        relative_velocity_m_s: Velocity of the object's point relative to the finger's.
        finger: Index of the finger; its points share one force limit and form one corner of the grasp polygon. None for
        a finger with this point only.
        tangent: Direction of the first edge of the friction pyramid, projected onto the tangent plane. None for the
        frame's z axis, or its x axis if the normal is near z.
    """

    position_m: Vector3
    normal: Vector3
    kind: ContactKind = ContactKind.HARD
    friction: float = 0.0
    torsional_friction_m: float = 0.0
    normal_force_n: float = 0.0
    friction_force_n: Vector3 = (0.0, 0.0, 0.0)
    gap_m: float = 0.0
    relative_velocity_m_s: Vector3 = (0.0, 0.0, 0.0)
    finger: int | None = None
    tangent: Vector3 | None = None

    def __post_init__(self) -> None:
        """Validate the contact.

        Raises:
            DefinitionError: A number is not finite, the normal is not a unit vector, a coefficient or the normal force
            is negative, or the tangent is parallel to the normal.
        """
        for name in ("position_m", "normal", "friction_force_n", "relative_velocity_m_s", "tangent"):
            vector = getattr(self, name)
            if vector is not None and not (len(vector) == 3 and all(map(math.isfinite, vector))):
                raise DefinitionError(f"a contact cannot have the {name} {vector}", hint="give three finite numbers")
        for name in ("friction", "torsional_friction_m", "normal_force_n"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value >= 0.0):
                raise DefinitionError(f"a contact cannot have the {name} {value:g}", hint="give a number from 0")
        if not math.isfinite(self.gap_m):
            raise DefinitionError(f"a contact cannot have the gap_m {self.gap_m:g}", hint="give a finite number")
        length = math.hypot(*self.normal)
        if abs(length - 1.0) > _UNIT_LENGTH_TOLERANCE:
            raise DefinitionError(f"the normal of a contact has the length {length:.9g}", hint="give it the length 1")
        if self.tangent is not None:
            across = np.linalg.norm(np.cross(self.normal, self.tangent))
            if not across > _NEARLY_PARALLEL * math.hypot(*self.tangent):
                raise DefinitionError(
                    f"the tangent {self.tangent} of a contact has no direction in its tangent plane",
                    hint="give a vector that is not along the normal",
                )

    def unit_normal(self) -> Vector3:
        """The normal, normalised to rounding."""
        return _unit(self.normal)

    def tangents(self) -> tuple[Vector3, Vector3]:
        """Two unit tangents; (normal, tangent, tangent) is right-handed."""
        # In plain numbers: a grasp needs many of these, and arrays of three are slow.
        normal, towards = self.unit_normal(), self.tangent
        if towards is None:
            towards = (0.0, 0.0, 1.0) if abs(normal[2]) <= _NEARLY_VERTICAL else (1.0, 0.0, 0.0)
        second = _unit(_cross(normal, towards))
        return _cross(second, normal), second

    def axes(self) -> Matrix:
        """Contact frame: unit normal and two unit tangents as rows, right-handed, shape (3, 3)."""
        return np.array([self.unit_normal(), *self.tangents()])


def _unit(vector: Vector3) -> Vector3:
    length = math.hypot(*vector)
    return vector[0] / length, vector[1] / length, vector[2] / length


def _cross(first: Vector3, second: Vector3) -> Vector3:
    (ax, ay, az), (bx, by, bz) = first, second
    return ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
