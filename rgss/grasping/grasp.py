"""Grasp: the contacts on one object, its centre of mass, and the characteristic length."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import ContactPoint, Matrix, Vector3


@dataclass(frozen=True, slots=True, kw_only=True)
class Grasp:
    """Contacts on one object.

    A torque is divided by the characteristic length wherever it is combined with a force, so that both are in N, and
    singular values, norms and balls of wrenches are defined. Measures that combine them depend on that length: compare
    grasps of one object with the same length.

    Attributes:
        contacts: The contacts, at least one.
        centre_of_mass_m: The object's centre of mass in the frame of the contacts; the reference point of torques.
        characteristic_length_m: The characteristic length, above zero.
    """

    contacts: tuple[ContactPoint, ...]
    centre_of_mass_m: Vector3
    characteristic_length_m: float

    def __post_init__(self) -> None:
        """Validate the grasp.

        Raises:
            DefinitionError: There is no contact, the centre of mass is not a point, or the length is not positive.
        """
        if not self.contacts:
            raise DefinitionError("a grasp must have at least one contact, got none", hint="give at least one contact")
        centre = self.centre_of_mass_m
        if not (len(centre) == 3 and all(map(math.isfinite, centre))):
            raise DefinitionError(f"{centre} is not a centre of mass", hint="give three finite numbers")
        if not 0.0 < self.characteristic_length_m < math.inf:
            raise DefinitionError(
                f"the characteristic length of a grasp must be positive, got {self.characteristic_length_m:g} m",
                hint="give a length above zero, such as the object's greatest radius",
            )

    @staticmethod
    def of(
        contacts: Sequence[ContactPoint], centre_of_mass_m: Vector3, characteristic_length_m: float | None = None
    ) -> Grasp:
        """Grasp with a default characteristic length: the greatest distance of a contact from the centre of mass.

        With this default the scaled torques of unit forces are at most 1 for objects of any size.

        Raises:
            DefinitionError: As for the class; also when every contact is at the centre of mass and no length is given.
        """
        length = characteristic_length_m
        if length is None:
            length = max((math.dist(contact.position_m, centre_of_mass_m) for contact in contacts), default=1.0)
        return Grasp(contacts=tuple(contacts), centre_of_mass_m=centre_of_mass_m, characteristic_length_m=float(length))

    def fingers(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the contacts of each finger, in the order of the fingers' first appearance."""
        members: dict[tuple[bool, int], list[int]] = {}
        for index, contact in enumerate(self.contacts):
            key = (True, contact.finger) if contact.finger is not None else (False, index)
            members.setdefault(key, []).append(index)
        return tuple(tuple(indices) for indices in members.values())

    def arms_m(self) -> Matrix:
        """Positions of the contacts relative to the centre of mass, shape (contacts, 3)."""
        arms: Matrix = np.array([contact.position_m for contact in self.contacts]) - np.array(self.centre_of_mass_m)
        return arms
