"""Check step: ends the task unless its conditions hold."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Nearness:
    """Condition on the distance of the centre of an object from a reference point, given in one of three ways.

    Attributes:
        within_m: Greatest distance.
        place: Place; the point is the centre of the object placed in its middle. Empty if not used.
        object: Object whose centre is the point; empty if not used.
        point_m: Point in the world; None if not used.
    """

    within_m: float
    place: str = ""
    object: str = ""
    point_m: tuple[float, float, float] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class CheckStep:
    """Conditions, all of which must hold.

    Attributes:
        name: Name of the phase.
        object: The object; empty for the workpiece of the scene.
        at: Place region in which it must be placed; empty for no condition.
        is_upright: True if its tilt must be within that of its place region.
        is_at_rest: True if it must be settled.
        held: True if every finger must touch it, False if none may; None for no condition.
        near: Condition on its position; None for no condition.
    """

    name: str
    object: str = ""
    at: str = ""
    is_upright: bool = False
    is_at_rest: bool = False
    held: bool | None = None
    near: Nearness | None = None
