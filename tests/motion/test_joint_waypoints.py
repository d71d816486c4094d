"""Timing by joint waypoints against closed-form times and difference quotients of what runs."""

from __future__ import annotations

import math
from itertools import pairwise

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.motion import (
    JointPath,
    MotionLimits,
    TimingOutcome,
    time_move_by_joint_waypoints,
    time_move_by_trapezoids,
)

pytestmark = pytest.mark.engine

RESOLUTION = 0.02
FREE = 1e6
START = np.array([0.0, -1.2, 1.4, -1.5, -1.5, 0.0])


@pytest.fixture
def timed(anything, arm, limits):
    def run(points, *, validity=anything, **changes):
        kept = limits(**changes)
        return time_move_by_joint_waypoints(JointPath(points), validity, arm, kept, resolution_rad=RESOLUTION)

    return run


def alone_s(turn, speed, acceleration):
    """Time of one joint alone from rest to rest."""
    if turn <= speed**2 / acceleration:
        return 2.0 * math.sqrt(turn / acceleration)
    return turn / speed + speed / acceleration


def test_each_joint_has_its_own_time_and_waits_for_the_slowest(timed, limits):
    turns = np.array([1.0, -0.4, 0.7, 0.0, 0.05, -2.0])
    kept = limits(FREE)
    expected = [alone_s(*of) for of in zip(np.abs(turns), kept.speed_rad_s, kept.acceleration_rad_s2, strict=True)]

    trajectory = timed(np.array([START, START + turns]), tool_speed_m_s=FREE).trajectory

    assert trajectory.duration_s == pytest.approx(max(expected), rel=1e-12)
    times = np.linspace(0.0, trajectory.duration_s, 20_001)
    left = np.abs(trajectory.positions(times) - (START + turns))
    for joint, time_s in enumerate(expected):
        arrived = times[np.argmax(left[:, joint] < 1e-9)]
        assert arrived == pytest.approx(time_s, abs=3e-4)
    # A joint alone is half way after half of its time.
    halves = trajectory.positions(np.array(expected) / 2.0)
    assert np.diag(halves) == pytest.approx(START + turns / 2.0, abs=1e-12)


@pytest.mark.parametrize("tool", [(FREE, math.inf), (0.5, 1.2)])
def test_no_limit_is_exceeded(timed, arm, limits, polylines, tool):
    kept, step = limits(*tool), 1e-4
    for points in polylines(4, seed=6):
        move = timed(points, tool_speed_m_s=tool[0], tool_acceleration_m_s2=tool[1])
        trajectory = move.trajectory
        assert move.stops == len(points) - 2
        times = np.linspace(step, trajectory.duration_s - step, 4001)
        before, at, after = (trajectory.positions(times + shift) for shift in (-step, 0.0, step))
        assert np.max(np.abs(after - before) / (2 * step) / kept.speed_rad_s) <= 1.0 + 1e-6
        assert np.max(np.abs(after - 2 * at + before) / step**2 / kept.acceleration_rad_s2) <= 1.0 + 1e-4
        tool_m = [arm.tool_position(one) for one in (before, at, after)]
        speeds = np.linalg.norm(tool_m[2] - tool_m[0], axis=1) / (2 * step)
        accelerations = np.linalg.norm(tool_m[2] - 2 * tool_m[1] + tool_m[0], axis=1) / step**2
        assert np.max(speeds) <= min(tool[0], trajectory.peak_tool_speed_m_s) * (1.0 + 1e-3)
        assert np.max(accelerations) <= min(tool[1], trajectory.peak_tool_acceleration_m_s2) * (1.0 + 1e-2)


def test_a_joint_that_moves_by_rounding_noise_slows_no_other(timed):
    """With a profile of its own it would accelerate at its limit, and the tool would be slowed for it."""
    turns = np.array([0.0, 0.1, 0.12, -0.22, 0.0, 0.0])
    noise = np.array([2.2e-16, 0.0, 0.0, 0.0, 0.0, 1.1e-16])

    exact = timed(np.array([START, START + turns])).trajectory
    noisy = timed(np.array([START, START + turns + noise, START + turns])).trajectory

    assert noisy.duration_s == pytest.approx(exact.duration_s, rel=1e-12)


def test_it_rests_at_each_waypoint(timed, polylines):
    points = polylines(1, seed=8)[0]
    trajectory = timed(points).trajectory
    stops = trajectory.path.breaks[list(trajectory.path.stops)]

    assert trajectory.positions(stops) == pytest.approx(points, abs=1e-12)
    around = trajectory.positions(stops[1:-1] + 1e-5) - trajectory.positions(stops[1:-1] - 1e-5)
    assert np.max(np.abs(around)) < 1e-8
    assert trajectory.positions([-1.0, trajectory.duration_s + 1.0]) == pytest.approx(points[[0, -1]])


class Chord:
    """Only what is near the straight line between two configurations is valid."""

    def __init__(self, start, end, width):
        self.start, self.way, self.width = start, end - start, width

    def is_valid(self, q):
        from_start = np.array(q) - self.start
        along = from_start @ self.way / (self.way @ self.way)
        return bool(np.linalg.norm(from_start - along * self.way) <= self.width)


def test_where_the_joints_own_ways_collide_they_share_one_profile(timed, anything, arm, limits):
    end = START + np.array([1.0, 0.1, 0.0, 0.0, 0.0, 0.0])
    points = np.array([START, end, end + np.array([0.0, 0.3, 0.2, 0.0, 0.0, 0.0])])
    shared = time_move_by_trapezoids(JointPath(points[:2]), anything, arm, limits(FREE), resolution_rad=RESOLUTION)

    own = timed(points[:2], tool_speed_m_s=FREE).trajectory
    narrow = timed(points[:2], validity=Chord(START, end, 1e-6), tool_speed_m_s=FREE).trajectory

    middle = own.positions(np.linspace(0.0, own.duration_s, 50))
    assert not all(Chord(START, end, 1e-3).is_valid(q) for q in middle)
    assert narrow.duration_s == pytest.approx(shared.trajectory.duration_s, rel=1e-9)
    assert all(Chord(START, end, 1e-9).is_valid(q) for q in narrow.positions(np.linspace(0.0, narrow.duration_s, 50)))
    # Nothing on the straight line is valid either.
    move = timed(points, validity=Chord(START, end, 1e-6), tool_speed_m_s=FREE)
    assert (move.outcome, move.trajectory) == (TimingOutcome.IN_COLLISION, None)


def test_a_path_of_no_length_takes_no_time(timed):
    move = timed(np.array([START, START]))

    assert (move.outcome, move.trajectory.duration_s) == (TimingOutcome.TIMED, 0.0)
    assert move.trajectory.positions([0.0, 1.0]) == pytest.approx(np.array([START, START]))


def test_the_same_path_has_the_same_timing(timed, polylines):
    points = polylines(1, seed=9)[0]
    one, other = (timed(points).trajectory for _ in range(2))

    assert np.array_equal(one.path.coefficients, other.path.coefficients)
    assert all(later > earlier for earlier, later in pairwise(one.path.breaks))


def test_limits_for_other_joints(anything, arm):
    limits = MotionLimits(speed_rad_s=(1.0,) * 5, acceleration_rad_s2=(1.0,) * 5, tool_speed_m_s=1.0)
    with pytest.raises(MotionError, match="the limits must be for 6 joints, those of the path, got limits for 5"):
        time_move_by_joint_waypoints(
            JointPath(np.array([START, START + 0.1])), anything, arm, limits, resolution_rad=RESOLUTION
        )
