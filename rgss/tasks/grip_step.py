"""Step that closes the hand on an object."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.tasks.step_settings import StepControl


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
