"""Collision context of one move: gripper opening, carried object and allowed contacts."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes import Pose


@dataclass(frozen=True, slots=True, kw_only=True)
class CollisionContext:
    """State of gripper and workpiece during a move of the arm.

    Attributes:
        opening_m: Distance of the finger pads from the gripper's axis in m.
        standing: Transform of the workpiece to the world while it is placed in the scene; None otherwise.
        carried: Transform of the workpiece to the grasp-centre frame while it is held; None otherwise.
        largest_tilt_rad: Greatest angle between the carried workpiece's axis and the vertical; None for any.
        allowed: Pairs of names, in either order, that may touch.
    """

    opening_m: float
    standing: Pose | None = None
    carried: Pose | None = None
    largest_tilt_rad: float | None = None
    allowed: frozenset[tuple[str, str]] = frozenset()
