"""Step that closes the hand on an object."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import DocumentModel, Identifier, Newtons, Seconds
from rgss.tasks.step_settings import StepControl, StepControlEntry


class GripEntry(DocumentModel):
    """Closing of the hand on an object."""

    name: Identifier | None = None
    object: Identifier | None = None
    firm_above: Newtons | None = None
    firm_for: Seconds | None = None
    control: StepControlEntry | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class GripStep:
    """Closing of the hand on an object.

    Attributes:
        name: Name of the phase.
        object: The object; empty for the workpiece of the scene.
        firm_above_n: Force above which every finger must press; None for the force that Coulomb friction needs.
        firm_s: Time for which they must; None for that of the study.
        control: Control of the joints in it; None for that of the study.
    """

    name: str
    object: str = ""
    firm_above_n: float | None = None
    firm_s: float | None = None
    control: StepControl | None = None
