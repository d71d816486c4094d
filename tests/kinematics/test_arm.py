"""Forward kinematics, Jacobian and dynamics against implementations that share no code with ours."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from rgss.kinematics import Arm, ArmDynamics
from rgss.scenes import Pose

# Universal Robots, "DH parameters for calculations of kinematics and dynamics", row UR10: masses, and centres of
# mass in the frame at the far end of each link.
MASSES_KG = (7.1, 12.7, 4.27, 2.0, 2.0, 0.365)
CENTRES_M = (
    (0.021, 0.0, 0.027),
    (0.38, 0.0, 0.158),
    (0.24, 0.0, 0.068),
    (0.0, 0.007, 0.018),
    (0.0, 0.007, 0.018),
    (0.0, 0.0, -0.026),
)


@pytest.fixture(scope="module")
def flange_arm(new_robot_at_origin):
    return Arm(new_robot_at_origin, Pose())


@pytest.fixture(scope="module")
def new_robot_at_origin(robot):
    return replace(robot, base=Pose())


@pytest.mark.verifies("SYS-018")
def test_forward_kinematics_equal_an_independent_implementation(flange_arm, reference):
    worst = max(
        float(np.max(np.abs(flange_arm.tool_matrix(np.array(each["configuration_rad"])) - np.array(each["matrix"]))))
        for each in reference
    )
    assert worst < 1e-6


def test_forward_kinematics_equal_plain_matrix_products(flange_arm, configurations, link_frames):
    for q in configurations(200, seed=1):
        assert flange_arm.tool_matrix(q) == pytest.approx(link_frames(q)[6], abs=1e-12)


def test_base_and_tool_are_chained_before_and_after_the_arm(robot, new_robot, configurations, link_frames, matrix_of):
    base = Pose.from_roll_pitch_yaw((0.3, -0.2, 0.9), (0.1, -0.4, 2.0))
    tool = Pose.from_roll_pitch_yaw((0.01, 0.02, 0.145), (0.3, 0.2, -1.0))
    arm = Arm(new_robot(base=base), tool)
    for q in configurations(20, seed=2):
        expected = matrix_of(base) @ link_frames(q)[6] @ matrix_of(tool)
        assert matrix_of(arm.tool_pose(q)) == pytest.approx(expected, abs=1e-9)
        assert arm.tool_matrix(q) == pytest.approx(expected, abs=1e-9)


def test_positions_of_many_configurations_are_those_of_each(arm, configurations):
    qs = configurations(50)
    positions = arm.tool_position(qs)
    assert positions.shape == (50, 3)
    for q, position in zip(qs, positions, strict=True):
        assert arm.tool_pose(q).position_m == pytest.approx(position, abs=1e-12)
        assert arm.tool_position(q)[0] == pytest.approx(position, abs=1e-12)


def test_the_tools_motion_is_its_place_and_the_jacobian_times_the_joints_speeds(arm, configurations):
    qs, dqs = configurations(50), configurations(50, seed=2)
    positions, velocities = arm.tool_motion(qs, dqs)
    assert positions == pytest.approx(arm.tool_position(qs), abs=1e-15)
    for q, dq, velocity in zip(qs, dqs, velocities, strict=True):
        assert velocity == pytest.approx(arm.tool_jacobian(q)[:3] @ dq, abs=1e-12)


def test_no_axis_is_farther_from_the_tool_than_the_reach(arm, configurations):
    """So that a joint that is off by an angle moves the tool by at most the angle times the reach."""
    qs = configurations(500)
    turned = [
        np.linalg.norm(arm.tool_position(qs + 1e-4 * row) - arm.tool_position(qs), axis=1).max() for row in np.eye(6)
    ]
    assert max(turned) <= 1e-4 * arm.reach_m
    assert max(turned) > 0.6e-4 * arm.reach_m


def test_jacobian_equals_finite_differences(arm, configurations):
    step = 1e-6
    for q in configurations(30, seed=3):
        jacobian = arm.tool_jacobian(q)
        for joint in range(6):
            shift = step * np.eye(6)[joint]
            ahead, behind = arm.tool_matrix(q + shift), arm.tool_matrix(q - shift)
            linear = (ahead[:3, 3] - behind[:3, 3]) / (2 * step)
            spin = (ahead[:3, :3] - behind[:3, :3]) / (2 * step) @ arm.tool_matrix(q)[:3, :3].T
            angular = np.array([spin[2, 1], spin[0, 2], spin[1, 0]])
            assert jacobian[:, joint] == pytest.approx([*linear, *angular], abs=1e-7)


def test_a_jacobian_stays_as_it_is_when_another_is_computed(arm, configurations):
    one, other = configurations(2)
    first = arm.tool_jacobian(one)
    kept = first.copy()
    arm.tool_jacobian(other)
    assert np.array_equal(first, kept)


def _gravity_torques(frames, gravity_m_s2):
    """Virtual work: the torque that holds a link is its weight times the rise per radian of each joint."""
    torques = np.zeros(6)
    for link, (mass, centre) in enumerate(zip(MASSES_KG, CENTRES_M, strict=True)):
        position = (frames[link + 1] @ [*centre, 1.0])[:3]
        for joint in range(link + 1):
            axis, origin = frames[joint][:3, 2], frames[joint][:3, 3]
            torques[joint] += mass * gravity_m_s2 * np.cross(axis, position - origin)[2]
    return torques


def test_gravity_torques_equal_virtual_work_of_the_published_masses(robot, configurations, link_frames):
    bare = ArmDynamics(robot, (), gravity_m_s2=9.81)
    for q in configurations(100, seed=4):
        torques = bare.torques(q, np.zeros(6), np.zeros(6))
        # The flange of the description weighs a gram, which no table has.
        assert torques == pytest.approx(_gravity_torques(link_frames(q), 9.81), abs=0.02)


def test_gravity_alone_stays_within_the_torque_limits(robot, configurations):
    bare = ArmDynamics(robot, (), gravity_m_s2=9.81)
    limits = np.array([joint.torque_n_m for joint in robot.joints])
    for q in configurations(300, seed=5):
        assert np.all(np.abs(bare.torques(q, np.zeros(6), np.zeros(6))) < limits)


def test_gravity_points_down_in_the_world_whatever_the_base(new_robot, configurations):
    base = Pose.from_roll_pitch_yaw((0.0, 0.0, 1.0), (math.pi / 2, 0.0, 0.0))
    tilted = ArmDynamics(new_robot(base=base), (), gravity_m_s2=9.81)
    torque = tilted.torques(np.zeros(6), np.zeros(6), np.zeros(6))
    assert abs(torque[0]) > 100.0, "a base on its side carries the outstretched arm with its first joint"


def test_power_of_the_joints_is_the_change_of_energy(new_robot, configurations):
    bare = ArmDynamics(new_robot(), (), gravity_m_s2=0.0)
    generator = np.random.default_rng(6)
    for q in configurations(10, seed=6):
        dq, ddq = generator.normal(size=6), generator.normal(size=6)

        def energy(q, dq):
            mass = np.array([bare.torques(q, np.zeros(6), unit) for unit in np.eye(6)]).T
            assert np.all(np.linalg.eigvalsh((mass + mass.T) / 2) > 0.0)
            return 0.5 * dq @ mass @ dq

        step = 1e-6
        change = (energy(q + step * dq, dq + step * ddq) - energy(q - step * dq, dq - step * ddq)) / (2 * step)
        assert dq @ bare.torques(q, dq, ddq) == pytest.approx(change, rel=1e-5, abs=1e-6)


def test_planning_ranges_are_those_of_the_robot(arm, robot):
    assert arm.lower_rad.tolist() == [joint.lower_rad for joint in robot.joints]
    assert arm.upper_rad.tolist() == [joint.upper_rad for joint in robot.joints]
