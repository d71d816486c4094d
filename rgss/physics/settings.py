"""Settings of the physics: time step and solver."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

MOST_ITERATIONS = 2000
"""Upper bound of the iterations for a light body; a world that would need more is rejected."""

_MARGIN = 2.0

LEAST_RATE_HZ = 120.0
"""Least rate for which grasps were validated; below it holding fingers are reported as not firm."""

LEAST_ITERATIONS_HZ = 2400.0
"""Least product of rate and iterations for which grasps were validated."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PhysicsSettings:
    """Resolution of the rigid-body simulation.

    A pad is a Kelvin-Voigt layer: it presses with its stiffness times its deflection, plus its damping times the rate
    of deflection. Between rigid bodies the distribution of a finger's force over the ends of its pad would be
    statically indeterminate, and the solver's choice does not converge as the step shrinks: with all of the force at
    one end, a held object swings about it.

    Attributes:
        rate_hz: Steps a second.
        solver_iterations: Iterations of the constraint solver in a step.
        free_iterations: Iterations while the hand is empty and moves, if fewer. Those that a light body needs in the
        hand are not needed then, but those that the arm's motors need to follow their targets are.
        pad_stiffness_n_m: Normal stiffness of one finger's pad. A layer of rubber of 2.5 MPa, 2 mm thick, loaded over
        80 mm by 1 mm has 100 kN/m: 10 N deflect it by 0.1 mm.
        pad_retardation_s: Damping of the pad divided by its stiffness. The implicit integration has a numerical damping
        equal to a retardation of one step, so a step longer than the pad's retardation damps more than the pad.
    """

    rate_hz: float = 240.0
    solver_iterations: int = 50
    free_iterations: int = MOST_ITERATIONS
    pad_stiffness_n_m: float = 1.0e5
    pad_retardation_s: float = 1.5e-3

    @property
    def step_s(self) -> float:
        """Length of one step in s."""
        return 1.0 / self.rate_hz

    @property
    def pad_damping_n_s_m(self) -> float:
        """Damping coefficient of one finger's pad for the engine.

        The engine's contact force at the end of the step is k x + (k dt + c) v: the implicit integration adds k dt to
        the damping c.
        """
        return self.pad_stiffness_n_m * max(0.0, self.pad_retardation_s - self.step_s)

    def lightest_body_kg(self, *, force_n: float, speed_m_s: float, iterations: int | None = None) -> float:
        """Least mass in kg of a body, finger or object, through which the solver transmits the whole force of a finger.

        In each iteration the motor of a finger adds at most the momentum M v_f to the finger, which the contact removes
        again; so the contact force is at most iterations times M v_f / dt, and a lighter object creeps out of the hand.
        Measured without margin on fingers; an object between three fingers needs twice that.

        Args:
            force_n: Force of a finger.
            speed_m_s: Speed of its motor.
            iterations: Iterations of the solver; those of the settings by default.
        """
        count = self.solver_iterations if iterations is None else iterations
        return _MARGIN * force_n / (count * speed_m_s * self.rate_hz)

    def passing(self, *, force_n: float, speed_m_s: float, lightest_kg: float) -> PhysicsSettings:
        """Copy with enough iterations to transmit a finger's force through the lightest body.

        Args:
            force_n: Force of a finger.
            speed_m_s: Speed of its motor.
            lightest_kg: Mass of the lightest body between the fingers' motors, finger or object.
        """
        if not lightest_kg > 0.0:  # which the world rejects
            return self
        share = self.lightest_body_kg(force_n=force_n, speed_m_s=speed_m_s) / lightest_kg
        # Within rounding a mass may equal the least one.
        if share <= 1.0 + 1e-9:
            return self
        return replace(
            self,
            solver_iterations=min(MOST_ITERATIONS, math.ceil(self.solver_iterations * share)),
            free_iterations=min(self.free_iterations, self.solver_iterations),
        )

    def with_iterations(self, iterations: int) -> PhysicsSettings:
        """Copy with another number of iterations, with and without an object in the hand.

        Args:
            iterations: Iterations of the constraint solver in a step.
        """
        return replace(self, solver_iterations=iterations, free_iterations=iterations)
