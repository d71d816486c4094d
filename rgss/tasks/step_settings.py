"""Thresholds at which a step counts as complete, and the control of the joints in it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from rgss.documents import Dimensionless, DocumentModel, Metres, Radians, RadiansPerSecond


class ThresholdsEntry(DocumentModel):
    """Thresholds of the task's steps that state none of their own."""

    joints: Radians | None = None
    gripper: Metres | None = None


class StepControlEntry(DocumentModel):
    """Control of the joints in one step; what it does not state is that of the study."""

    mode: Literal["position", "velocity", "computed_torque", "tool_tracking"] | None = None
    natural_frequency: RadiansPerSecond | None = None
    damping_ratio: Dimensionless | None = None
    position_gain: RadiansPerSecond | None = None
    velocity_gain: RadiansPerSecond | None = None


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


def step_control(entry: StepControlEntry | None) -> StepControl | None:
    """The control of a step; None where it is that of the study.

    Args:
        entry: Its form in the file.
    """
    if entry is None:
        return None
    return StepControl(
        mode=entry.mode,
        natural_frequency_rad_s=entry.natural_frequency,
        damping_ratio=entry.damping_ratio,
        position_gain_1_s=entry.position_gain,
        velocity_gain_1_s=entry.velocity_gain,
    )
