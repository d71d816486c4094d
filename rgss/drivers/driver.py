"""Interface of a driver: set points in, estimates out, at a fixed rate."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Protocol


class GripperState(str, Enum):
    """State of a gripper without position feedback."""

    OPEN = "open"
    CLOSED = "closed"
    NEUTRAL = "neutral"


@dataclass(frozen=True, slots=True, kw_only=True)
class SetPoint:
    """Desired state of the robot after one period.

    Attributes:
        positions_rad: Joint positions from base to flange.
        velocities_rad_s: Joint velocities.
        gripper: State of the gripper.
    """

    positions_rad: tuple[float, ...]
    velocities_rad_s: tuple[float, ...]
    gripper: GripperState


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """State of the robot as its controller reports it.

    Attributes:
        positions_rad: Joint positions from base to flange.
        velocities_rad_s: Joint velocities.
        gripper: Last state that the gripper was commanded to.
        stamp: Differs between two reports of the controller: its time, or a count of its replies.
        fault: Why the controller does not follow; empty if it does.
    """

    positions_rad: tuple[float, ...]
    velocities_rad_s: tuple[float, ...]
    gripper: GripperState
    stamp: float
    fault: str = ""


class Driver(Protocol):
    """A robot, simulated or real."""

    @property
    def name(self) -> str:
        """Its name on the command line."""

    @property
    def rate_hz(self) -> float:
        """Rate at which it takes set points."""

    def connect(self) -> None:
        """Open the connection and prepare the robot for set points, without motion.

        Raises:
            DriverError: The connection failed, or the robot is not ready.
        """

    def read(self) -> Estimate:
        """Latest report of the controller; the previous one with its time stamp if there is no new one.

        Raises:
            DriverError: The connection is closed.
        """

    def send(self, point: SetPoint) -> None:
        """Command one set point.

        Raises:
            DriverError: The controller refused it.
        """

    def stop(self) -> None:
        """Bring the robot to rest and end the mode that takes set points. The gripper keeps its state.

        Raises:
            DriverError: The controller refused it.
        """

    def disconnect(self) -> None:
        """Close the connection; allowed twice and before `connect`."""
