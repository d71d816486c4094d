"""Least distance of the tool centre from a point, on arms whose distance is known."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.kinematics import Arm, position_gap_m
from rgss.scenes import Pose
from tests.fixtures.serial_arms import ARMS, GANTRY, SCARA, serial_robot


@pytest.mark.parametrize("name", ARMS)
def test_a_position_that_the_tool_takes_has_none(name):
    arm = Arm(serial_robot(ARMS[name]), Pose())
    q = arm.lower_rad + np.linspace(0.3, 0.6, len(arm.robot.joints)) * (arm.upper_rad - arm.lower_rad)

    assert position_gap_m(arm, arm.tool_position(q)[0]) < 1e-6


def test_the_gap_is_measured_to_the_nearest_position_within_the_ranges():
    # The tool of a scara is on circles about its first axis, of 0.6 m at most.
    scara = Arm(serial_robot(SCARA, base=Pose()), Pose())
    height_m = scara.tool_position(scara.robot.home_rad)[0][2]
    assert position_gap_m(scara, (0.9 * math.cos(1.0), 0.9 * math.sin(1.0), height_m)) == pytest.approx(0.3, abs=1e-6)

    gantry = Arm(serial_robot(GANTRY, base=Pose()), Pose())
    x, y, z = gantry.tool_position(gantry.upper_rad)[0]
    assert position_gap_m(gantry, (x + 0.2, y, z)) == pytest.approx(0.2, abs=1e-6)
