"""Limits of a timed motion."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rgss.errors import MotionError


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionLimits:
    """Limits of a motion.

    Attributes:
        speed_rad_s: Greatest speed of each joint.
        acceleration_rad_s2: Greatest acceleration of each joint.
        tool_speed_m_s: Greatest speed of the tool centre.
        tool_acceleration_m_s2: Greatest acceleration of the tool centre; unlimited by default.

    Raises:
        MotionError: A limit is not positive, or the numbers of joints differ.
    """

    speed_rad_s: tuple[float, ...]
    acceleration_rad_s2: tuple[float, ...]
    tool_speed_m_s: float
    tool_acceleration_m_s2: float = math.inf

    def __post_init__(self) -> None:
        if len(self.speed_rad_s) != len(self.acceleration_rad_s2):
            raise MotionError(
                f"joint speed and acceleration limits must be equally many, got {len(self.speed_rad_s)} "
                f"and {len(self.acceleration_rad_s2)}",
                hint="give one of each for every joint",
            )
        values = (*self.speed_rad_s, *self.acceleration_rad_s2, self.tool_speed_m_s, self.tool_acceleration_m_s2)
        if not all(value > 0.0 for value in values):
            raise MotionError(
                f"motion limits must be positive, got {min(values):g}", hint="give every limit a value above zero"
            )


def require_joints(limits: MotionLimits, joints: int) -> None:
    """Require one limit for each joint of a path.

    Raises:
        MotionError: The numbers of joints differ.
    """
    if len(limits.speed_rad_s) != joints:
        raise MotionError(
            f"the limits must be for {joints} joints, those of the path, got limits for {len(limits.speed_rad_s)}",
            hint="give limits for every joint",
        )
