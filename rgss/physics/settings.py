"""How finely the physics is stepped."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

MOST_ITERATIONS = 2000
"""More are never taken for a light body; what would need them is refused."""

_MARGIN = 2.0


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

    def lightest_body_kg(self, *, force_n: float, speed_m_s: float, iterations: int | None = None) -> float:
        """Mass of a body, finger or object, through which the solver passes the whole force of a finger.

        In each of its iterations the motor of a finger gives the finger at most its momentum M v_f, which
        the contact takes away again; so no more than iterations times M v_f / dt is ever pressed, and a
        lighter object creeps out of the hand. Measured without margin on fingers; an object between three
        fingers needs twice that.

        Args:
            force_n: Force of a finger.
            speed_m_s: Speed at which its motor drives it.
            iterations: Iterations of the solver; those of the settings if not given.
        """
        count = self.solver_iterations if iterations is None else iterations
        return _MARGIN * force_n / (count * speed_m_s * self.rate_hz)

    def passing(self, *, force_n: float, speed_m_s: float, lightest_kg: float) -> PhysicsSettings:
        """The same with as many iterations as pass a finger's force through the lightest body.

        Args:
            force_n: Force of a finger.
            speed_m_s: Speed at which its motor drives it.
            lightest_kg: Mass of the lightest body between the fingers' motors, finger or object.
        """
        if not lightest_kg > 0.0:  # which the world refuses
            return self
        share = self.lightest_body_kg(force_n=force_n, speed_m_s=speed_m_s) / lightest_kg
        # In the last digit a mass may be the lightest that passes.
        if share <= 1.0 + 1e-9:
            return self
        return replace(self, solver_iterations=min(MOST_ITERATIONS, math.ceil(self.solver_iterations * share)))
