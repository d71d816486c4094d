"""Problems in a joint space whose obstacles are known exactly, and the arm's own tool kinematics."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from rgss.kinematics import Arm
from rgss.motion import MotionLimits, PlanningClock, PlanningProblem
from rgss.scenes import Joint, Pose, Robot

URDF = Path(__file__).parents[2] / "scenes" / "robots" / "ur10.urdf"
SPEEDS = (2.094, 2.094, 3.142, 3.142, 3.142, 3.142)
ACCELERATIONS = (3.0, 3.0, 4.0, 6.0, 6.0, 6.0)
PLANNING_LIMIT = 2.0


class Wall:
    """A wall across the first joint at zero with a doorway in the second and third."""

    def __init__(self):
        self.calls = 0

    def is_valid(self, q):
        self.calls += 1
        assert len(q) == 6
        in_doorway = q[1] > 0.5 and q[2] > -2.0
        return abs(q[0]) > 0.15 or in_doorway


class Open:
    """Everything is valid."""

    def is_valid(self, q):
        return True


class Corner:
    """A thin bar near the corner of an L-shaped path: a rounded corner runs into it, the sharp one does not."""

    def __init__(self, gap=0.02):
        self.gap = gap

    def is_valid(self, q):
        # The path runs along +q0 to (1, 0), then along +q1; the inside of its corner lies towards (1 - s, s).
        inside = 1.0 - q[0], q[1]
        return not (inside[0] > self.gap and inside[1] > self.gap)


@pytest.fixture
def wall():
    return Wall()


@pytest.fixture
def anything():
    return Open()


@pytest.fixture
def corner():
    return Corner


@pytest.fixture(scope="session")
def through_the_doorway():
    return PlanningProblem(
        lower_rad=(-PLANNING_LIMIT,) * 6,
        upper_rad=(PLANNING_LIMIT,) * 6,
        start=(-1.0, 0.0, 0.0, 0.0, 0.0, 0.0),
        goal=(1.0, 0.0, 0.5, 0.0, 0.0, 0.0),
        resolution_rad=0.05,
    )


@pytest.fixture(scope="session")
def clock():
    return PlanningClock(charge_s=0.001)


@pytest.fixture(scope="session")
def arm():
    joints = tuple(
        Joint(
            name=name,
            lower_rad=-2 * math.pi,
            upper_rad=2 * math.pi,
            speed_rad_s=speed,
            acceleration_rad_s2=acceleration,
            torque_n_m=100.0,
        )
        for name, speed, acceleration in zip(
            [
                "shoulder_pan_joint",
                "shoulder_lift_joint",
                "elbow_joint",
                "wrist_1_joint",
                "wrist_2_joint",
                "wrist_3_joint",
            ],
            SPEEDS,
            ACCELERATIONS,
            strict=True,
        )
    )
    robot = Robot(
        id="ur10",
        urdf=URDF.read_text(encoding="utf-8"),
        flange="flange",
        joints=joints,
        base=Pose(),
        payload_kg=10.0,
        tool_acceleration_m_s2=4.0,
        home_rad=(0.0,) * 6,
    )
    return Arm(robot, Pose(position_m=(0.0, 0.0, 0.145)))


@pytest.fixture
def limits():
    """Makes limits, the tool's at will."""

    def make(tool_speed_m_s=1.0, tool_acceleration_m_s2=math.inf):
        return MotionLimits(
            speed_rad_s=SPEEDS,
            acceleration_rad_s2=ACCELERATIONS,
            tool_speed_m_s=tool_speed_m_s,
            tool_acceleration_m_s2=tool_acceleration_m_s2,
        )

    return make


@pytest.fixture
def polylines():
    """Random joint polylines as shortened paths are: a few corners, a few radians."""

    def draw(count, seed=0):
        generator = np.random.default_rng(seed)
        start = np.array([0.0, -1.2, 1.4, -1.5, -1.5, 0.0])
        return [
            start + np.vstack([np.zeros(6), np.cumsum(generator.normal(0.0, 0.45, (corners, 6)), axis=0)])
            for corners in generator.integers(1, 8, count)
        ]

    return draw
