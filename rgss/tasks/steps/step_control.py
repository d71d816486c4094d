"""Joint control of a step."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class StepControl:
    """Joint control in one step; None for values of the study.

    Attributes:
        mode: Name of the control mode.
        natural_frequency_rad_s: Natural frequency of a joint's error.
        damping_ratio: Damping ratio of a joint's error.
        position_gain_1_s: Position gain: velocity command per position error.
        velocity_gain_1_s: Velocity gain: acceleration command per velocity error.
    """

    mode: str | None = None
    natural_frequency_rad_s: float | None = None
    damping_ratio: float | None = None
    position_gain_1_s: float | None = None
    velocity_gain_1_s: float | None = None
