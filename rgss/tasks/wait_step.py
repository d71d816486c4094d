"""Step in which the arm holds its configuration for a time."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class WaitStep:
    """A rest of the arm.

    Attributes:
        name: Name of the phase.
        duration_s: How long it rests.
    """

    name: str
    duration_s: float
