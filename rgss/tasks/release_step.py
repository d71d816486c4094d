"""Release step: opens the hand and leaves the object at a place."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tasks.step_settings import StepControl


@dataclass(frozen=True, slots=True, kw_only=True)
class ReleaseStep:
    """Opening of the hand at a place.

    Attributes:
        name: Name of the phase.
        place: The place; empty for the object's own place region.
        opened_m: Greatest distance of any finger from open at which the hand counts as open; None for 0.5 mm.
        control: Joint control; None for that of the study.
    """

    name: str
    place: str = ""
    opened_m: float | None = None
    control: StepControl | None = None
