"""Settings of the timing of moves: velocity profile and shares of the joint limits."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from rgss.motion import MotionLimits
from rgss.scenes import Joint


class TimingProfile(str, Enum):
    """Velocity profile of a move."""

    TIME_OPTIMAL = "time_optimal"
    TRAPEZOID = "trapezoid"
    JOINT_WAYPOINTS = "joint_waypoints"


@dataclass(frozen=True, slots=True, kw_only=True)
class TimingSettings:
    """Settings of the timing of moves.

    Attributes:
        profile: The velocity profile.
        peak_speed: Share of each joint's speed limit.
        peak_acceleration: Share of each joint's acceleration limit.
        joint_speeds_rad_s: Reduced speed limits of some joints by name.
        joint_accelerations_rad_s2: Reduced acceleration limits of some joints by name.
    """

    profile: TimingProfile = TimingProfile.TIME_OPTIMAL
    peak_speed: float = 1.0
    peak_acceleration: float = 1.0
    joint_speeds_rad_s: tuple[tuple[str, float], ...] = ()
    joint_accelerations_rad_s2: tuple[tuple[str, float], ...] = ()

    def limits(self, joints: Sequence[Joint], *, tool_speed_m_s: float, tool_acceleration_m_s2: float) -> MotionLimits:
        """Limits of a motion.

        Args:
            joints: The arm's joints with their limits.
            tool_speed_m_s: Greatest speed of the tool centre.
            tool_acceleration_m_s2: Greatest acceleration of the tool centre.
        """
        speeds, accelerations = dict(self.joint_speeds_rad_s), dict(self.joint_accelerations_rad_s2)
        return MotionLimits(
            speed_rad_s=tuple(
                self.peak_speed * min(one.speed_rad_s, speeds.get(one.name, one.speed_rad_s)) for one in joints
            ),
            acceleration_rad_s2=tuple(
                self.peak_acceleration
                * min(one.acceleration_rad_s2, accelerations.get(one.name, one.acceleration_rad_s2))
                for one in joints
            ),
            tool_speed_m_s=tool_speed_m_s,
            tool_acceleration_m_s2=tool_acceleration_m_s2,
        )
