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
                f"there are {len(self.speed_rad_s)} joint speeds but {len(self.acceleration_rad_s2)} accelerations",
                hint="give one of each for every joint",
            )
        values = (*self.speed_rad_s, *self.acceleration_rad_s2, self.tool_speed_m_s, self.tool_acceleration_m_s2)
        if not all(value > 0.0 for value in values):
            raise MotionError(f"a motion cannot keep a limit of {min(values):g}", hint="let every limit be above zero")


def require_joints(limits: MotionLimits, joints: int) -> None:
    """Check that limits are for the joints of a path.

    Args:
        limits: The limits.
        joints: Number of joints of the path.

    Raises:
        MotionError: They are for another number of joints.
    """
    if len(limits.speed_rad_s) != joints:
        raise MotionError(
            f"the path has {joints} joints, but there are limits for {len(limits.speed_rad_s)}",
            hint="give limits for every joint",
        )
