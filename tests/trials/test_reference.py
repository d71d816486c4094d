"""A timed move as targets of physics steps, against trajectories that can be solved on paper."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest

from rgss.trials.reference import reference_of

STEP_S = 1 / 240
GRAVITY = 9.81


@dataclass(frozen=True)
class Scaled:
    """All joints follow one function of time."""

    duration_s: float
    angle_at: Any

    def positions(self, times_s):
        angles = self.angle_at(np.asarray(times_s))
        return np.repeat(angles[:, None], 6, axis=1)


class Slider:
    """The first joint moves the tool along x, one metre for each radian."""

    def tool_position(self, configurations_rad):
        positions = np.zeros((len(configurations_rad), 3))
        positions[:, 0] = configurations_rad[:, 0]
        return positions


@dataclass(frozen=True)
class Crank:
    """The first joint turns the tool in a horizontal circle."""

    radius_m: float

    def tool_position(self, configurations_rad):
        angle = configurations_rad[:, 0]
        return self.radius_m * np.column_stack([np.cos(angle), np.sin(angle), np.zeros(len(angle))])


def least_jerk(distance, duration_s):
    def angle_at(times):
        s = times / duration_s
        return distance * s**3 * (10 + s * (6 * s - 15))

    return Scaled(duration_s, angle_at)


def referenced(trajectory, tool):
    return reference_of(trajectory, tool, step_s=STEP_S, gravity_m_s2=GRAVITY)


def test_a_move_of_least_jerk_has_the_peaks_of_the_textbook():
    reference = referenced(least_jerk(1.2, 2.0), Slider())

    assert reference.steps == 480
    assert reference.peak_tool_speed_m_s == pytest.approx(15 / 8 * 1.2 / 2.0, rel=1e-4)
    assert reference.peak_tool_acceleration_m_s2 == pytest.approx(10 / math.sqrt(3) * 1.2 / 2.0**2, rel=1e-3)


def test_positions_are_those_at_the_ends_of_the_steps_and_velocities_lead_from_one_to_the_next():
    reference = referenced(least_jerk(1.2, 2.0), Slider())
    times = np.arange(481) * STEP_S

    assert reference.positions_rad[:, 3] == pytest.approx(least_jerk(1.2, 2.0).angle_at(times), abs=1e-12)
    reached = reference.positions_rad[:-1] + reference.velocities_rad_s * STEP_S
    assert reached == pytest.approx(reference.positions_rad[1:], abs=1e-12)
    assert reference.tool_m[:, 0] == pytest.approx(reference.positions_rad[:, 0])
    assert reference.positions_rad.shape == (481, 6)
    assert reference.tool_m.shape == (481, 3)
    assert reference.load_m_s2.shape == (480,)


def test_the_load_of_an_even_turn_is_gravity_and_the_centripetal_acceleration():
    speed_rad_s, radius_m = 2.0, 0.5
    reference = referenced(Scaled(3.0, lambda times: speed_rad_s * times), Crank(radius_m))

    inside = reference.load_m_s2[1:-1]
    assert inside == pytest.approx(math.hypot(radius_m * speed_rad_s**2, GRAVITY), rel=1e-4)


def test_the_load_at_rest_is_gravity():
    reference = referenced(Scaled(0.5, np.zeros_like), Slider())

    assert reference.load_m_s2 == pytest.approx(GRAVITY)
    assert reference.peak_tool_speed_m_s == 0.0


def test_a_motion_that_starts_with_a_jump_of_speed_shows_it_as_acceleration():
    reference = referenced(Scaled(1.0, lambda times: 0.3 * times), Slider())

    assert reference.peak_tool_acceleration_m_s2 == pytest.approx(0.3 / STEP_S)
    assert reference.load_m_s2[0] == pytest.approx(math.hypot(0.3 / STEP_S, GRAVITY))
    assert reference.load_m_s2[1:] == pytest.approx(GRAVITY)


@pytest.mark.parametrize(
    ("duration_s", "steps"),
    [(0.0, 1), (1e-6, 1), (STEP_S, 1), (1.0, 240), (1.0 + 1e-12, 240), (1.0 + 1e-3, 241), (7 * STEP_S, 7)],
)
def test_a_move_takes_as_many_steps_as_hold_it(duration_s, steps):
    reference = referenced(Scaled(duration_s, lambda times: 0.1 * times), Slider())

    assert reference.steps == steps
    assert reference.positions_rad[-1, 0] == pytest.approx(0.1 * duration_s)


def test_the_last_step_ends_where_the_trajectory_ends():
    reference = referenced(least_jerk(0.8, 0.999), Slider())

    assert reference.tool_m[0, 0] == 0.0
    assert reference.tool_m[-1, 0] == pytest.approx(0.8, abs=1e-12)
