"""Settings of the physics: time step and solver."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

MOST_ITERATIONS = 2000
"""More are never taken for a light body; what would need them is refused."""

_MARGIN = 2.0

LEAST_RATE_HZ = 120.0
"""Rate from which a grasp was validated; below it fingers that hold are reported as not firm."""

LEAST_ITERATIONS_HZ = 2400.0
"""Rate times iterations from which a grasp was validated."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PhysicsSettings:
    """Resolution of the rigid-body simulation.

    A pad is a Kelvin-Voigt layer: it presses with its stiffness times its deflection, plus its damping times
    the rate of deflection. Between rigid bodies, how a finger's force is shared by the ends of its pad would be
    statically indeterminate, and the solver's choice has no limit as the step shrinks: with all of the force at
    one end, a held object swings about it.

    Attributes:
        rate_hz: Steps a second.
        solver_iterations: Iterations of the constraint solver in a step.
        free_iterations: The same, if they are fewer, while the hand is empty and moves: nothing has to be
            held, and the arm's motors alone converge sooner.
        pad_stiffness_n_m: Normal stiffness of one finger's pad. A layer of rubber of 2.5 MPa, 2 mm thick, that
            is touched over 80 mm by 1 mm has 100 kN/m: 10 N deflect it by 0.1 mm.
        pad_retardation_s: Damping of the pad over its stiffness. An implicit step damps by itself with a retardation of
            one step, so a step that is longer than the pad's retardation damps more than the pad.
    """

    rate_hz: float = 240.0
    solver_iterations: int = 50
    free_iterations: int = 20
    pad_stiffness_n_m: float = 1.0e5
    pad_retardation_s: float = 1.5e-3

    @property
    def step_s(self) -> float:
        """Length of one step."""
        return 1.0 / self.rate_hz

    @property
    def pad_damping_n_s_m(self) -> float:
        """Damping of one finger's pad that is left to the engine.

        The engine's spring presses with k x + (k dt + c) v of the step's end: the implicit step adds k dt to the
        damping c.
        """
        return self.pad_stiffness_n_m * max(0.0, self.pad_retardation_s - self.step_s)

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
