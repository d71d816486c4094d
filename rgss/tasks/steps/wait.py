"""Wait step: the arm holds its configuration for a time."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from rgss.tasks.steps.base import Result, Result_co, TaskStep
from rgss.tasks.steps.step_control import StepControl


class WaitingMachine(Protocol[Result_co]):
    """Machine that rests."""

    def wait(self, step: WaitStep) -> Result_co:
        """Rest as a step says."""


@dataclass(frozen=True, slots=True, kw_only=True)
class WaitStep(TaskStep):
    """A rest of the arm.

    Attributes:
        duration_s: Duration of the rest.
        control: Joint control; None for that of the study.
    """

    duration_s: float
    control: StepControl | None = None

    def run(self, machine: WaitingMachine[Result]) -> Result:
        """Run it on a machine."""
        return machine.wait(self)
