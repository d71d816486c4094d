"""Contacts of one physics step, grouped by the bodies in contact."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, NamedTuple


class Contacts(NamedTuple):
    """Contacts of one step; a named tuple, created in a third of the time of a dataclass, since each step creates one.

    Attributes:
        finger_forces_n: Normal force of each finger on the workpiece.
        other_force_n: Normal force of every other link of the robot on the workpiece.
        pressed: Contact points between fingers and workpiece as reported by the engine, each with the sign of its
        friction on the workpiece.
        robot_bodies: Pairs (link, body) of the robot touching the scene.
        workpiece_bodies: Scene bodies that the workpiece touches.
        pressing_links: Names of those other links, in the order of the engine.
        struck: All contact points of the robot but those between fingers and workpiece, each with the link, the body
        (None for the workpiece), the sign of its normal on the robot, and the point as reported by the engine.
    """

    finger_forces_n: tuple[float, ...]
    other_force_n: float
    pressed: tuple[tuple[float, Any], ...]
    robot_bodies: tuple[tuple[str, str], ...]
    workpiece_bodies: tuple[str, ...]
    pressing_links: tuple[str, ...]
    struck: tuple[tuple[str, str | None, float, Any], ...] = ()

    @property
    def robot_contacts(self) -> tuple[RobotContact, ...]:
        """Contacts of the robot's parts with the scene, and of what is no finger with the workpiece."""
        found = []
        for link, body, sign, point in self.struck:
            # Position on body B, normal from B to A, and the force along it.
            x, y, z = point[7]
            share = sign * point[9]
            found.append(RobotContact(link, body, point[6], (share * x, share * y, share * z)))
        return tuple(found)

    @property
    def finger_force_sum_n(self) -> float:
        """Sum of the fingers' normal forces in N."""
        return math.fsum(self.finger_forces_n)

    @property
    def friction_n(self) -> tuple[float, float, float]:
        """Vector sum of the fingers' friction forces on the workpiece, in the world."""
        x = y = z = 0.0
        for sign, point in self.pressed:
            # Force (N) and direction along the first tangent of the contact, then along the second.
            first, (ax, ay, az), second, (bx, by, bz) = point[10:14]
            x += sign * (first * ax + second * bx)
            y += sign * (first * ay + second * by)
            z += sign * (first * az + second * bz)
        return x, y, z

    @property
    def is_robot_touching(self) -> bool:
        """True if any link of the robot touches anything."""
        return bool(self.robot_bodies) or self.other_force_n > 0.0 or any(self.finger_forces_n)

    @property
    def fingers_touching(self) -> int:
        """Number of fingers in contact with the workpiece."""
        return sum(force > 0.0 for force in self.finger_forces_n)


@dataclass(frozen=True, slots=True)
class RobotContact:
    """Contact point of a part of the robot that is not meant to touch.

    Attributes:
        link: The link, or the finger.
        body: The body of the scene, or another object; None for the workpiece.
        position_m: The point in the world, at the start of the step.
        force_n: Normal force on the link, in the world.
    """

    link: str
    body: str | None
    position_m: tuple[float, float, float]
    force_n: tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class FingerContact:
    """Contact point of a finger on the workpiece, in the frame of the workpiece.

    The engine detects contacts at the start of a step and then moves the bodies, so that positions in the world are
    outdated after the step; in the frame of the workpiece at the start of the step they are consistent.

    Attributes:
        finger: Index of the finger.
        position_m: The point on the workpiece.
        normal: Unit normal into the workpiece, from the engine: while a contact lasts it keeps its direction in the
        world, also when the workpiece rotates.
        gap_m: Distance of the surfaces along the normal, negative where they penetrate.
        normal_force_n: Force along the normal.
        friction_n: Friction force on the workpiece.
    """

    finger: int
    position_m: tuple[float, float, float]
    normal: tuple[float, float, float]
    gap_m: float
    normal_force_n: float
    friction_n: tuple[float, float, float]
