"""Interface of the machine that runs the task program, at any fidelity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rgss.evidence import Phase
from rgss.trials.phase_result import PhaseResult
from rgss.trials.reference import Reference


class Plant(Protocol):
    """A machine with an arm and a hand, real or simulated at some fidelity."""

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Stand at rest at a configuration, the hand open."""

    def move(self, phase: Phase, reference: Reference) -> PhaseResult:
        """Follow a timed motion."""

    def grasp(self) -> PhaseResult:
        """Close the hand on the object."""

    def place(self) -> PhaseResult:
        """Open the hand and leave the object."""
