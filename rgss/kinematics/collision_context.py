"""Carried object and obstacles of the arm during one move."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes import Pose


@dataclass(frozen=True, slots=True, kw_only=True)
class CollisionContext:
    """The state of gripper and workpiece while the arm moves.

    Attributes:
        opening_m: Distance of the finger pads from the gripper's axis.
        standing: Transform of the workpiece to the world while it stands in the scene; None when it does not.
        carried: Transform of the workpiece to the grasp-centre frame while it is held; None when it is not.
        largest_tilt_rad: Greatest angle between the carried workpiece's axis and the vertical; None for any.
        allowed: Pairs of names, in either order, that may touch.
    """

    opening_m: float
    standing: Pose | None = None
    carried: Pose | None = None
    largest_tilt_rad: float | None = None
    allowed: frozenset[tuple[str, str]] = frozenset()
