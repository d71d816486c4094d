"""What every implementation of the inverse kinematics must do, on arms of four to eight joints."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.kinematics import Arm, follow_line, inverse_kinematics
from rgss.kinematics.analytic_inverse import AnalyticInverse
from rgss.kinematics.configurations import TOLERANCE
from rgss.kinematics.numerical_inverse import NumericalInverse
from rgss.kinematics.serial_chain import SerialChain
from rgss.scenes import JointKind, Pose
from tests.fixtures.serial_arms import ARMS, FIVE, GANTRY, SCARA, SEVEN, serial_robot

TOOL = Pose.from_roll_pitch_yaw((0.01, 0.0, 0.12), (0.0, 0.0, 0.4))


def make(name, new_robot):
    if name == "analytic":
        return AnalyticInverse(Arm(new_robot(), TOOL))
    if name == "six with a decomposition":
        return NumericalInverse(Arm(new_robot(), TOOL))
    return inverse_kinematics(Arm(serial_robot(ARMS[name]), TOOL))


@pytest.fixture(params=["analytic", "six with a decomposition", *ARMS])
def inverse(request, new_robot):
    return make(request.param, new_robot)


def random_configurations(arm, count, seed=3):
    shares = np.random.default_rng(seed).random((count, len(arm.robot.joints)))
    return arm.lower_rad + shares * (arm.upper_rad - arm.lower_rad)


def deviation(arm, q, pose):
    """Greatest deviation from a pose; of the tool's axis alone where the arm has fewer than six joints."""
    axes = np.array([pose.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))])
    target = np.column_stack([axes.T, pose.position_m])
    columns = slice(2, 4) if len(arm.robot.joints) < 6 else slice(0, 4)
    return np.max(np.abs(arm.tool_matrix(q)[:3, columns] - target[:, columns]))


def test_every_solution_reaches_the_pose_within_the_ranges(inverse):
    arm = inverse.arm
    for q in random_configurations(arm, 4):
        pose = arm.tool_pose(q)
        solutions = inverse.solve(pose)
        assert solutions
        assert [tuple(np.round(one, 6)) for one in solutions] == sorted(tuple(np.round(one, 6)) for one in solutions)
        for solution in solutions:
            assert deviation(arm, solution, pose) < TOLERANCE
            assert np.all(solution >= arm.lower_rad)
            assert np.all(solution <= arm.upper_rad)


def test_the_nearest_of_a_near_configuration_is_near(inverse):
    arm = inverse.arm
    for q in random_configurations(arm, 4, seed=4):
        inside = np.clip(q, arm.lower_rad + 0.05, arm.upper_rad - 0.05)
        found = inverse.nearest(arm.tool_pose(inside), inside + 1e-4)
        assert found is not None
        assert np.max(np.abs(found - inside)) < 0.02
        assert deviation(arm, found, arm.tool_pose(inside)) < TOLERANCE


def test_answers_do_not_depend_on_what_was_asked_before(inverse):
    arm = inverse.arm
    one, other = (arm.tool_pose(q) for q in random_configurations(arm, 2, seed=5))
    first = inverse.solve(one)
    inverse.solve(other)
    again = inverse.solve(one)
    assert [q.tobytes() for q in again] == [q.tobytes() for q in first]


def test_a_pose_beyond_the_reach_has_no_configuration(inverse):
    x, y, z = inverse.arm.first_axis_m
    far = Pose(position_m=(x + inverse.arm.reach_m + 0.5, y, z))
    assert inverse.solve(far) == ()
    assert inverse.nearest(far, inverse.arm.robot.home_rad) is None
    # A slide would have to be drawn out farther than it is long; no angle would help.
    assert all(one.kind is JointKind.PRISMATIC for one in inverse.excess_of_ranges(far))


def test_the_numerical_one_finds_every_branch_of_the_analytic_one(new_robot):
    arm = Arm(new_robot(), TOOL)
    analytic, numerical = AnalyticInverse(arm), NumericalInverse(arm)
    for q in random_configurations(arm, 6, seed=6):
        wanted = analytic.solve(arm.tool_pose(q))
        found = np.array(numerical.solve(arm.tool_pose(q)))
        assert len(wanted) == len(found)
        for one in wanted:
            assert np.min(np.max(np.abs(found - one), axis=1)) < 1e-6


def test_reachable_poses_of_seven_joints_are_reached():
    arm = Arm(serial_robot(SEVEN), TOOL)
    inverse = NumericalInverse(arm)
    assert inverse.is_redundant
    reached = [
        inverse.nearest(arm.tool_pose(q), arm.robot.home_rad) is not None for q in random_configurations(arm, 100)
    ]
    assert all(reached)


def test_a_redundant_arm_is_led_to_the_configuration_at_the_end_of_a_line():
    arm = Arm(serial_robot(SEVEN, base=Pose()), TOOL)
    inverse = NumericalInverse(arm)
    down = Pose.from_roll_pitch_yaw((0.45, 0.1, 0.35), (math.pi, 0.0, 0.2))
    above = Pose.from_roll_pitch_yaw((0.45, 0.1, 0.45), (math.pi, 0.0, 0.2))
    start = inverse.nearest(above, arm.robot.home_rad)
    elbow_turned = inverse.nearest(down, start + np.array([0.15, 0.0, -0.15, 0.0, 0.1, 0.0, 0.0]))
    line = follow_line(inverse, start, down, goal_configuration=elbow_turned)
    assert line.broken is None
    assert np.max(np.abs(line.configurations_rad[-1] - elbow_turned)) < 1e-6
    free = follow_line(inverse, start, down)
    assert np.max(np.abs(free.configurations_rad[-1] - elbow_turned)) > 1e-3


