"""Manipulator: URDF, and the limits for planner and controller."""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import Enum
from pathlib import Path

from rgss.scenes.pose import Pose
from rgss.scenes.servos import Calibration

MOST_JOINTS = 8
"""Greatest number of joints of an arm."""


class JointKind(str, Enum):
    """Motion of a joint."""

    REVOLUTE = "revolute"
    PRISMATIC = "prismatic"


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


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotFile:
    """File referenced by the robot's URDF, such as a mesh.

    Attributes:
        name: Its name as the URDF has it.
        sha256: SHA-256 of its content.
    """

    name: str
    sha256: str


@dataclass(frozen=True, slots=True, kw_only=True)
class LinkLook:
    """Visual mesh of a link.

    Attributes:
        link: The link.
        mesh: The mesh's file.
        pose: Transform of the mesh's frame to the link.
        scale: Factors along the axes of the mesh.
        colour: Red, green, blue and opacity of its material; None if the URDF states none.
    """

    link: str
    mesh: Path
    pose: Pose
    scale: tuple[float, float, float]
    colour: tuple[float, float, float, float] | None


@dataclass(frozen=True, slots=True, kw_only=True)
class Robot:
    """A serial arm.

    Attributes:
        id: Its name.
        urdf: Text of its URDF, from the base to the flange, in the form passed to engines: every joint is one of
        `joints` or fixed, and every collision shape primitive or convex.
        flange: Name of the link with the gripper; z points out of the flange.
        joints: The joints from base to flange.
        base: Transform of the arm's base frame to the world.
        payload_kg: Rated payload.
        tool_acceleration_m_s2: Greatest acceleration of the tool centre.
        home_rad: Reference configuration of the choice among inverse kinematics branches.
        files: The meshes and textures referenced by the URDF, with digests of their content.
        tool_speed_m_s: Greatest speed of the tool centre if no design sets it; None if the file has none.
        calibration: The fitted servos of its joints; None if the file names none.
        looks: The visual meshes of its links, for pictures; no content of a trial.
    """

    id: str
    urdf: str
    flange: str
    joints: tuple[Joint, ...]
    base: Pose
    payload_kg: float
    tool_acceleration_m_s2: float
    home_rad: tuple[float, ...]
    files: tuple[RobotFile, ...] = ()
    tool_speed_m_s: float | None = None
    calibration: Calibration | None = None
    looks: tuple[LinkLook, ...] = field(default=(), compare=False, repr=False)
