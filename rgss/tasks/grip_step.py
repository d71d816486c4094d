"""Grip step: closes the hand on an object."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tasks.step_settings import StepControl


@dataclass(frozen=True, slots=True, kw_only=True)
class GripStep:
    """Closing of the hand on an object.

    Attributes:
        name: Name of the phase.
        object: The object; empty for the workpiece of the scene.
        firm_above_n: Normal force that every finger must exceed; None for the force that Coulomb friction requires.
        firm_s: Duration for which it must be exceeded; None for that of the study.
        control: Joint control; None for that of the study.
    """

    name: str
    object: str = ""
    firm_above_n: float | None = None
    firm_s: float | None = None
    control: StepControl | None = None
