"""Interface of the plant of the task program, at any fidelity."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rgss.tasks import MoveStep, RestingMachine
from rgss.trials.phase_result import PhaseResult
from rgss.trials.reference import Reference


class Plant(RestingMachine[PhaseResult], Protocol):
    """Plant with an arm and a hand, real or simulated at any fidelity; checks as far as it models the conditions."""

    def start(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration, with the hand open."""

    def move(self, step: MoveStep, reference: Reference) -> PhaseResult:
        """Follow a timed motion."""
