"""Interface of the plant of the task program, at any fidelity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rgss.tasks import CheckStep
from rgss.trials.phase_result import PhaseResult
from rgss.trials.reference import Reference


class Plant(Protocol):
    """Plant with an arm and a hand, real or simulated at any fidelity."""

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration, with the hand open."""

    def move(self, phase: str, reference: Reference) -> PhaseResult:
        """Follow a timed motion."""

    def grasp(self, phase: str) -> PhaseResult:
        """Close the hand on the object."""

    def place(self, phase: str) -> PhaseResult:
        """Open the hand and leave the object."""

    def wait(self, phase: str, duration_s: float) -> PhaseResult:
        """Hold the configuration for a time, with the held object."""

    def check(self, step: CheckStep) -> PhaseResult:
        """Evaluate the conditions of a check step, as far as the plant models them."""
