"""Every branch of the inverse kinematics, against forward kinematics and an independent solver."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.kinematics import Arm, inverse_kinematics
from rgss.kinematics.configurations import TOLERANCE
from rgss.scenes import Pose

DOWN = Pose.from_roll_pitch_yaw((0.7, -0.3, 0.95), (math.pi, 0.0, 0.0))


def directions(configurations):
    """Angles as directions, so that whole turns are equal."""
    return {tuple(np.round([f(angle) for angle in q for f in (math.cos, math.sin)], 5) + 0.0) for q in configurations}


@pytest.mark.verifies("SYS-035")
def test_every_solution_reproduces_the_pose(arm, inverse, configurations):
    for q in configurations(60):
        target = arm.tool_matrix(q)
        solutions = inverse.solve(arm.tool_pose(q))
        assert solutions
        for solution in solutions:
            assert np.max(np.abs(arm.tool_matrix(solution) - target)) < TOLERANCE


def test_the_configuration_that_made_the_pose_is_among_the_solutions(arm, inverse, configurations):
    for q in configurations(200, seed=1):
        distances = [np.max(np.abs(solution - q)) for solution in inverse.solve(arm.tool_pose(q))]
        assert min(distances) < 1e-6


def test_a_generic_pose_has_eight_branches(inverse):
    assert len(directions(inverse.solve(DOWN))) == 8


@pytest.mark.verifies("SYS-035")
def test_branches_equal_those_of_an_independent_solver(robot, reference):
    arm = Arm(replace(robot, base=Pose()), Pose())
    inverse = inverse_kinematics(arm)
    counts = set()
    for each in reference:
        ours = directions(inverse.solve(arm.tool_pose(np.array(each["configuration_rad"]))))
        # The other solver rounds differently near the end of a cell, so that the sets are compared by distance.
        for solution in each["solutions_rad"]:
            vector = np.array([f(angle) for angle in solution for f in (math.cos, math.sin)])
            assert min(np.max(np.abs(vector - np.array(own))) for own in ours) < 1e-4
        assert len(ours) >= len(each["solutions_rad"])
        counts.add(len(each["solutions_rad"]))
    assert 8 in counts


def test_whole_turns_within_the_ranges_are_all_there_and_none_beyond(inverse, robot):
    solutions = inverse.solve(DOWN)
    for q in solutions:
        for angle, joint in zip(q, robot.joints, strict=True):
            assert joint.lower_rad <= angle <= joint.upper_rad
    # Five joints with two turns of range have every direction twice, the elbow once.
    assert len(solutions) == 8 * 2**5
    assert len({tuple(np.round(q, 6)) for q in solutions}) == len(solutions)


def test_narrow_ranges_leave_the_branches_that_fit(new_robot, robot, gripper, inverse):
    joints = tuple(replace(joint, lower_rad=-math.pi, upper_rad=math.pi) for joint in robot.joints)
    narrow = inverse_kinematics(Arm(new_robot(joints=joints), gripper.grasp_centre))
    assert len(narrow.solve(DOWN)) == 8
    elbow_up = tuple(replace(joint, lower_rad=0.0) if joint.name == "elbow_joint" else joint for joint in joints)
    assert len(inverse_kinematics(Arm(new_robot(joints=elbow_up), gripper.grasp_centre)).solve(DOWN)) == 4


def test_solutions_are_in_lexicographic_order_and_the_same_every_time(inverse):
    first, second = inverse.solve(DOWN), inverse.solve(DOWN)
    keys = [tuple(np.round(q, 6)) for q in first]
    assert keys == sorted(keys)
    assert all(np.array_equal(one, other) for one, other in zip(first, second, strict=True))


@pytest.mark.parametrize("position_m", [(3.0, 0.0, 1.0), (0.0, 0.0, 0.9774), (0.0, 0.05, 0.5)])
def test_a_pose_out_of_reach_has_no_solution(inverse, position_m):
    pose = Pose.from_roll_pitch_yaw(position_m, (math.pi, 0.0, 0.0))
    assert inverse.solve(pose) == ()
    assert inverse.nearest(pose, np.zeros(6)) is None


def test_nearest_is_the_nearest_of_all(inverse, configurations):
    solutions = np.array(inverse.solve(DOWN))
    for reference in configurations(40, seed=3):
        nearest = inverse.nearest(DOWN, reference)
        best = np.min(np.max(np.abs(solutions - reference), axis=1))
        assert np.max(np.abs(nearest - reference)) == pytest.approx(best, abs=1e-9)


def test_nearest_to_a_solution_is_that_solution(inverse):
    for solution in inverse.solve(DOWN)[::17]:
        assert inverse.nearest(DOWN, solution) == pytest.approx(solution, abs=1e-9)
