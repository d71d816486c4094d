"""Step that closes the hand on an object."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class GripStep:
    """Closing of the hand on an object.

    Attributes:
        name: Name of the phase.
        object: The object; empty for the workpiece of the scene.
    """

    name: str
    object: str = ""
