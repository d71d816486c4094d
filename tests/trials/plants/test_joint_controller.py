"""Control of the joints against the analytic response of the error, and against limits."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.physics import PhysicsSettings, TorqueArm
from rgss.trials import ControlMode, ControlSettings, JointController, JointGains, least_stable_rate_hz
from rgss.trials.plants import DynamicPlant
from rgss.trials.plants.joint_controller import control_law
from rgss.trials.reference import Reference
from rgss.trials.workcell import cell_of
from tests.fixtures.eight_states import Phase, step_of

RATE_HZ = 2000.0
OFFSET_RAD = 0.02
VELOCITY = ControlMode.VELOCITY


@pytest.fixture(scope="module")
def spec(spec_of):
    return spec_of(65)


@pytest.fixture(scope="module")
def names(spec):
    return [joint.name for joint in spec.scene.robot.joints]


@pytest.fixture(scope="module")
def followed(spec):
    """Joint angles at the start and after each step under targets (n, joints) in rad, speeds by their differences."""

    def run(controller, targets, *, start=None, rate_hz=RATE_HZ):
        cell, physics, states = cell_of(spec), PhysicsSettings(rate_hz=rate_hz), []
        targets = np.asarray(targets)
        reference = Reference(
            positions_rad=np.vstack([targets, targets[-1:]]),
            velocities_rad_s=np.diff(np.vstack([targets, targets[-1:]]), axis=0) * rate_hz,
            tool_m=cell.arm.tool_position(np.vstack([targets, targets[-1:]])),
            load_m_s2=np.zeros(len(targets)),
            arc_m=np.zeros((len(targets), 3)),
            peak_tool_speed_m_s=0.0,
            peak_tool_acceleration_m_s2=0.0,
        )
        with TorqueArm(spec.scene.robot, spec.gripper, physics, gravity_m_s2=spec.scene.gravity_m_s2) as machine:
            plant = DynamicPlant(
                machine,
                cell.arm,
                spec.scene,
                spec.gripper,
                physics,
                ControlSettings(largest_tracking_error_m=1.0),
                task=spec.task,
                controller=controller,
                checkpoint=lambda: states.append(machine.state()[0]),
            )
            plant.start(targets[0] if start is None else start)
            result = plant.move(step_of(Phase.LIFT), reference)
        assert result.metrics["joint_saturated_s"] == (0.0,) * len(targets[0])
        return np.array(states)[: len(targets)]

    return run


def response(stiffness, damping, times):
    """Share of an initial error that is left: ë + damping ė + stiffness e = 0 from rest, by its eigenvalues."""
    first, second = np.roots([1.0, damping, stiffness]).astype(complex)
    if abs(first - second) < 1e-6:
        return np.exp(-damping * times / 2) * (1.0 + damping * times / 2)
    return ((first * np.exp(second * times) - second * np.exp(first * times)) / (first - second)).real


@pytest.mark.engine
@pytest.mark.parametrize(
    ("controller", "stiffness", "damping"),
    [
        (JointController(natural_frequency_rad_s=12.0), 144.0, 24.0),
        (JointController(natural_frequency_rad_s=12.0, damping_ratio=0.3), 144.0, 7.2),
        (JointController(mode=ControlMode.POSITION, natural_frequency_rad_s=12.0, damping_ratio=2.0), 144.0, 48.0),
        (JointController(mode=VELOCITY, position_gain_1_s=6.0, velocity_gain_1_s=40.0), 240.0, 40.0),
    ],
)
def test_an_error_decays_as_its_equation_says(spec, followed, controller, stiffness, damping):
    at = np.array(spec.scene.robot.home_rad)
    steps = int(0.5 * RATE_HZ)
    angles = followed(controller, np.tile(at + OFFSET_RAD, (steps, 1)), start=at)
    left = (at + OFFSET_RAD - angles) / OFFSET_RAD
    expected = response(stiffness, damping, np.arange(steps) / RATE_HZ)
    # The command is held over a step, and the speed after it moves the joint: a lag of about one step.
    assert np.max(np.abs(left - expected[:, None])) < 2.0 * math.sqrt(stiffness) / RATE_HZ


@pytest.mark.engine
def test_a_joint_has_its_own_gains(spec, names, followed):
    own = JointGains(joint=names[2], natural_frequency_rad_s=5.0, damping_ratio=0.5)
    at = np.array(spec.scene.robot.home_rad)
    controller = JointController(natural_frequency_rad_s=12.0, joints=(own,))
    angles = followed(controller, np.tile(at + OFFSET_RAD, (1000, 1)), start=at)
    left, times = (at + OFFSET_RAD - angles) / OFFSET_RAD, np.arange(1000) / RATE_HZ
    assert left[:, 2] == pytest.approx(response(25.0, 5.0, times), abs=0.01)
    assert left[:, 3] == pytest.approx(response(144.0, 24.0, times), abs=0.02)


@pytest.mark.engine
def test_without_feed_forward_an_accelerated_joint_lags(spec, followed):
    """Under a constant acceleration a the error of a servo tends to a/k_p, that of computed torque to nothing."""
    at, acceleration = np.array(spec.scene.robot.home_rad), 0.5
    times = np.arange(int(0.6 * RATE_HZ)) / RATE_HZ
    targets = np.tile(at, (len(times), 1))
    targets[:, 5] += 0.5 * acceleration * times**2
    errors = {
        mode: (
            targets
            - followed(
                JointController(
                    mode=mode, natural_frequency_rad_s=20.0, position_gain_1_s=10.0, velocity_gain_1_s=40.0
                ),
                targets,
            )
        )[-1, 5]
        for mode in ControlMode
        if mode is not ControlMode.CALIBRATED
    }
    assert errors[ControlMode.POSITION] == pytest.approx(acceleration / 400.0, rel=0.03)
    assert errors[VELOCITY] == pytest.approx(acceleration / 400.0, rel=0.03)
    assert abs(errors[ControlMode.COMPUTED_TORQUE]) < 0.03 * acceleration / 400.0


@pytest.mark.engine
def test_pure_velocity_control_does_not_know_where_it_is(spec, followed):
    at = np.array(spec.scene.robot.home_rad)
    angles = followed(JointController(mode=VELOCITY, position_gain_1_s=0.0), np.tile(at + 0.1, (200, 1)), start=at)
    assert angles[-1] == pytest.approx(at, abs=1e-6)


def test_a_commanded_velocity_is_within_the_speed_of_the_joint(spec):
    joints = spec.scene.robot.joints
    law = control_law(
        JointController(mode=VELOCITY, position_gain_1_s=1000.0, velocity_gain_1_s=1.0), joints, step_s=1e-3
    )
    zeros = np.zeros(len(joints))
    wanted = law(np.ones(len(joints)), zeros, zeros, zeros, zeros)
    assert wanted == pytest.approx([joint.speed_rad_s for joint in joints])


@pytest.mark.parametrize(
    "controller",
    [
        JointController(),
        JointController(natural_frequency_rad_s=300.0, damping_ratio=0.2),
        JointController(mode=VELOCITY, position_gain_1_s=90.0, velocity_gain_1_s=200.0),
    ],
)
def test_the_error_grows_below_the_least_stable_rate(spec, controller):
    joint = spec.scene.robot.joints[0]
    law, zero = control_law(controller, [joint], step_s=1e-3), np.zeros(1)

    def left(rate_hz):
        q, dq = np.array([-1e-6]), np.zeros(1)
        for _ in range(4000):
            dq = dq + law(zero, zero, zero, q, dq) / rate_hz
            q = q + dq / rate_hz
            if abs(q[0]) > 1e-3:
                break
        return abs(q[0])

    least_hz = least_stable_rate_hz(controller, [joint.name])
    assert left(1.02 * least_hz) < 1e-6
    assert left(0.98 * least_hz) > 1e-4
