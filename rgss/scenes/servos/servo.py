"""Servo of a joint: position and velocity gain, pure delay, viscous and Coulomb friction.

With T the delay, q and v the joint's position and speed, and q_c, v_c the commands,

    dv/dt = k_p (q_c(t - T) - q) + k_v (v_c(t - T) - v) - b v - c sgn(v).

The servo compensates weight and inertia by its own model, so gains and friction are those of a joint of unit inertia: a
friction torque is b or c times the inertia that the joint drives. Under velocity control k_p is zero.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

from rgss.errors import DefinitionError


class ServoControl(str, Enum):
    """Command interface of servos."""

    POSITION = "position"
    """Position commands with velocity feed-forward."""
    VELOCITY = "velocity"
    """Speeds."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JointServo:
    """Parameters of a joint's servo.

    Attributes:
        velocity_gain_hz: k_v in 1/s.
        position_gain_hz2: k_p in 1/s²; without effect under velocity control.
        delay_s: T.
        viscous_hz: b in 1/s: viscous friction per inertia.
        coulomb_rad_s2: c: Coulomb friction per inertia; of a prismatic joint per mass, in m/s².
    """

    velocity_gain_hz: float
    position_gain_hz2: float = 0.0
    delay_s: float = 0.0
    viscous_hz: float = 0.0
    coulomb_rad_s2: float = 0.0

    def __post_init__(self) -> None:
        """Require a positive velocity gain and no negative parameters.

        Raises:
            DefinitionError: A parameter is out of range.
        """
        if self.velocity_gain_hz <= 0.0:
            raise DefinitionError(f"the velocity gain must be positive, got {self.velocity_gain_hz:g} 1/s")
        for name in ("position_gain_hz2", "delay_s", "viscous_hz", "coulomb_rad_s2"):
            if getattr(self, name) < 0.0:
                raise DefinitionError(f"{name} must not be negative, got {getattr(self, name):g}")
