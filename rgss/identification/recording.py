"""A recording: commanded and measured motion of each joint, divided by pose, excited joint and signal."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import ServoControl

Array = NDArray[np.float64]


class CommandedPositions(str, Enum):
    """Course of commanded positions between two samples; commanded speeds act until the next sample in either case."""

    HELD = "held"
    INTERPOLATED = "interpolated"


@dataclass(frozen=True, slots=True, kw_only=True)
class JointSeries:
    """Commanded and measured motion of one joint, each array of shape (times,); in m where it slides."""

    commanded_rad: Array
    commanded_rad_s: Array
    measured_rad: Array
    measured_rad_s: Array


@dataclass(frozen=True, slots=True, kw_only=True)
class Segment:
    """Response to one signal of one joint at one pose.

    Attributes:
        pose: Name of the pose.
        joint: The excited joint.
        signal: Name of the signal, such as ``step 0.5 rad/s``.
        times_s: Times, rising, shape (times,).
        series: The motion of each joint by name.
    """

    pose: str
    joint: str
    signal: str
    times_s: Array
    series: Mapping[str, JointSeries]

    @property
    def excited(self) -> JointSeries:
        """The motion of the excited joint."""
        return self.series[self.joint]


@dataclass(frozen=True, slots=True, kw_only=True)
class Recording:
    """A recording.

    Attributes:
        robot: Name of the robot.
        recorded: Date or circumstances, as stated in its file.
        control: The command interface.
        joints: Names of the joints.
        segments: The segments in the order of time.
        digest: SHA-256 of its file; empty if it was not read from one.
        slides: The prismatic joints, whose positions are in m.
        commands: Course of the commanded positions between samples.
    """

    robot: str
    recorded: str
    control: ServoControl
    joints: tuple[str, ...]
    segments: tuple[Segment, ...]
    digest: str = ""
    slides: frozenset[str] = frozenset()
    commands: CommandedPositions = CommandedPositions.HELD

    def unit_of(self, joint: str) -> str:
        """Unit of the positions of a joint."""
        return "m" if joint in self.slides else "rad"

    def of_joint(self, joint: str) -> tuple[Segment, ...]:
        """The segments in which a joint is excited."""
        return tuple(segment for segment in self.segments if segment.joint == joint)
