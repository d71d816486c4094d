"""An arm with mimic joints in both engines: where it is, what its driven joints carry, and their limits."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.kinematics import Arm, ArmDynamics, gripper_loads
from rgss.physics import PhysicsSettings, TorqueArm, World
from rgss.scenes import Pose
from rgss.trials.second_engine import mujoco_settings
from tests.fixtures.palletizer import flange_of, palletizer
from tests.physics.conftest import smooth

pytestmark = pytest.mark.engine

START, GOAL = np.array([-0.3, 0.2, -0.1, 0.4]), np.array([0.4, 0.6, 0.3, -0.4])
STILL = (0.0,) * 4


@pytest.fixture(scope="module")
def robot(tmp_path_factory):
    # High above the tables of the scene, and turned.
    base = Pose.from_roll_pitch_yaw((0.0, 0.0, 2.0), (0.0, 0.0, 0.5))
    return palletizer(tmp_path_factory.mktemp("palletizer"), base=base)


def dynamics_of(cell, robot):
    loads = gripper_loads(cell.gripper, cell.gripper.geometry.largest_opening_m)
    return ArmDynamics(robot, loads, gravity_m_s2=cell.scene.gravity_m_s2)


@pytest.fixture(params=["pybullet", "mujoco"])
def world(request, three_fingers, robot):
    scene = replace(three_fingers.scene, robot=robot)
    if request.param == "pybullet":
        opened = World(scene, three_fingers.gripper, PhysicsSettings())
    else:
        opened = mujoco_settings().open(scene, three_fingers.gripper)
    with opened:
        yield opened


def test_the_hand_is_where_the_textbook_has_it(world, robot, three_fingers):
    height_m = three_fingers.gripper.geometry.grasp_centre.position_m[2]
    for q in (START, GOAL):
        world.reset_arm(q.tolist())
        x, y, z, _ = flange_of(q)
        expected = robot.base @ Pose(position_m=(x, y, z - height_m))
        assert world.tool_pose().position_m == pytest.approx(expected.position_m, abs=1e-6)
        assert world.follow_error == pytest.approx(0.0, abs=1e-9)


def test_a_move_is_followed_and_the_driven_joints_carry_their_followers(world, robot, three_fingers):
    settings, dynamics = world.settings, dynamics_of(three_fingers, robot)
    steps = round(1.0 * settings.rate_hz)
    path = START + (GOAL - START) * smooth(np.linspace(0.0, 1.0, steps + 1))[:, None]
    speeds = np.diff(path, axis=0) / settings.step_s
    world.reset_arm(START.tolist())
    for _ in range(round(0.2 * settings.rate_hz)):
        world.command_arm(START.tolist(), STILL)
        world.step()
    lags, errors, torques = [], [], []
    for index in range(steps):
        world.command_arm(path[index].tolist(), speeds[index].tolist())
        world.step()
        positions, _, torque = world.arm_state()
        lags.append(np.max(np.abs(np.array(positions) - path[index + 1])))
        errors.append(world.follow_error)
        torques.append(torque)
    assert max(lags) < 2e-4
    assert max(errors) < 2e-5
    accelerations = np.diff(speeds, axis=0) / settings.step_s
    expected = [dynamics.torques(path[index], speeds[index], accelerations[index]) for index in range(steps - 1)]
    # Half of the elbow's torque is that of what follows it.
    assert np.array(torques)[5:-1] == pytest.approx(np.array(expected)[5:], abs=0.5)
    assert np.max(np.abs(expected)) > 20.0


def test_a_driven_joint_is_limited_by_what_its_follower_needs(three_fingers, robot):
    dynamics = dynamics_of(three_fingers, robot)
    still = np.zeros(4)
    _, shoulder, elbow, _ = np.abs(dynamics.torques(START, still, still))
    for share, holds in ((1.2, True), (0.8, False)):
        first, second, third, fourth = robot.joints
        second = replace(second, torque_n_m=share * shoulder)
        limited = replace(robot, joints=(first, second, replace(third, torque_n_m=1.5 * elbow), fourth))
        scene = replace(three_fingers.scene, robot=limited)
        with World(scene, three_fingers.gripper, PhysicsSettings()) as world:
            world.reset_arm(START.tolist())
            for _ in range(120):
                world.command_arm(START.tolist(), STILL)
                world.step()
            positions, _, torques = world.arm_state()
            assert bool(abs(positions[1] - START[1]) < 1e-3) is holds
            assert abs(torques[1]) == pytest.approx(shoulder if holds else share * shoulder, rel=0.02)


def with_effort(robot, effort):
    """The arm whose first parallelogram, which carries the forearm, transmits an effort at most."""
    first, second = robot.followers
    return replace(robot, followers=(replace(first, effort=effort), second))


@pytest.mark.parametrize("engine", ["pybullet", "mujoco"])
@pytest.mark.parametrize(("share", "slipped"), [(1.1, ""), (0.9, "shoulder_level")])
def test_a_coupling_that_does_not_transmit_what_its_follower_needs_slips(three_fingers, robot, engine, share, slipped):
    still = np.zeros(4)
    needed = abs(float(dynamics_of(three_fingers, robot).follower_torques(START, still, still)[0]))
    assert needed > 10.0
    scene = replace(three_fingers.scene, robot=with_effort(robot, share * needed))
    if engine == "pybullet":
        opened = World(scene, three_fingers.gripper, PhysicsSettings())
    else:
        opened = mujoco_settings().open(scene, three_fingers.gripper)
    with opened as world:
        world.reset_arm(START.tolist())
        assert world.slipped_follower == ""
        for _ in range(round(0.3 * world.settings.rate_hz)):
            world.command_arm(START.tolist(), STILL)
            world.step()
        assert world.slipped_follower == slipped
        # It gives way: the forearm sinks by its own weight, against the effort of the coupling.
        assert (world.follow_error > 2e-3) is bool(slipped)
        world.reset_arm(START.tolist())
        assert (world.slipped_follower, world.follow_error) == ("", pytest.approx(0.0, abs=1e-9))


@pytest.mark.parametrize(("share", "slipped"), [(1.1, ""), (0.9, "shoulder_level")])
def test_a_gear_that_does_not_transmit_what_its_follower_needs_slips(three_fingers, robot, share, slipped):
    dynamics, still = dynamics_of(three_fingers, robot), np.zeros(4)
    needed = abs(float(dynamics.follower_torques(START, still, still)[0]))
    limited, settings = with_effort(robot, share * needed), PhysicsSettings()
    with TorqueArm(limited, three_fingers.gripper, settings, gravity_m_s2=three_fingers.scene.gravity_m_s2) as machine:
        machine.reset(START.tolist(), 0.0)
        for _ in range(round(0.3 * settings.rate_hz)):
            # Joints at rest of a rigid coupling; where it slips the arm sags.
            q, dq = machine.state()
            wanted = 1600.0 * (START - np.array(q)) - 80.0 * np.array(dq)
            machine.step(dynamics.torques(q, dq, wanted).tolist())
        assert machine.slipped_follower == slipped


def test_torques_accelerate_the_coupled_arm(three_fingers, robot):
    dynamics, rate_hz = dynamics_of(three_fingers, robot), 960.0
    wanted = np.array([0.5, -0.8, 0.6, 1.0])
    settings = PhysicsSettings(rate_hz=rate_hz)
    with TorqueArm(robot, three_fingers.gripper, settings, gravity_m_s2=three_fingers.scene.gravity_m_s2) as machine:
        machine.reset(START.tolist(), 0.0)
        for _ in range(round(0.5 * rate_hz)):
            q, dq = machine.state()
            machine.step(dynamics.torques(q, dq, wanted).tolist())
        q, dq = machine.state()
        assert machine.follow_error < 1e-4
    assert dq == pytest.approx(0.5 * wanted, abs=0.02)
    assert np.array(q) - START == pytest.approx(0.125 * wanted, abs=0.01)
    assert Arm(robot, Pose()).tool_pose(q).rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0), abs=1e-9)
