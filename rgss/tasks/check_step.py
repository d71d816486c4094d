"""Step that ends the task unless a condition holds."""

from __future__ import annotations

from dataclasses import dataclass


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
    """

    name: str
    object: str = ""
    at: str = ""
    is_upright: bool = False
    is_at_rest: bool = False
    held: bool | None = None
