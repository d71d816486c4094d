"""A robot that speaks a driver's interface, on a clock that tests hold."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
import pytest

from rgss.drivers import Estimate, GripperState, Guard, RobotLimits, Segment, SetPoint, TimedTask
from rgss.errors import DriverError


@dataclass
class Cosine:
    """A motion from rest to rest: start + travel (1 - cos(pi t / T)) / 2 in each joint."""

    start: tuple[float, ...]
    travel: tuple[float, ...]
    duration_s: float

    def positions(self, times):
        share = (1 - np.cos(math.pi * np.clip(np.asarray(times), 0, self.duration_s) / self.duration_s)) / 2
        return np.array(self.start) + share[:, None] * np.array(self.travel)


class StraightTool:
    """A tool on a 2 m lever of the first joint's angle."""

    def tool_position(self, configurations_rad):
        first = np.asarray(configurations_rad)[:, :1]
        return np.hstack([2 * first, 0 * first, 0 * first])


@dataclass
class Robot:
    """A driver and its clock; it reaches every set point in one period unless a test says otherwise."""

    positions: tuple[float, ...]
    rate_hz: float = 100.0
    name: str = "double"
    calls: list[str] = field(default_factory=list)
    sent: list[SetPoint] = field(default_factory=list)
    silent_after: int = 10**9
    stuck_after: int = 10**9
    refuses_after: int = 10**9
    fault_after: int = 10**9
    pause_after: int = 10**9
    stop_fails: bool = False
    time_s: float = 100.0
    stamp: float = 0.0

    def connect(self):
        self.calls.append("connect")

    def read(self):
        if len(self.sent) < self.silent_after:
            self.stamp += 1
        still = (0.0,) * len(self.positions)
        fault = "the robot is protective stopped" if len(self.sent) >= self.fault_after else ""
        return Estimate(
            positions_rad=self.positions,
            velocities_rad_s=still,
            gripper=GripperState.OPEN,
            stamp=self.stamp,
            fault=fault,
        )

    def send(self, point):
        if len(self.sent) >= self.refuses_after:
            raise DriverError("the controller refused servo with code 9")
        self.sent.append(point)
        if len(self.sent) <= self.stuck_after:
            self.positions = point.positions_rad

    def stop(self):
        self.calls.append("stop")
        if self.stop_fails:
            raise DriverError("no answer")

    def disconnect(self):
        self.calls.append("disconnect")

    def now_s(self):
        return self.time_s

    def wait_until(self, time_s):
        self.time_s = max(self.time_s, time_s) + (1.0 if len(self.sent) == self.pause_after else 0.0)


def limits(joints=3, **changed):
    """Limits of any number of joints."""
    values = {
        "names": tuple(f"j{n}" for n in range(joints)),
        "lower_rad": (-1.0,) * joints,
        "upper_rad": (1.0,) * joints,
        "speed_rad_s": (1.0,) * joints,
        "acceleration_rad_s2": (4.0,) * joints,
        "tool_speed_m_s": 10.0,
    }
    return RobotLimits(**{**values, **changed})


def pick_task(joints=3, travel=0.5, duration_s=1.0):
    """There, close, and back."""
    start, away = (0.0,) * joints, (travel,) * joints
    back = tuple(-value for value in away)
    return TimedTask(
        segments=(
            Segment(name="go", gripper=GripperState.OPEN, motion=Cosine(start, away, duration_s)),
            Segment(name="close", gripper=GripperState.CLOSED, wait_s=0.3),
            Segment(name="back", gripper=GripperState.CLOSED, motion=Cosine(away, back, duration_s)),
        )
    )


def guard(given=None, rate_hz=100.0):
    """A fresh guard."""
    return Guard(given or limits(), StraightTool(), period_s=1 / rate_hz)


@pytest.fixture
def robot():
    """A robot of three joints at the start of the task."""
    return Robot((0.0, 0.0, 0.0))
