"""Kinematics and dynamics of an arm with mimic joints, against a textbook's formula and Pinocchio's mimic joints."""

from __future__ import annotations

import math

import numpy as np
import pinocchio
import pytest

from rgss.kinematics import Arm, ArmDynamics, inverse_kinematics, position_gap_m, touching_links
from rgss.kinematics.serial_chain import SerialChain
from rgss.scenes import Pose
from tests.fixtures.palletizer import PALLETIZER_YAML, flange_of, palletizer, palletizer_urdf

pytestmark = pytest.mark.engine

ELBOW_LEVEL = '<mimic joint="elbow" multiplier="-1.0" offset="0.0"/>'
GENERAL = (ELBOW_LEVEL, '<mimic joint="shoulder" multiplier="-0.6" offset="0.25"/>')
# Within the ranges that the followers leave.
CONFIGURATIONS = np.random.default_rng(3).uniform((-2.5, -0.7, -0.9, -2.8), (2.5, 1.4, 1.2, 2.8), (40, 4))


@pytest.fixture(scope="module")
def robot(tmp_path_factory):
    return palletizer(tmp_path_factory.mktemp("palletizer"))


def mimic_model(*changed):
    """Pinocchio's own model with the constraint in it, which the product does not use."""
    return pinocchio.buildModelFromXML(palletizer_urdf(*changed), mimic=True)


def test_the_flange_is_where_the_textbook_has_it(robot):
    arm = Arm(robot, Pose())
    for q in CONFIGURATIONS:
        *position, yaw = flange_of(q)
        pose = arm.tool_pose(q)
        assert pose.position_m == pytest.approx(position, abs=1e-12)
        # It points down, whatever shoulder and elbow do.
        assert pose.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-12)
        assert pose.rotate((1.0, 0.0, 0.0)) == pytest.approx((math.cos(yaw), math.sin(yaw), 0.0), abs=1e-12)
    expected = np.array([flange_of(q)[:3] for q in CONFIGURATIONS])
    assert arm.tool_position(CONFIGURATIONS) == pytest.approx(expected, abs=1e-12)
    assert SerialChain(arm).state(CONFIGURATIONS).position_m == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("changed", [(), (GENERAL,)], ids=["levelled", "general"])
def test_jacobian_and_torques_are_those_of_the_constrained_arm(tmp_path, changed):
    robot = palletizer(tmp_path, *changed)
    arm, chain = Arm(robot, Pose()), SerialChain(Arm(robot, Pose()))
    dynamics = ArmDynamics(robot, (), gravity_m_s2=9.81)
    model = mimic_model(*changed)
    data, frame = model.createData(), model.getFrameId("flange", pinocchio.FrameType.BODY)
    generator = np.random.default_rng(4)
    assert model.nv == 4
    for q in CONFIGURATIONS[:10]:
        dq, ddq = generator.uniform(-2.0, 2.0, (2, 4))
        expected = pinocchio.computeFrameJacobian(model, data, q, frame, pinocchio.LOCAL_WORLD_ALIGNED)
        assert arm.tool_jacobian(q) == pytest.approx(expected, abs=1e-12)
        assert chain.state(q[None]).jacobian[0] == pytest.approx(expected, abs=1e-12)
        positions, velocities = arm.tool_motion([q], [dq])
        assert velocities[0] == pytest.approx(expected[:3] @ dq, abs=1e-12)
        assert positions[0] == pytest.approx(data.oMf[frame].translation, abs=1e-12)
        assert dynamics.torques(q, dq, ddq) == pytest.approx(pinocchio.rnea(model, data, q, dq, ddq), abs=1e-9)


def test_gravity_torques_are_the_gradient_of_the_potential_energy(robot):
    dynamics, still, step = ArmDynamics(robot, (), gravity_m_s2=9.81), np.zeros(4), 1e-6
    for q in CONFIGURATIONS[:5]:
        gradient = [
            (dynamics.potential_energy_j(q + unit) - dynamics.potential_energy_j(q - unit)) / (2 * step)
            for unit in step * np.eye(4)
        ]
        assert dynamics.torques(q, still, still) == pytest.approx(gradient, abs=1e-6)


def test_a_follower_carries_the_moment_of_what_hangs_on_it(robot):
    dynamics, still = ArmDynamics(robot, (), gravity_m_s2=9.81), np.zeros(4)
    # With the forearm level, the level joint of the shoulder holds it and what it carries.
    moment = -9.81 * (3.0 * 0.2 + (0.8 + 0.3) * 0.4)
    assert dynamics.follower_torques(still, still, still) == pytest.approx((moment, 0.0), abs=1e-9)


def test_inverse_kinematics_finds_the_configuration_that_the_textbook_has(robot):
    inverse = inverse_kinematics(Arm(robot, Pose()))
    for q in CONFIGURATIONS[:3]:
        *position, yaw = flange_of(q)
        found = inverse.solve(Pose.from_roll_pitch_yaw(tuple(position), (math.pi, 0.0, yaw)))
        assert min(np.max(np.abs(one - q)) for one in found) < 1e-6
        for one in found:
            assert flange_of(one)[:3] == pytest.approx(position, abs=1e-6)


def test_a_joint_with_a_follower_of_half_its_turn_is_not_turned_whole(tmp_path):
    ranges = ("[-160 deg, 160 deg]", "[-400 deg, 400 deg]")
    half = '<mimic joint="turret" multiplier="0.5" offset="0.0"/>'
    wide = 'lower="-1.2" upper="0.9"', 'lower="-9" upper="9"'
    turret = 'lower="-2.9" upper="2.9"', 'lower="-7" upper="7"'
    robot = palletizer(tmp_path, (ELBOW_LEVEL, half), wide, turret, yaml=PALLETIZER_YAML.replace(*ranges))
    arm = Arm(robot, Pose())
    q = np.array([0.4, 0.3, 0.2, 0.1])
    pose = arm.tool_pose(q)
    found = inverse_kinematics(arm).solve(pose)
    assert min(np.max(np.abs(one - q)) for one in found) < 1e-6
    for one in found:
        reached = arm.tool_pose(one)
        assert reached.position_m == pytest.approx(pose.position_m, abs=1e-5)


def test_links_touch_where_the_follower_brings_them_together(robot):
    # The forearm keeps its slope while the upper arm leans back, and the corner between them closes.
    assert touching_links(robot, (0.0, 0.0, 0.0, 0.0)) == ()
    assert touching_links(robot, (0.0, -0.7, 0.0, 0.0)) == (("forearm", "upper"),)


def test_the_distance_of_a_point_is_that_of_the_stretched_arm(robot):
    arm = Arm(robot, Pose())
    # At the height of the flange with the shoulder at the end of its range and the forearm level.
    *stretched, _ = flange_of((0.0, 1.4, 0.0, 0.0))
    assert arm.reach_m >= stretched[0]
    assert position_gap_m(arm, (stretched[0] + 1.0, 0.0, stretched[2])) == pytest.approx(1.0, abs=0.01)
