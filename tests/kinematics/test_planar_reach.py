"""Poses out of reach of an arm of few joints are excluded without a search, and no others."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.kinematics import Arm
from rgss.kinematics.numerical_inverse import NumericalInverse
from rgss.kinematics.planar_reach import PlanarReach
from rgss.kinematics.serial_chain import SerialChain
from rgss.scenes import Pose
from tests.fixtures.palletizer import palletizer
from tests.fixtures.serial_arms import FIVE, GANTRY, HALF, SCARA, SEVEN, TRACK, Link, Y, serial_robot

ADMITS = PlanarReach.admits
TOOL = Pose(position_m=(0.0, 0.0, 0.1))
ROUNDED = tuple(Link(one.kind, one.xyz, tuple(round(a, 4) for a in one.rpy), one.axis, one.range) for one in SCARA)
SCARA_WITH_A_WRIST = (*SCARA, Link("revolute", (0.0, 0.0, 0.05), axis=Y, range=(-1.0, 1.0)))
SERIAL = {
    "scara": SCARA,
    "scara of rounded angles": ROUNDED,
    "scara with a wrist": SCARA_WITH_A_WRIST,
    "five": FIVE,
    "gantry": GANTRY,
    "five on a track": (TRACK[0], *FIVE),
    "five on a lift": (Link("prismatic", (0.0, 0.0, 0.1), range=(0.0, 0.5)), *FIVE),
    "two": (FIVE[0], Link("revolute", (0.0, 0.05, 0.1), (HALF, 0.0, 0.0))),
    "seven": SEVEN,
}


@pytest.fixture(params=["palletizer", *SERIAL])
def arm(request, tmp_path):
    if request.param == "palletizer":
        return Arm(palletizer(tmp_path), TOOL)
    return Arm(
        serial_robot(SERIAL[request.param], base=Pose.from_roll_pitch_yaw((0.3, 0.1, 0.5), (0.4, 0.2, 1.0))), TOOL
    )


def configurations(arm, count):
    shares = np.random.default_rng(5).random((count, len(arm.robot.joints)))
    return arm.lower_rad + shares * (arm.upper_rad - arm.lower_rad)


def test_no_pose_that_a_configuration_reaches_is_excluded(arm):
    reach = PlanarReach(arm)
    for q in configurations(arm, 400):
        matrix = arm.tool_matrix(q)
        assert reach.admits(matrix[:3, 3], matrix[:3, 2])


def test_no_pose_is_excluded_that_the_search_finds(arm, monkeypatch):
    """The tool is turned by up to half a turn, to where most arms of few joints cannot bring it."""
    reach, inverse = PlanarReach(arm), NumericalInverse(arm)
    monkeypatch.setattr(PlanarReach, "admits", lambda *_: True)
    turns = np.random.default_rng(6).uniform(-math.pi, math.pi, (4, 3))
    for q, turned_rad in zip(configurations(arm, 4), turns, strict=True):
        pose = arm.tool_pose(q) @ Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), tuple(turned_rad.tolist()))
        assert ADMITS(reach, pose.position_m, pose.rotate((0.0, 0.0, 1.0))) or not inverse.solve(pose)


@pytest.mark.parametrize("name", ["palletizer", "scara", "scara of rounded angles", "five", "five on a lift"])
def test_a_pose_across_the_plane_of_the_arm_needs_no_search(name, tmp_path, monkeypatch):
    arm = Arm(palletizer(tmp_path) if name == "palletizer" else serial_robot(SERIAL[name]), TOOL)
    inverse = NumericalInverse(arm)
    q = 0.6 * arm.upper_rad + 0.4 * arm.lower_rad
    assert inverse.solve(arm.tool_pose(q))
    position = arm.tool_pose(q).position_m
    across = Pose(position_m=position) @ Pose.from_roll_pitch_yaw(
        (0.0, 0.0, 0.0),
        (0.0, HALF, math.atan2(position[1], position[0]) + HALF),
    )
    monkeypatch.setattr(SerialChain, "state", lambda *_: pytest.fail("a search was begun"))
    assert inverse.solve(across) == ()
    assert inverse.nearest(across, q) is None


def test_a_pose_beyond_the_arm_needs_no_search(monkeypatch):
    inverse = NumericalInverse(Arm(serial_robot(SEVEN), TOOL))
    monkeypatch.setattr(SerialChain, "state", lambda *_: pytest.fail("a search was begun"))
    assert inverse.solve(Pose(position_m=(3.0, 0.0, 0.5))) == ()
