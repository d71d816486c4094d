"""Known servos are recovered from noisy recordings, and what a recording cannot tell is said."""

from __future__ import annotations

from dataclasses import asdict

import numpy as np
import pytest

from rgss.errors import DefinitionError
from rgss.identification import CommandedPositions, FitStatus, fit_joint
from rgss.identification.servo_problem import ServoProblem
from rgss.scenes import JointServo, ServoControl
from tests.identification.recordings import NOISE_RAD, NOISE_RAD_S, motions_of, recording_of

SERVO = JointServo(velocity_gain_hz=30, position_gain_hz2=400, delay_s=0.0137, viscous_hz=3, coulomb_rad_s2=1.5)


@pytest.mark.slow
@pytest.mark.parametrize("control", list(ServoControl))
def test_known_gains_are_recovered_within_five_percent(control):
    motions = motions_of(SERVO, (0.15, 0.6, 1.2), velocity_control=control is ServoControl.VELOCITY)

    fit = fit_joint(recording_of(motions, control=control), "j1")

    found = fit.determined()
    expected = {name: value for name, value in asdict(SERVO).items() if name in found}
    assert len(found) == (5 if control is ServoControl.POSITION else 4)
    assert found == pytest.approx(expected, rel=0.05)
    assert fit.adequate
    assert fit.rms_rad_s["p"] == pytest.approx(0.01, rel=0.1)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("control", "noise", "rest_s"),
    [
        (ServoControl.VELOCITY, (NOISE_RAD, NOISE_RAD_S), 0.05),
        # Few samples and much noise say where a segment starts.
        (ServoControl.POSITION, (0.005, 0.01), 0.02),
    ],
)
def test_intervals_contain_the_true_values_nineteen_times_in_twenty(control, noise, rest_s):
    by_speed = control is ServoControl.VELOCITY
    motions = motions_of(SERVO, (0.3, 1.0), velocity_control=by_speed, hold_s=0.15, rest_s=rest_s, rate_hz=100)
    repeats = 16

    hits, errors, widths = {}, {}, {}
    for seed in range(repeats):
        fit = fit_joint(recording_of(motions, control=control, seed=seed, noise=noise), "j1")
        for each in (each for each in fit.parameters if each.interval is not None):
            low, high = each.interval
            true = getattr(SERVO, each.name)
            hits[each.name] = hits.get(each.name, 0) + (low <= true <= high)
            errors.setdefault(each.name, []).append(each.value - true)
            widths.setdefault(each.name, []).append((high - low) / 2)

    # With 95 % fewer than 12 hits have a probability below one in a thousand.
    assert len(hits) == (4 if by_speed else 5)
    assert all(count >= 12 for count in hits.values()), hits
    # Nor are they wide for safety: the deviation of 16 estimates is from 0.55 to 1.5 times the true one, 999 times in
    # 1000 (chi-squared with 15 degrees of freedom).
    for name, width in widths.items():
        assert 1 / 1.5 < np.mean(width) / (1.96 * np.std(errors[name], ddof=1)) < 1 / 0.55, name


def test_derivatives_of_an_interval_do_not_depend_on_which_side_of_a_sample_a_step_arrives():
    """The first sample behind the arrival tells most of the delay, and the one before it nothing."""
    motions = motions_of(SERVO, (0.3, 1.0), hold_s=0.15, rest_s=0.05, rate_hz=100)
    problem = ServoProblem(recording_of(motions, noise=(0.0, 0.0)).segments, ServoControl.VELOCITY)
    delay = problem.names.index("delay_s")
    sides = [np.array([30.0, delay_s, 3.0, 1.5]) for delay_s in (0.01999, 0.02001)]
    deviations = np.array([0.3, 5e-4, 0.1, 0.03])

    points = [np.linalg.norm(problem.jacobian(values)[:, delay]) for values in sides]
    means = [np.linalg.norm(problem.slopes(values, deviations)[:, delay]) for values in sides]

    assert max(points) > 1.2 * min(points)
    assert max(means) < 1.02 * min(means)


