"""Step that opens the hand and leaves the object at a place."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class ReleaseStep:
    """Opening of the hand at a place.

    Attributes:
        name: Name of the phase.
        place: The place; empty for the object's own place region.
    """

    name: str
    place: str = ""
