"""Kinds of steps: the type of a step of a task, and of a machine that runs all of them."""

from __future__ import annotations

from typing import Protocol

from rgss.tasks.steps.base import Result_co
from rgss.tasks.steps.check import CheckingMachine, CheckStep
from rgss.tasks.steps.grip import GrippingMachine, GripStep
from rgss.tasks.steps.move import MoveStep, MovingMachine
from rgss.tasks.steps.neutral import NeutralMachine, NeutralStep
from rgss.tasks.steps.release import ReleaseStep, ReleasingMachine
from rgss.tasks.steps.wait import WaitingMachine, WaitStep

Step = MoveStep | GripStep | ReleaseStep | NeutralStep | WaitStep | CheckStep


class RestingMachine(
    GrippingMachine[Result_co],
    ReleasingMachine[Result_co],
    NeutralMachine[Result_co],
    WaitingMachine[Result_co],
    CheckingMachine[Result_co],
    Protocol[Result_co],
):
    """Machine that runs the steps in which the arm rests."""


class StepMachine(MovingMachine[Result_co], RestingMachine[Result_co], Protocol[Result_co]):
    """Machine that runs a step of any kind; mypy reports a machine without a method that one of the kinds needs."""
