"""The force that a finger's sensor reads: an impulse over a stated window, whatever the step."""

from __future__ import annotations

import math

import pytest

from rgss.trials.monitors.force_sensor import ForceSensor

RATES_HZ = (120.0, 240.0, 333.0, 500.0, 1000.0, 4000.0)
WINDOW_S = 0.01


def peak_of(forces_n, rate_hz, window_s=WINDOW_S):
    sensor = ForceSensor(window_s, rate_hz)
    for force in forces_n:
        sensor.note((force, 0.0))
    return sensor.peak_n


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_a_lasting_force_reads_itself(rate_hz):
    assert peak_of([7.0] * 200, rate_hz) == pytest.approx(7.0, rel=1e-12)


@pytest.mark.parametrize("rate_hz", RATES_HZ)
def test_a_blow_within_one_step_reads_its_impulse_over_the_window(rate_hz):
    """M v in one step is a force that grows with the rate: 19 N at 120 Hz, 640 N at 4 kHz."""
    impulse_n_s = 0.4 * 0.4
    assert peak_of([0.0, impulse_n_s * rate_hz, 0.0, 0.0], rate_hz) == pytest.approx(impulse_n_s / WINDOW_S, rel=1e-12)


@pytest.mark.parametrize(("duration_s", "error"), [(0.004, 0.01), (0.03, 0.02)])
def test_a_half_sine_converges_to_its_greatest_average(duration_s, error):
    rate_hz, height_n = 4000.0, 50.0
    steps = round(duration_s * rate_hz)
    forces = [height_n * math.sin(math.pi * (step + 0.5) / steps) for step in range(steps)]
    within = min(WINDOW_S, duration_s)
    average = height_n * (2 * duration_s / math.pi) * math.sin(math.pi * within / (2 * duration_s)) / WINDOW_S
    assert peak_of([*forces, *[0.0] * 50], rate_hz) == pytest.approx(average, rel=error)


def test_the_peak_is_that_of_one_finger_and_may_come_after_its_greatest_force():
    sensor = ForceSensor(0.01, 300.0)  # three steps
    for forces in ((9.0, 1.0), (0.0, 8.0), (0.0, 8.0), (0.0, 2.0)):
        sensor.note(forces)
    assert sensor.peak_n == pytest.approx(6.0)


def test_a_restart_keeps_what_is_in_the_window():
    sensor = ForceSensor(0.01, 300.0)
    sensor.note((9.0,))
    sensor.note((9.0,))
    sensor.restart()
    assert sensor.peak_n == 0.0
    sensor.note((3.0,))
    assert sensor.peak_n == pytest.approx(7.0)


def test_an_emptied_window_begins_anew():
    sensor = ForceSensor(0.01, 300.0)
    sensor.note((9.0,))
    sensor.clear()
    sensor.restart()
    sensor.note((3.0,))
    assert sensor.peak_n == pytest.approx(1.0)


def test_a_window_shorter_than_a_step_is_that_step():
    assert peak_of([5.0, 1.0], 100.0, window_s=0.001) == 5.0
