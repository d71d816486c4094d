"""Interface of the machine that runs the task program, at any fidelity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rgss.tasks import CheckStep
from rgss.trials.phase_result import PhaseResult
from rgss.trials.reference import Reference


class Plant(Protocol):
    """A machine with an arm and a hand, real or simulated at some fidelity."""

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Stand at rest at a configuration, the hand open."""

    def move(self, phase: str, reference: Reference) -> PhaseResult:
        """Follow a timed motion."""

    def grasp(self, phase: str) -> PhaseResult:
        """Close the hand on the object."""

    def place(self, phase: str) -> PhaseResult:
        """Open the hand and leave the object."""

    def wait(self, phase: str, duration_s: float) -> PhaseResult:
        """Hold the configuration for a time, with what is held."""

    def check(self, step: CheckStep) -> PhaseResult:
        """Check what must hold, as far as the plant knows of it."""