def test_few_joints_take_the_whole_pose_where_they_can():
    arm = Arm(serial_robot(SCARA, base=Pose()), Pose())
    inverse = NumericalInverse(arm)
    down = Pose.from_roll_pitch_yaw((0.3, 0.2, 0.25), (math.pi, 0.0, 0.5))
    solutions = inverse.solve(down)
    assert len({tuple(np.sign(np.round(q[1:2], 6))) for q in solutions}) == 2
    target = arm.tool_matrix(solutions[0])
    for q in solutions:
        assert np.max(np.abs(arm.tool_matrix(q) - target)) < 2 * TOLERANCE


def test_few_joints_turn_about_the_tool_where_they_must():
    arm = Arm(serial_robot(FIVE[:4], base=Pose()), Pose())
    inverse = NumericalInverse(arm)
    down = Pose.from_roll_pitch_yaw((0.4, 0.1, 0.2), (math.pi, 0.0, 0.9))
    solutions = inverse.solve(down)
    assert solutions
    for q in solutions:
        pose = arm.tool_pose(q)
        assert pose.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-6)
        assert pose.position_m == pytest.approx(down.position_m, abs=1e-6)


@pytest.mark.parametrize(("links", "least"), [(FIVE, 20), (FIVE[:4], 1), (SCARA, 20), (SEVEN, 20), (GANTRY, 1)])
def test_position_and_axis_alone_leave_the_turn_to_the_arm(links, least):
    arm = Arm(serial_robot(links, base=Pose()), Pose())
    inverse = inverse_kinematics(arm, is_turn_free=True)
    # Every tool of these points down at the middle of the joints' ranges, or can be brought to do so.
    down = Pose.from_roll_pitch_yaw((0.4, 0.1, 0.25), (math.pi, 0.0, 0.9))

    solutions = inverse.solve(down)

    assert len(solutions) >= least
    for q in solutions:
        pose = arm.tool_pose(q)
        assert pose.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-6)
        assert pose.position_m == pytest.approx(down.position_m, abs=1e-6)
        assert np.all((q >= arm.lower_rad) & (q <= arm.upper_rad))
    # However the pose is turned about its axis, the answer is the same.
    turned = Pose.from_roll_pitch_yaw((0.4, 0.1, 0.25), (math.pi, 0.0, -1.3))
    again = inverse.solve(turned)
    assert len(again) == len(solutions)
    assert np.max(np.abs(np.array(again) - np.array(solutions))) < 1e-4


@pytest.mark.parametrize("is_turn_free", [False, True])
def test_no_joint_leaves_its_range_where_the_arm_is_at_its_limit(is_turn_free):
    """Planners refuse what lies outside by a rounding error, as half a turn with eleven digits does."""
    links = tuple(replace(link, range=(-math.pi, math.pi)) for link in SEVEN)
    narrow = replace(links[3], range=(-math.pi / 3, math.pi))
    arm = Arm(serial_robot((*links[:3], narrow, *links[4:])), Pose())
    inverse = inverse_kinematics(arm, is_turn_free=is_turn_free)
    poses = [arm.tool_pose(np.array([0.1 * one, 0.3, 0.2, 1.2, 0.3, 0.5, math.pi])) for one in range(6)]

    found = np.array([q for pose in poses for q in inverse.solve(pose)])

    at_limit = (np.abs(found - arm.lower_rad) < 1e-9) | (np.abs(found - arm.upper_rad) < 1e-9)
    assert at_limit.any()
    assert np.all((found >= arm.lower_rad) & (found <= arm.upper_rad))


def test_a_line_with_a_free_turn_keeps_the_last_joint_still():
    arm = Arm(serial_robot(FIVE, base=Pose()), Pose())
    inverse = inverse_kinematics(arm, is_turn_free=True)
    start = inverse.nearest(
        Pose.from_roll_pitch_yaw((0.4, -0.25, 0.25), (math.pi, 0.0, 0.0)), (-0.5, 0.5, 1.5, 1.1, 0.3)
    )
    goal = Pose.from_roll_pitch_yaw((0.4, 0.25, 0.25), (math.pi, 0.0, 2.0))

    line = follow_line(inverse, start, goal)

    assert line.broken is None
    assert np.max(np.abs(np.diff(line.configurations_rad[:, 4]))) < 1e-6
    heights = arm.tool_position(line.configurations_rad)[:, 2]
    assert np.max(np.abs(heights - 0.25)) < 1e-6


def test_the_batched_chain_is_the_arm(inverse):
    arm = inverse.arm
    qs = random_configurations(arm, 5, seed=8)
    state = SerialChain(arm).state(qs)
    for row, q in enumerate(qs):
        assert np.max(np.abs(state.position_m[row] - arm.tool_matrix(q)[:3, 3])) < 1e-12
        assert np.max(np.abs(state.rotation[row] - arm.tool_matrix(q)[:3, :3])) < 1e-12
        assert np.max(np.abs(state.jacobian[row] - arm.tool_jacobian(q))) < 1e-12


def test_the_motion_of_the_tool_is_that_of_its_jacobian(inverse):
    arm = inverse.arm
    qs = random_configurations(arm, 5, seed=9)
    rates = np.random.default_rng(1).normal(size=qs.shape)
    positions, velocities = arm.tool_motion(qs, rates)
    for row, q in enumerate(qs):
        assert positions[row] == pytest.approx(arm.tool_matrix(q)[:3, 3], abs=1e-12)
        assert velocities[row] == pytest.approx(arm.tool_jacobian(q)[:3] @ rates[row], abs=1e-11)
        assert math.dist(positions[row], arm.first_axis_m) <= arm.reach_m + 1e-9
