"""Driven joint of an arm with its limits."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.scenes.joints.joint_kind import JointKind


@dataclass(frozen=True, slots=True, kw_only=True)
class Joint:
    """Joint of the arm with its limits.

    The units are those of a revolute joint; of a prismatic joint the range is in m, the speed in m/s, the acceleration
    in m/s² and the greatest effort a force in N. For lengths in joint space, a metre counts as a radian.

    Attributes:
        name: Its name in the robot description.
        lower_rad: Lower limit of the planning range.
        upper_rad: Upper limit of the planning range.
        speed_rad_s: Greatest speed.
        acceleration_rad_s2: Greatest acceleration used for timing.
        torque_n_m: Greatest torque.
        kind: Kind of the joint: revolute or prismatic.
    """

    name: str
    lower_rad: float
    upper_rad: float
    speed_rad_s: float
    acceleration_rad_s2: float
    torque_n_m: float
    kind: JointKind = JointKind.REVOLUTE
