"""How finely the physics is stepped."""

from __future__ import annotations

from dataclasses import dataclass

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
        pad_retardation_s: Damping of the pad over its stiffness.
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
