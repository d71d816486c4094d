"""Step in which the arm holds its configuration for a time."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import DocumentModel, Identifier, Seconds
from rgss.tasks.step_settings import StepControl, StepControlEntry


class WaitEntry(DocumentModel):
    """A rest of the arm."""

    duration: Seconds
    name: Identifier | None = None
    control: StepControlEntry | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class WaitStep:
    """A rest of the arm.

    Attributes:
        name: Name of the phase.
        duration_s: How long it rests.
        control: Control of the joints in it; None for that of the study.
    """

    name: str
    duration_s: float
    control: StepControl | None = None
