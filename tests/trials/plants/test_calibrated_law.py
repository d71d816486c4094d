"""Calibrated servos in a plant: against fine explicit steps of the servo's equation, and their stability by trying."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.scenes import JointServo, ServoControl
from rgss.trials import ControlMode, JointController, is_stable
from rgss.trials.plants.calibrated_law import CalibratedLaw
from rgss.trials.plants.joint_controller import control_law

RATE_HZ = 240.0
STEP_S = 1.0 / RATE_HZ
SERVOS = (
    JointServo(velocity_gain_hz=25.0, position_gain_hz2=300.0, delay_s=0.0113, viscous_hz=2.0, coulomb_rad_s2=0.8),
    JointServo(velocity_gain_hz=60.0, position_gain_hz2=900.0, delay_s=0.001),
    JointServo(velocity_gain_hz=40.0, position_gain_hz2=500.0, delay_s=3 * STEP_S, viscous_hz=1.0),
)


def course(seconds=1.0):
    """Positions and speeds of a smooth move of a radian at the commands' rate, at rest before and after it."""
    times = np.arange(0.0, seconds, STEP_S)
    phase = np.clip((times - 0.2) / 0.5, 0.0, 1.0)
    return phase**3 * (10 - 15 * phase + 6 * phase**2)


def driven(law, positions, joints):
    """Positions of joints that the law accelerates, stepped as the physics engine does; shape (steps + 1, joints)."""
    speeds = np.concatenate([[0.0], np.diff(positions) / STEP_S, [0.0]])
    q, dq, found = np.zeros(joints), np.zeros(joints), [np.zeros(joints)]
    for index, position in enumerate(positions):
        ahead = np.full(joints, (speeds[index + 1] - speeds[index]) / STEP_S)
        acceleration = law(np.full(joints, position), np.full(joints, speeds[index]), ahead, q, dq)
        dq = dq + STEP_S * acceleration
        q = q + STEP_S * dq
        found.append(q)
    return np.array(found)


def explicit(servo, positions, *, pieces=400, gain_1_s=None):
    """The servo's equation by explicit steps of 1/pieces of a command's; with a gain, under velocity control."""
    dt = STEP_S / pieces
    late = round(servo.delay_s / dt)
    speeds = np.concatenate([np.diff(positions) / STEP_S, [0.0]])
    q = v = 0.0
    sent = [(0.0, 0.0)] * (late + 1)
    found = [0.0]
    for index, position in enumerate(positions):
        commanded = speeds[index] + (0.0 if gain_1_s is None else gain_1_s * (position - q))
        for piece in range(pieces):
            sent.append((position + speeds[index] * piece * dt, commanded))
            target, speed = sent[-1 - late]
            stiffness = servo.position_gain_hz2 if gain_1_s is None else 0.0
            force = stiffness * (target - q) + servo.velocity_gain_hz * (speed - v) - servo.viscous_hz * v
            if v == 0.0 and abs(force) <= servo.coulomb_rad_s2:
                continue
            after = v + dt * (force - servo.coulomb_rad_s2 * np.sign(v if v else force))
            v = 0.0 if v * after < 0.0 else after
            q += dt * v
        found.append(q)
    return np.array(found)


@pytest.mark.parametrize("servo", SERVOS)
@pytest.mark.parametrize("gain_1_s", [None, 6.0])
def test_a_joint_moves_as_the_equation_of_its_servo_says(servo, gain_1_s):
    control = ServoControl.POSITION if gain_1_s is None else ServoControl.VELOCITY
    law = CalibratedLaw(
        [servo],
        np.array([np.inf]),
        control=control,
        position_gain_1_s=np.array([gain_1_s or 0.0]),
        step_s=STEP_S,
    )

    found = driven(law, course(), 1)[:, 0]

    # Semi-implicit steps at 240 Hz put a joint up to half a step ahead: 1/480 s of at most 3.75 rad/s.
    assert np.abs(found - explicit(servo, course(), gain_1_s=gain_1_s)).max() < 6e-3
    assert found[-1] == pytest.approx(1.0, abs=0.05)


def test_a_delay_shifts_the_motion_by_itself_even_if_it_is_no_multiple_of_the_step():
    at_once, late = (
        CalibratedLaw(
            [JointServo(velocity_gain_hz=60.0, position_gain_hz2=900.0, delay_s=delay_s)],
            np.array([np.inf]),
            control=ServoControl.POSITION,
            position_gain_1_s=np.zeros(1),
            step_s=STEP_S,
        )
        for delay_s in (STEP_S, 4.3 * STEP_S)
    )
    times = STEP_S * np.arange(len(course()) + 1)

    first, second = (driven(law, course(), 1)[:, 0] for law in (at_once, late))

    shifted = np.interp(times - 3.3 * STEP_S, times, first)
    assert np.abs(second - shifted).max() < 1e-3
    assert np.abs(second - first).max() > 0.02


def test_joints_keep_their_own_delays():
    alone = [
        driven(
            CalibratedLaw(
                [servo],
                np.array([np.inf]),
                control=ServoControl.POSITION,
                position_gain_1_s=np.zeros(1),
                step_s=STEP_S,
            ),
            course(),
            1,
        )[:, 0]
        for servo in SERVOS
    ]
    together = CalibratedLaw(
        SERVOS, np.full(3, np.inf), control=ServoControl.POSITION, position_gain_1_s=np.zeros(3), step_s=STEP_S
    )

    assert np.array_equal(driven(together, course(), 3), np.array(alone).T)


@pytest.mark.parametrize("seed", range(12))
def test_what_is_called_stable_decays_and_the_other_grows(seed):
    random = np.random.default_rng(seed)
    servo = JointServo(
        velocity_gain_hz=float(random.uniform(5.0, 200.0)),
        position_gain_hz2=float(random.uniform(10.0, 4e4)),
        delay_s=float(random.uniform(0.0, 0.05)),
        viscous_hz=float(random.uniform(0.0, 5.0)),
    )
    control = (ServoControl.POSITION, ServoControl.VELOCITY)[seed % 2]
    gain_1_s = float(random.uniform(1.0, 120.0))
    law = CalibratedLaw(
        [servo], np.array([np.inf]), control=control, position_gain_1_s=np.array([gain_1_s]), step_s=STEP_S
    )
    q, dq = np.zeros(1), np.zeros(1)
    sizes = []
    for _ in range(3000):
        acceleration = law(np.ones(1), np.zeros(1), np.zeros(1), q, dq)
        dq = dq + STEP_S * acceleration
        q = q + STEP_S * dq
        sizes.append(abs(float(q[0]) - 1.0))
        if sizes[-1] > 1e6:
            break

    decays = max(sizes[-200:]) < 1e-2

    assert decays == is_stable(servo, control=control, position_gain_1_s=gain_1_s, step_s=STEP_S)


def test_the_mode_without_a_calibration_is_refused(shipped):
    with pytest.raises(DefinitionError, match="needs a servo of every joint"):
        control_law(JointController(mode=ControlMode.CALIBRATED), shipped.scene.robot.joints, step_s=STEP_S)
