"""Manipulator: URDF, and the limits for planner and controller."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from rgss.scenes.frames import NamedFrame
from rgss.scenes.joints import Follower, Joint, JointKind
from rgss.scenes.pose import Pose
from rgss.scenes.servos import Calibration

MOST_JOINTS = 8
"""Greatest number of joints of an arm."""


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
        `joints`, one of `followers` or fixed, and every collision shape primitive or convex.
        flange: Name of the link with the gripper; z points out of the flange.
        joints: The driven joints from base to flange: the degrees of freedom.
        base: Transform of the arm's base frame to the world.
        payload_kg: Rated payload.
        tool_acceleration_m_s2: Greatest acceleration of the tool centre.
        home_rad: Reference configuration of the choice among inverse kinematics branches.
        files: The meshes and textures referenced by the URDF, with digests of their content.
        tool_speed_m_s: Greatest speed of the tool centre if no design sets it; None if the file has none.
        calibration: The fitted servos of its joints; None if the file names none.
        looks: The visual meshes of its links, for pictures; no content of a trial.
        followers: The mimic joints from base to flange.
        frames: The named frames of its file, in its base.
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
    followers: tuple[Follower, ...] = ()
    frames: tuple[NamedFrame, ...] = ()

    @property
    def whole_turns_are_equal(self) -> tuple[bool, ...]:
        """For each joint, whether a whole turn of it leaves every link where it is.

        Not so for a prismatic joint, nor for a revolute one with a follower that slides, or turns by a fraction of it.
        """
        partial = {
            one.driver for one in self.followers if one.kind is JointKind.PRISMATIC or not one.multiplier.is_integer()
        }
        return tuple(
            joint.kind is JointKind.REVOLUTE and index not in partial for index, joint in enumerate(self.joints)
        )

    def follower_positions(self, driven: Sequence[float]) -> tuple[float, ...]:
        """Positions of the followers in rad or m.

        Args:
            driven: Positions of the driven joints, shape (n,).
        """
        return tuple(one.position(driven) for one in self.followers)
