"""Step that ends the task unless a condition holds."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Nearness:
    """Greatest distance of the centre of an object from a point.

    Attributes:
        within_m: The distance.
        place: The place; the point is where the object's centre is when it stands in the middle. Empty for another.
        object: The object whose centre is the point; empty for another.
        point_m: The point in the world; None for another.
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
        at: Place region at which it must stand; empty for any.
        is_upright: Whether its tilt must be within that of its place region.
        is_at_rest: Whether it must be settled.
        held: Whether every finger (True) or none (False) must touch it; None for either.
        near: Where it must be; None for anywhere.
    """

    name: str
    object: str = ""
    at: str = ""
    is_upright: bool = False
    is_at_rest: bool = False
    held: bool | None = None
    near: Nearness | None = None
