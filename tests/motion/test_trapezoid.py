"""Trapezoidal profiles against closed-form times, integration, and dense sampling."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.motion import (
    JointPath,
    MotionLimits,
    TimingOutcome,
    blend,
    time_move,
    time_move_by_trapezoids,
    trapezoidal_trajectory,
)

pytestmark = pytest.mark.engine

RESOLUTION = 0.02
RATE_HZ = 10_000
FREE = 1e6
TOOL_DIVISOR = 40


@pytest.fixture
def timed(anything, arm, limits):
    def run(points, *, validity=anything, is_curve=False, **changes):
        return time_move_by_trapezoids(
            JointPath(points), validity, arm, limits(**changes), resolution_rad=RESOLUTION, is_curve=is_curve
        )

    return run


def sampled(trajectory):
    """Joint angles, speeds and accelerations at 10 kHz, on both sides of each knot, by the path's derivatives."""
    times = np.arange(0.0, trajectory.duration_s, 1.0 / RATE_HZ)
    around = [trajectory.times_s[1:] - 1e-6, trajectory.times_s[:-1] + 1e-6, trajectory.times_s[-1:]]
    times = np.unique(np.clip(np.concatenate([times, *around]), 0.0, trajectory.duration_s))
    knot = np.clip(np.searchsorted(trajectory.times_s, times, side="right") - 1, 0, len(trajectory.times_s) - 2)
    span, since = np.diff(trajectory.times_s)[knot], times - trajectory.times_s[knot]
    gain = np.diff(trajectory.rates)[knot] / np.where(span > 0.0, span, 1.0) * (span > 0.0)
    rate = trajectory.rates[knot] + gain * since
    s = trajectory.parameters[knot] + trajectory.rates[knot] * since + 0.5 * gain * since**2
    first, second = trajectory.path(s, 1), trajectory.path(s, 2)
    return times, trajectory.path(s), first * rate[:, None], first * gain[:, None] + second * rate[:, None] ** 2


def tool_motion(arm, q, dq, ddq):
    """Speed of the tool by its Jacobian, and its acceleration by a difference quotient of the Jacobian."""
    step = 1e-6
    speeds, accelerations = [], []
    for angles, speed, acceleration in zip(q, dq, ddq, strict=True):
        jacobian = arm.tool_jacobian(angles)[:3]
        ahead, behind = (arm.tool_jacobian(angles + sign * step * speed)[:3] for sign in (1.0, -1.0))
        speeds.append(np.linalg.norm(jacobian @ speed))
        accelerations.append(np.linalg.norm(jacobian @ acceleration + (ahead - behind) / (2 * step) @ speed))
    return np.array(speeds), np.array(accelerations)


@pytest.mark.parametrize(
    ("turn_rad", "speed", "acceleration", "expected_s"),
    [
        (2.0, 1.0, 2.0, 2.0 / 1.0 + 1.0 / 2.0),
        (0.5, 1.0, 2.0, 0.5 / 1.0 + 1.0 / 2.0),  # the trapezoid is just a triangle
        (0.2, 1.0, 2.0, 2.0 * math.sqrt(0.2 / 2.0)),
        (3.0, 0.1, 50.0, 3.0 / 0.1 + 0.1 / 50.0),
    ],
)
def test_one_joint_has_the_time_of_the_closed_form(arm, anything, turn_rad, speed, acceleration, expected_s):
    start = np.array([0.0, -1.2, 1.4, -1.5, -1.5, 0.0])
    limits = MotionLimits(speed_rad_s=(speed,) * 6, acceleration_rad_s2=(acceleration,) * 6, tool_speed_m_s=FREE)
    points = np.array([start, [*start[:5], turn_rad]])
    move = time_move_by_trapezoids(JointPath(points), anything, arm, limits, resolution_rad=RESOLUTION)
    assert move.trajectory.duration_s == pytest.approx(expected_s, rel=1e-12)


def test_synchronised_joints_take_the_time_of_the_slowest(timed, limits, polylines):
    kept = limits(FREE)
    speeds, accelerations = np.array(kept.speed_rad_s), np.array(kept.acceleration_rad_s2)
    for points in polylines(20, seed=1):
        expected_s = 0.0
        for turn in np.abs(np.diff(points, axis=0)):
            # The common profile of the share of the turn: its speed and acceleration are those of the tightest joint.
            speed, acceleration = np.min(speeds / turn), np.min(accelerations / turn)
            is_triangle = speed**2 / acceleration > 1.0
            expected_s += 2.0 / math.sqrt(acceleration) if is_triangle else 1.0 / speed + speed / acceleration
        move = timed(points, tool_speed_m_s=FREE)
        assert move.trajectory.duration_s == pytest.approx(expected_s, rel=1e-12)
        assert (move.blended, move.stops) == (0, len(points) - 2)


