"""Thresholds at which a step counts as complete, and the control of the joints in it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class StepControl:
    """Control of the joints in one step; None where it is that of the study.

    Attributes:
        mode: Name of the control mode.
        natural_frequency_rad_s: Natural frequency of a joint's error.
        damping_ratio: Damping ratio of a joint's error.
        position_gain_1_s: Velocity for each unit of a joint's position error.
        velocity_gain_1_s: Acceleration for each unit of a joint's velocity error.
    """

    mode: str | None = None
    natural_frequency_rad_s: float | None = None
    damping_ratio: float | None = None
    position_gain_1_s: float | None = None
    velocity_gain_1_s: float | None = None
