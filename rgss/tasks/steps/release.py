"""Release step: opens the hand and leaves the object at a place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Protocol

from rgss.tasks.steps.base import HandAction, Mention, Named, Result, Result_co, TaskStep
from rgss.tasks.steps.step_control import StepControl


class ReleasingMachine(Protocol[Result_co]):
    """Machine that opens its hand."""

    def release(self, step: ReleaseStep) -> Result_co:
        """Open the hand as a step says."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReleaseStep(TaskStep):
    """Opening of the hand at a place.

    Attributes:
        place: The place; empty for the object's own place region.
        opened_m: Greatest distance of any finger from open at which the hand counts as open; None for 0.5 mm.
        control: Joint control; None for that of the study.
    """

    hand: ClassVar[HandAction] = HandAction.OPENS

    place: str = ""
    opened_m: float | None = None
    control: StepControl | None = None

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """The place."""
        return (Mention(kind=Named.PLACE, name=self.place, key=("place",)),)

    def run(self, machine: ReleasingMachine[Result]) -> Result:
        """Run it on a machine."""
        return machine.release(self)
