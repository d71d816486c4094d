"""Straight lines of the tool stay straight, in one branch."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from rgss.kinematics import LineBreak, follow_line, straight_line
from rgss.scenes import Pose

GRASP = Pose.from_roll_pitch_yaw((0.7, -0.3, 0.95), (math.pi, 0.0, 0.0))


@pytest.fixture
def start(inverse):
    return inverse.nearest(GRASP, (0.0, -1.5, 1.5, -1.5, -1.5, 0.0))


def test_the_tool_rises_along_a_vertical_line(arm, inverse, start):
    rows = straight_line(inverse, start, GRASP.raised(0.15))
    positions = arm.tool_position(rows)
    assert np.array_equal(rows[0], start)
    assert positions[:, :2] == pytest.approx(np.tile([0.7, -0.3], (len(rows), 1)), abs=1e-9)
    assert positions[:, 2] == pytest.approx(np.linspace(0.95, 1.10, len(rows)), abs=1e-9)
    assert arm.tool_pose(rows[-1]).position_m == pytest.approx(GRASP.raised(0.15).position_m, abs=1e-9)


def test_between_two_rows_the_joints_hardly_leave_the_line(arm, inverse, start):
    rows = straight_line(inverse, start, GRASP.raised(0.15))
    middles = (rows[1:] + rows[:-1]) / 2
    assert np.max(np.abs(arm.tool_position(middles)[:, :2] - [0.7, -0.3])) < 2e-5


@pytest.mark.parametrize(("step_m", "count"), [(0.005, 31), (0.05, 4), (1.0, 2)])
def test_rows_are_no_further_apart_than_the_step(inverse, start, step_m, count):
    rows = straight_line(inverse, start, GRASP.raised(0.15), step_m=step_m, largest_joint_step_rad=1.0)
    assert len(rows) == count


def test_the_tool_turns_evenly_on_the_way(arm, inverse, start):
    goal = Pose.from_roll_pitch_yaw((0.7, -0.2, 1.0), (math.pi, 0.0, 0.6))
    rows = straight_line(inverse, start, goal)
    turns = []
    for one, other in itertools.pairwise(rows):
        relative = arm.tool_matrix(one)[:3, :3].T @ arm.tool_matrix(other)[:3, :3]
        turns.append(math.acos(min(1.0, (np.trace(relative) - 1) / 2)))
    assert turns == pytest.approx([0.6 / len(turns)] * len(turns), abs=1e-6)
    assert max(turns) <= 0.02 + 1e-9


def test_the_short_way_round_is_taken_whatever_the_sign_of_the_quaternion(arm, inverse, start):
    goal = GRASP.raised(0.05)
    x, y, z, w = goal.quaternion_xyzw
    flipped = Pose(position_m=goal.position_m, quaternion_xyzw=(-x, -y, -z, -w))
    assert straight_line(inverse, start, flipped) == pytest.approx(straight_line(inverse, start, goal), abs=1e-9)


def test_the_branch_does_not_change(inverse, start):
    rows = straight_line(inverse, start, GRASP.raised(0.15))
    assert np.max(np.abs(np.diff(rows, axis=0))) < 0.05
    assert np.all(np.sign(np.sin(rows[:, 2])) == np.sign(math.sin(start[2])))


def test_a_line_that_leaves_the_reach_is_refused(inverse, start):
    assert straight_line(inverse, start, Pose.from_roll_pitch_yaw((2.5, -0.3, 0.95), (math.pi, 0.0, 0.0))) is None


def test_a_line_on_which_a_joint_jumps_is_refused(inverse, start):
    assert straight_line(inverse, start, GRASP.raised(0.15), largest_joint_step_rad=1e-4) is None


def test_a_line_is_followed_as_far_as_the_arm_can(arm, inverse, start):
    far = follow_line(inverse, start, GRASP.raised(3.0), largest_joint_step_rad=math.pi)
    stretched = follow_line(inverse, start, GRASP.raised(3.0))
    jump = follow_line(inverse, start, GRASP.raised(0.15), largest_joint_step_rad=1e-4)
    whole = follow_line(inverse, start, GRASP.raised(0.15))

    assert far.broken is LineBreak.UNREACHABLE
    assert 0.0 < far.fraction < 0.5
    risen_m = arm.tool_position(far.configurations_rad)[-1, 2] - 0.95
    assert risen_m == pytest.approx(3.0 * far.fraction, abs=1e-6)
    # The elbow turns ever faster towards the stretched arm, which is singular.
    assert stretched.broken is LineBreak.BRANCH_ENDS
    assert 0.0 < stretched.fraction <= far.fraction
    assert (jump.broken, jump.fraction, len(jump.configurations_rad)) == (LineBreak.BRANCH_ENDS, 0.0, 1)
    assert (whole.broken, whole.fraction) == (None, 1.0)


def test_a_line_of_no_length_is_its_start(inverse, start):
    rows = straight_line(inverse, start, inverse.arm.tool_pose(start))
    assert len(rows) == 2
    assert rows[1] == pytest.approx(start, abs=1e-9)
