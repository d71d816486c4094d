"""The model of a servo against the analytic responses of first and second order."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.identification import CommandedPositions, motion_of_servos, servo_motion
from rgss.identification.motion_of_servos import ServoCommands, servo_motions
from rgss.scenes import JointServo
from tests.identification.recordings import course_of, euler_motion


def test_speed_follows_a_step_as_a_first_order_lag_with_delay():
    times_s = np.arange(400) / 1000
    gain, viscous, delay_s = 30.0, 4.0, 0.0125
    servo = JointServo(velocity_gain_hz=gain, viscous_hz=viscous, delay_s=delay_s)
    speeds = np.where(times_s >= 0.05, 0.7, 0.0)

    found = servo_motion([servo], times_s, np.zeros(400), speeds).velocities_rad_s[0]

    since_s = np.maximum(0.0, times_s - 0.05 - delay_s)
    expected = 0.7 * gain / (gain + viscous) * -np.expm1(-(gain + viscous) * since_s)
    # The step in which the delayed command arrives has the mean command.
    assert np.abs(found - expected).max() < 1e-4


@pytest.mark.parametrize("damping", [0.3, 0.7])
def test_position_follows_a_step_as_a_second_order_system(damping):
    omega = 20.0
    times_s = np.arange(600) / 1000
    servo = JointServo(velocity_gain_hz=2 * damping * omega, position_gain_hz2=omega**2)

    found = servo_motion([servo], times_s, np.ones(600), np.zeros(600)).positions_rad[0]

    damped = omega * np.sqrt(1 - damping**2)
    phase = damped * times_s
    expected = 1 - np.exp(-damping * omega * times_s) * (np.cos(phase) + damping * omega / damped * np.sin(phase))
    assert np.abs(found - expected).max() < 2e-4
    assert found.max() - 1 == pytest.approx(np.exp(-np.pi * damping / np.sqrt(1 - damping**2)), abs=2e-3)


def test_coulomb_friction_stops_a_joint_at_the_time_of_constant_braking_and_holds_it():
    times_s = np.arange(1000) / 1000
    servo = JointServo(velocity_gain_hz=1e-6, coulomb_rad_s2=2.0)

    motion = servo_motion([servo], times_s, np.zeros(1000), np.zeros(1000), start=(0.0, 1.0))

    assert motion.positions_rad[0, -1] == pytest.approx(0.25, abs=1e-3)  # v²/(2c)
    assert np.flatnonzero(motion.velocities_rad_s[0] == 0.0)[0] == pytest.approx(500, abs=1)
    assert np.all(motion.velocities_rad_s[0, 502:] == 0.0)


@pytest.mark.parametrize("commands", list(CommandedPositions))
def test_all_effects_together_agree_with_fine_explicit_steps(commands):
    servo = JointServo(velocity_gain_hz=25, position_gain_hz2=300, delay_s=0.0113, viscous_hz=2, coulomb_rad_s2=1.5)
    times_s, positions, velocities = course_of(0.5)

    motion = servo_motion([servo], times_s, positions, velocities, commands=commands)

    is_interpolated = commands is CommandedPositions.INTERPOLATED
    q, v = euler_motion(servo, times_s, positions, velocities, is_interpolated=is_interpolated)
    assert np.abs(motion.velocities_rad_s[0] - v).max() < 3e-3
    assert np.abs(motion.positions_rad[0] - q).max() < 2e-4


@pytest.mark.parametrize("change", [{"velocity_gain_hz": 0.0}, {"delay_s": -1e-3}, {"coulomb_rad_s2": -1.0}])
def test_impossible_parameters_are_refused(change):
    with pytest.raises(DefinitionError, match="must"):
        JointServo(**{"velocity_gain_hz": 1.0, **change})


@pytest.mark.parametrize("commands", list(CommandedPositions))
@pytest.mark.parametrize("most_values", [2_000_000, 1000])
def test_series_that_are_solved_together_are_those_solved_alone(commands, most_values, monkeypatch):
    """Whatever their lengths and sampling rates, bit for bit, in one batch and in several."""
    monkeypatch.setattr(motion_of_servos, "_MOST_VALUES", most_values)
    servos = [
        JointServo(velocity_gain_hz=30, position_gain_hz2=400, delay_s=0.0137, viscous_hz=3, coulomb_rad_s2=1.5),
        JointServo(velocity_gain_hz=5, delay_s=0.04),
    ]
    given = []
    for samples, rate_hz in ((40, 100.0), (90, 250.0), (7, 100.0)):
        times_s = 3.0 + np.arange(samples) / rate_hz
        speeds = np.sin(9.0 * times_s)
        start = (np.array([0.1, 0.2]), 0.3)
        given.append(ServoCommands(times_s=times_s, commanded_rad=speeds / 9.0, commanded_rad_s=speeds, start=start))

    together = servo_motions(servos, given, commands=commands)

    for one, found in zip(given, together, strict=True):
        alone = servo_motion(
            servos, one.times_s, one.commanded_rad, one.commanded_rad_s, start=one.start, commands=commands
        )
        assert found.positions_rad.shape == (2, len(one.times_s))
        assert np.array_equal(found.positions_rad, alone.positions_rad)
        assert np.array_equal(found.velocities_rad_s, alone.velocities_rad_s)
