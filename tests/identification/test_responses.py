"""Measures of a response against those of the analytic first- and second-order systems."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.identification import responses
from tests.identification.recordings import recording_of

TIMES_S = np.arange(1200) / 1000
BEGIN_S = 0.1


def response_of(course, *, level=0.5):
    """Response to a step at `BEGIN_S` whose speed is `level` times a function of the time since."""
    speeds = np.where(TIMES_S >= BEGIN_S - 1e-9, level, 0.0)
    got = level * course(np.maximum(0.0, TIMES_S - BEGIN_S))
    (found,) = responses(recording_of([(TIMES_S, 0 * TIMES_S, speeds, 0 * TIMES_S, got)], noise=(0, 0)))
    return found


@pytest.mark.parametrize("level", [0.5, -0.5])
def test_a_first_order_lag(level):
    found = response_of(lambda since: 0.9 * -np.expm1(-since / 0.04), level=level)

    assert found.rise_s == pytest.approx(0.04 * np.log(9), rel=1e-3)
    assert found.overshoot == pytest.approx(0.0, abs=1e-9)
    assert found.steady_error_rad_s == pytest.approx(0.1 * level, abs=1e-6)


@pytest.mark.parametrize("damping", [0.2, 0.5])
def test_the_overshoot_of_a_second_order_system(damping):
    omega = 30.0
    damped = omega * np.sqrt(1 - damping**2)

    found = response_of(
        lambda t: (
            1 - np.exp(-damping * omega * t) * (np.cos(damped * t) + damping * omega / damped * np.sin(damped * t))
        )
    )

    assert found.overshoot == pytest.approx(np.exp(-np.pi * damping / np.sqrt(1 - damping**2)), abs=2e-3)


@pytest.mark.parametrize(
    "course",
    [
        lambda since: -np.expm1(-since / 0.5),
        lambda since: 1 - np.exp(-since) * np.cos(20.0 * since),
    ],
)
def test_a_speed_that_has_not_settled_has_no_steady_value(course):
    """By the mean of the last quarter the first would rise in three quarters of its time, and overshoot by 6 %."""
    found = response_of(course)

    assert found.rise_s is found.overshoot is found.steady_error_rad_s is None


def test_noise_does_not_count_as_a_change_of_the_steady_speed():
    noise = 0.1 * np.random.default_rng(1).standard_normal((40, len(TIMES_S)))

    settled = [response_of(lambda since, each=each: -np.expm1(-since / 0.04) + each) for each in noise]

    assert sum(each.overshoot is not None for each in settled) >= 38


def test_a_rise_between_two_samples_is_not_resolved():
    assert response_of(lambda since: (since > 0.0) * 1.0).rise_s is None


def test_the_lag_of_a_sine_that_is_late_by_a_share_of_a_sample():
    # Cycles that fill a window, so that the ends do not move the greatest correlation.
    window = np.sin(np.pi * TIMES_S / TIMES_S[-1]) ** 2
    late_s = 0.0234
    wanted = window * np.sin(2 * np.pi * 5 * TIMES_S)
    late = TIMES_S - late_s
    got = np.where(late > 0, np.sin(np.pi * late / TIMES_S[-1]) ** 2 * np.sin(2 * np.pi * 5 * late), 0.0)

    (found,) = responses(recording_of([(TIMES_S, 0 * TIMES_S, wanted, 0 * TIMES_S, got)], noise=(0, 0)))

    assert found.lag_s == pytest.approx(late_s, abs=2e-4)
    assert found.rise_s is found.overshoot is found.steady_error_rad_s is None
    assert found.rms_rad_s == pytest.approx(np.sqrt(np.mean((wanted - got) ** 2)))


def test_a_joint_that_does_not_move_has_no_rise_time():
    found = response_of(lambda since: 0 * since)

    assert found.rise_s is None
    assert found.steady_error_rad_s == pytest.approx(0.5)
