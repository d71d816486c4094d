"""Reach of an arm, which the place of the first joint's frame on its axis does not change."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.scenes import Pose, load_gripper
from rgss.studies.robot_project.descent_search import descent_search
from rgss.studies.robot_project.reach import arm_reach_m
from tests.fixtures.serial_arms import FIVE, GANTRY, HALF, SCARA, SEVEN, TRACK, Link, serial_robot

LEVEL = Pose()
TILTED = Pose.from_roll_pitch_yaw((0.2, -0.1, 0.5), (0.3, 1.2, 0.7))
SHIFT_M = 1.0


def lowered(links):
    """The same arm with the frame of its first joint one metre lower on the joint's axis."""
    first, second, *rest = links
    (x, y, z), (a, b, c) = first.xyz, second.xyz
    return (replace(first, xyz=(x, y, z - SHIFT_M)), replace(second, xyz=(a, b, c + SHIFT_M)), *rest)


@pytest.mark.parametrize("base", [LEVEL, TILTED], ids=["level", "tilted"])
@pytest.mark.parametrize("links", [SEVEN, FIVE, SCARA], ids=["seven", "five", "scara"])
def test_the_frame_of_the_first_joint_may_be_anywhere_on_its_axis(links, base):
    reach_m = arm_reach_m(serial_robot(links, base=base))
    assert arm_reach_m(serial_robot(lowered(links), base=base)) == pytest.approx(reach_m, abs=1e-12)


def test_the_reach_of_a_scara_is_that_of_its_two_links():
    reach_m = arm_reach_m(serial_robot(SCARA, base=LEVEL))
    assert 0.6 * 0.999 < reach_m <= 0.6 + 1e-12


def test_the_reach_of_an_arm_whose_first_axis_is_level_is_across_that_axis():
    across = (Link("revolute", (0.3, 0.0, 0.4), (HALF, 0.0, 0.0)), Link("revolute", (0.5, 0.0, 0.7)))
    # The tool is 0.5 m from the axis, and 0.7 m along it.
    assert arm_reach_m(serial_robot(across, base=LEVEL)) == pytest.approx(0.5)


def test_the_reach_of_a_gantry_is_measured_from_the_middle_of_its_region():
    diagonal_m = math.hypot(1.0, 0.9, 1.0)
    for links in (GANTRY, (replace(GANTRY[0], xyz=(3.0, -2.0, 5.0)), *GANTRY[1:])):
        assert 0.85 * diagonal_m / 2 < arm_reach_m(serial_robot(links, base=LEVEL)) < diagonal_m / 2


def test_the_reach_of_an_arm_on_a_track_has_the_travel():
    arm_m = arm_reach_m(serial_robot(SEVEN, base=LEVEL))
    assert arm_m + 0.4 < arm_reach_m(serial_robot(TRACK, base=LEVEL)) < arm_m + 0.7


def test_tables_do_not_depend_on_the_frame_of_the_first_joint(shipped):
    geometry = load_gripper(shipped.folder / "scenes" / "grippers" / "kg-2.yaml")
    first, second = (
        descent_search(serial_robot(links, base=LEVEL), geometry, scale=1.0).layouts for links in (FIVE, lowered(FIVE))
    )
    assert len(first) == len(second) > 0
    for one, other in zip(first, second, strict=True):
        assert (one.x_m, one.y_m, one.table_m) == pytest.approx((other.x_m, other.y_m, other.table_m), abs=2e-3)
        assert one.base_m == pytest.approx(other.base_m, abs=2e-3)