@pytest.mark.parametrize("is_curve", [False, True])
@pytest.mark.parametrize("tool_acceleration_m_s2", [math.inf, 2.0])
def test_no_limit_is_exceeded_at_ten_kilohertz(timed, arm, limits, polylines, is_curve, tool_acceleration_m_s2):
    kept = limits(0.7, tool_acceleration_m_s2)
    for points in polylines(6, seed=2):
        move = timed(points, is_curve=is_curve, tool_speed_m_s=0.7, tool_acceleration_m_s2=tool_acceleration_m_s2)
        _, q, dq, ddq = sampled(move.trajectory)
        assert np.max(np.abs(dq) / kept.speed_rad_s) <= 1.0 + 1e-9
        assert np.max(np.abs(ddq) / kept.acceleration_rad_s2) <= 1.0 + 1e-4 * is_curve + 1e-9
        some = slice(None, None, TOOL_DIVISOR)
        speeds, accelerations = tool_motion(arm, q[some], dq[some], ddq[some])
        assert np.max(speeds) <= 0.7 * (1.0 + 1e-6)
        assert np.max(accelerations) <= tool_acceleration_m_s2 * (1.0 + 1e-4)
        assert move.trajectory.peak_tool_speed_m_s >= np.max(speeds) * (1.0 - 1e-6)
        assert move.trajectory.peak_tool_acceleration_m_s2 >= np.max(accelerations) * (1.0 - 1e-4)


def test_something_is_at_its_limit_on_each_run(timed, arm, limits, polylines):
    for points in polylines(6, seed=3):
        for pair in pairwise(points):
            kept = limits(0.7, 2.0)
            move = timed(np.array(pair), tool_speed_m_s=0.7, tool_acceleration_m_s2=2.0)
            _, q, dq, ddq = sampled(move.trajectory)
            tool_speeds, tool_accelerations = tool_motion(arm, *(each[::TOOL_DIVISOR] for each in (q, dq, ddq)))
            used = max(np.max(np.abs(ddq) / kept.acceleration_rad_s2), np.max(tool_accelerations) / 2.0)
            assert 0.98 < used <= 1.0 + 1e-4
            assert np.max(tool_speeds) <= 0.7 + 1e-6


def test_integrated_speeds_give_the_positions(timed, polylines):
    points = polylines(1, seed=4)[0]
    times, q, dq, _ = sampled(timed(points).trajectory)
    integrated = q[0] + np.cumsum(np.diff(times)[:, None] * (dq[1:] + dq[:-1]) / 2, axis=0)
    assert integrated == pytest.approx(q[1:], abs=1e-6)
    assert q[[0, -1]] == pytest.approx(points[[0, -1]], abs=1e-9)


def test_it_rests_at_each_waypoint(timed, polylines):
    points = polylines(8, seed=5)[-1]
    trajectory = timed(points).trajectory
    resting = trajectory.rates == 0.0
    visited = trajectory.path(trajectory.parameters[resting])
    for point in points:
        assert np.min(np.linalg.norm(visited - point, axis=1)) < 1e-9


def test_a_curve_is_one_trapezoid(timed, polylines):
    start, end = polylines(1, seed=6)[0][[0, -1]]
    along = np.linspace(0.0, 1.0, 60)[:, None]
    points = start + along * (end - start) + 0.05 * np.sin(math.pi * along) ** 2
    move = timed(points, is_curve=True)
    assert move.stops == 0
    assert 3 <= len(move.trajectory.rates) <= 4
    assert timed(points).trajectory.duration_s > 3.0 * move.trajectory.duration_s


def test_it_is_never_faster_than_the_time_optimal_motion(timed, anything, arm, limits, polylines):
    for points in polylines(10, seed=7):
        optimal = time_move(JointPath(points), anything, arm, limits(), resolution_rad=RESOLUTION)
        assert timed(points).trajectory.duration_s >= 0.999 * optimal.trajectory.duration_s


def test_half_the_speed_and_a_quarter_of_the_acceleration_take_twice_the_time(arm, limits, polylines, anything):
    kept = limits(0.7, 2.0)
    slow = replace(
        kept,
        speed_rad_s=tuple(0.5 * one for one in kept.speed_rad_s),
        acceleration_rad_s2=tuple(0.25 * one for one in kept.acceleration_rad_s2),
        tool_speed_m_s=0.35,
        tool_acceleration_m_s2=0.5,
    )
    for points in polylines(5, seed=8):
        path = blend(JointPath(points), anything, resolution_rad=RESOLUTION).path
        fast_s, slow_s = (trapezoidal_trajectory(path, arm, each).duration_s for each in (kept, slow))
        assert slow_s == pytest.approx(2.0 * fast_s, rel=1e-9)


def test_a_path_that_touches_something_is_not_timed(timed, polylines):
    class Nothing:
        def is_valid(self, q):
            return False

    move = timed(polylines(1)[0], validity=Nothing())
    assert (move.outcome, move.trajectory) == (TimingOutcome.IN_COLLISION, None)


def test_a_path_of_one_point_takes_no_time(timed):
    move = timed(np.array([[0.0, -1.2, 1.4, -1.5, -1.5, 0.0]]))
    assert move.trajectory.duration_s == 0.0


def test_limits_of_another_number_of_joints(arm, anything, polylines):
    limits = MotionLimits(speed_rad_s=(1.0,) * 7, acceleration_rad_s2=(1.0,) * 7, tool_speed_m_s=1.0)
    with pytest.raises(MotionError, match="the limits must be for 6 joints, those of the path, got limits for 7"):
        time_move_by_trapezoids(JointPath(polylines(1)[0]), anything, arm, limits, resolution_rad=RESOLUTION)


def test_a_resolution_of_nothing(arm, anything, limits, polylines):
    with pytest.raises(MotionError, match="the resolution must be above 0 rad, got 0 rad"):
        time_move_by_trapezoids(JointPath(polylines(1)[0]), anything, arm, limits(), resolution_rad=0.0)
