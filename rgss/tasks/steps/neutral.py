"""Neutral step: the drive of the hand is switched off."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from rgss.tasks.steps.base import Result, Result_co, TaskStep
from rgss.tasks.steps.step_control import StepControl


class NeutralMachine(Protocol[Result_co]):
    """Machine that switches the drive of its hand off."""

    def neutral(self, step: NeutralStep) -> Result_co:
        """Switch the drive off as a step says."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NeutralStep(TaskStep):
    """The third state of an open-loop hand: neither opened nor closed by its drive.

    A held object stays held as far as the unpowered fingers resist; a release opens the hand afterwards.

    Attributes:
        control: Joint control; None for that of the study.
    """

    control: StepControl | None = None

    def run(self, machine: NeutralMachine[Result]) -> Result:
        """Run it on a machine."""
        return machine.neutral(self)
