"""Impact of a closing finger on the object: theoretical force, and resolution by the time step.

By the momentum of the finger its force, averaged over the object's force window T, exceeds that of its motor by at most
2 M v / T; by the energy of the pad of stiffness k it is at most F + sqrt(F² + k M v²). The impact lasts half a period
of the finger on its pad, pi sqrt(M / k).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from rgss.trials.trial_spec import TrialSpec

LEAST_STEPS = 10.0
"""Steps, in the impact or in the force window if longer, for an error of the sensed force within 10 %."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ClosingImpact:
    """Impact of a finger that closes on the object.

    Attributes:
        duration_s: Its duration.
        least_n: Holding force of a finger without impact.
        greatest_n: Greatest theoretical force of the impact, averaged over the force window.
        limit_n: Force limit of the object.
        rate_hz: Physics steps a second.
        least_rate_hz: Least rate that resolves the impact.
    """

    duration_s: float
    least_n: float
    greatest_n: float
    limit_n: float
    rate_hz: float
    least_rate_hz: float

    @property
    def is_resolved(self) -> bool:
        """True if the time step resolves the impact, or damage does not depend on it."""
        depends_on_impact = self.least_n < self.limit_n < self.greatest_n
        return not depends_on_impact or self.rate_hz >= self.least_rate_hz * (1 - 1e-9)


def closing_impact(spec: TrialSpec) -> ClosingImpact:
    """Impact of the fingers of a trial."""
    gripper, workpiece, physics = spec.gripper, spec.scene.workpiece, spec.settings.physics
    force_n, mass_kg, speed_m_s = gripper.finger_force_n, gripper.driven_mass_kg, gripper.finger_velocity_m_s
    stiffness_n_m, window_s = physics.pad_stiffness_n_m, workpiece.force_window_s
    duration_s = math.pi * math.sqrt(mass_kg / stiffness_n_m)
    by_momentum_n = force_n + 2.0 * mass_kg * speed_m_s / window_s
    by_energy_n = force_n + math.sqrt(force_n**2 + stiffness_n_m * mass_kg * speed_m_s**2)
    return ClosingImpact(
        duration_s=duration_s,
        least_n=spec.settings.control.holding_share * force_n,
        greatest_n=min(by_momentum_n, by_energy_n),
        limit_n=workpiece.force_limit_n,
        rate_hz=physics.rate_hz,
        least_rate_hz=LEAST_STEPS / max(duration_s, window_s),
    )
