"""Grip step: closes the hand on an object."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

from rgss.tasks.steps.base import HandAction, Mention, Named, Result, Result_co, TaskStep
from rgss.tasks.steps.step_control import StepControl


class GrippingMachine(Protocol[Result_co]):
    """Machine that closes its hand."""

    def grip(self, step: GripStep) -> Result_co:
        """Close the hand as a step says."""


@dataclass(frozen=True, slots=True, kw_only=True)
class GripStep(TaskStep):
    """Closing of the hand on an object.

    Attributes:
        object: The object; empty for the workpiece of the scene.
        firm_above_n: Normal force that every finger must exceed; None for the force that Coulomb friction requires.
        firm_s: Duration for which it must be exceeded; None for that of the study.
        control: Joint control; None for that of the study.
    """

    hand: ClassVar[HandAction] = HandAction.CLOSES

    object: str = ""
    firm_above_n: float | None = None
    firm_s: float | None = None
    control: StepControl | None = None

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """The object."""
        return (Mention(kind=Named.OBJECT, name=self.object),)

    def run(self, machine: GrippingMachine[Result]) -> Result:
        """Run it on a machine."""
        return machine.grip(self)