def test_a_start_in_motion_is_fitted_since_its_speed_is_measured_with_noise():
    """Such a segment would begin with the speed of its first sample, and the error would last for 1 / k_v."""
    motions = [
        tuple(values[18:] for values in motion) for motion in motions_of(SERVO, (0.3, 1.0), hold_s=0.15, rest_s=0.05)
    ]
    for *_, speeds in motions:
        speeds[0] += 0.1

    fit = fit_joint(recording_of(motions, noise=(0.0, 1e-4)), "j1")

    assert fit.adequate
    assert fit.servo.delay_s == pytest.approx(SERVO.delay_s, rel=0.01)
    assert fit.servo.viscous_hz == pytest.approx(SERVO.viscous_hz, rel=0.01)


@pytest.mark.slow
@pytest.mark.parametrize("commands", list(CommandedPositions))
def test_set_points_that_are_held_or_interpolated_bias_no_parameter(commands):
    is_interpolated = commands is CommandedPositions.INTERPOLATED
    motions = motions_of(SERVO, (0.15, 0.6, 1.2), velocity_control=False, is_interpolated=is_interpolated)

    fit = fit_joint(recording_of(motions, control=ServoControl.POSITION, commands=commands, noise=(5e-5, 1e-3)), "j1")

    # Half a period of the other course is k_p / 400 Hz = 1 per second of viscous friction.
    assert fit.determined() == pytest.approx(asdict(SERVO), rel=0.02)


def test_velocity_control_says_nothing_of_the_position_gain():
    fit = fit_joint(recording_of(motions_of(SERVO, (0.5,))), "j1")

    gain = next(each for each in fit.parameters if each.name == "position_gain_hz2")
    assert (gain.status, gain.value) == (FitStatus.ABSENT, None)
    assert "no effect" in gain.reason


def test_one_speed_with_noise_does_not_tell_viscous_from_coulomb_friction():
    motions = motions_of(SERVO, (0.5,), hold_s=0.3)

    fit = fit_joint(recording_of(motions, noise=(0.0005, 0.05)), "j1")

    found = {each.name: each for each in fit.parameters}
    assert found["viscous_hz"].status is FitStatus.UNDETERMINED
    assert "does not tell it from coulomb_friction" in found["viscous_hz"].reason
    assert found["velocity_gain_hz"].status is FitStatus.DETERMINED
    assert "viscous_hz" not in fit.determined()


def test_a_servo_without_friction_has_none_that_is_distinguishable_from_zero():
    fit = fit_joint(recording_of(motions_of(JointServo(velocity_gain_hz=30, delay_s=0.01))), "j1")

    status = {each.name: each.status for each in fit.parameters}
    assert status["coulomb_rad_s2"] is not FitStatus.DETERMINED
    assert status["viscous_hz"] is not FitStatus.DETERMINED


def test_motion_that_the_model_misses_is_reported():
    (motion,) = motions_of(JointServo(velocity_gain_hz=60), (1.0,))
    times_s, target, speeds, q, v = motion
    bounded = np.zeros_like(v)
    for index in range(1, len(v)):  # an acceleration limit in place of a first-order lag
        bounded[index] = bounded[index - 1] + np.clip(speeds[index - 1] - bounded[index - 1], -0.03, 0.03)

    fit = fit_joint(recording_of([(times_s, target, speeds, q, bounded)]), "j1")

    assert not fit.adequate


@pytest.mark.parametrize(("wave", "adequate"), [(0.0, True), (0.006, False)])
def test_a_slow_deviation_within_the_noise_is_reported(wave, adequate):
    """Neighbouring residuals correlate by less than 0.1 only, but those far apart do too."""
    generator = np.random.default_rng(4)
    motions = []
    for times_s, target, speeds, q, v in motions_of(JointServo(velocity_gain_hz=60, coulomb_rad_s2=0.5), (0.5, 1.0)):
        measured = v + 0.01 * generator.standard_normal(len(v)) + wave * np.sin(12.0 * times_s)
        motions.append((times_s, target, speeds, q, measured))

    fit = fit_joint(recording_of(motions), "j1")

    assert abs(fit.autocorrelation) < 0.2
    assert fit.adequate is adequate


def test_a_joint_that_never_moves_is_refused():
    with pytest.raises(DefinitionError, match="no motion of joint 'j2'"):
        fit_joint(recording_of(motions_of(SERVO, (0.5,))), "j2")
