"""Wait step: the arm holds its configuration for a time."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tasks.step_settings import StepControl


@dataclass(frozen=True, slots=True, kw_only=True)
class WaitStep:
    """A rest of the arm.

    Attributes:
        name: Name of the phase.
        duration_s: Duration of the rest.
        control: Joint control; None for that of the study.
    """

    name: str
    duration_s: float
    control: StepControl | None = None
