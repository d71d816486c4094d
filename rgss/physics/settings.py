"""How finely the physics is stepped."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class PhysicsSettings:
    """Resolution of the rigid-body simulation.

    Attributes:
        rate_hz: Steps a second.
        solver_iterations: Iterations of the constraint solver in a step.
        free_iterations: The same, if they are fewer, while the hand is empty and moves: nothing has to be
            held, and the arm's motors alone converge sooner.
    """

    rate_hz: float = 240.0
    solver_iterations: int = 50
    free_iterations: int = 20

    @property
    def step_s(self) -> float:
        """Length of one step."""
        return 1.0 / self.rate_hz
