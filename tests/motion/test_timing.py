"""Timed motions against dense sampling: every limit is kept, and little time is lost."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.errors import MotionError
from rgss.motion import JointPath, MotionLimits, TimingOutcome, blend, path_length, time_blended, time_move

pytestmark = pytest.mark.engine

RESOLUTION = 0.02
SAMPLES = 6001


def states(trajectory, times):
    """Joint angles (rad), speeds (rad/s) and accelerations (rad/s²) at given times, from the path's derivatives."""
    times = np.atleast_1d(np.asarray(times, dtype=float))
    inside = (times >= 0.0) & (times <= trajectory.duration_s) & (trajectory.duration_s > 0.0)
    time = np.clip(times, 0.0, trajectory.duration_s)
    knot = np.clip(np.searchsorted(trajectory.times_s, time, side="right") - 1, 0, len(trajectory.times_s) - 2)
    span, since = np.diff(trajectory.times_s)[knot], time - trajectory.times_s[knot]
    gain = np.diff(trajectory.rates)[knot] / np.where(span > 0.0, span, 1.0) * (span > 0.0)
    rate, gain = (trajectory.rates[knot] + gain * since) * inside, gain * inside
    parameter = trajectory.parameters[knot] + trajectory.rates[knot] * since + 0.5 * gain * since**2
    first, second = trajectory.path(parameter, 1), trajectory.path(parameter, 2)
    return (
        trajectory.positions(times),
        first * rate[:, None],
        first * gain[:, None] + second * rate[:, None] ** 2,
    )


def sampled(trajectory):
    times = np.linspace(0.0, trajectory.duration_s, SAMPLES)
    return times, *states(trajectory, times)


def tool_speeds(arm, q, dq):
    return np.array([np.linalg.norm(arm.tool_jacobian(one)[:3] @ speed) for one, speed in zip(q, dq, strict=True)])


def tool_accelerations(arm, trajectory, times):
    """By central differences of the tool's velocity, on either side of the jumps of acceleration."""
    step = 1e-5
    inner = times[(times > 2 * step) & (times < trajectory.duration_s - 2 * step)]
    jumps = np.min(np.abs(inner[:, None] - trajectory.times_s), axis=1) < 2 * step
    inner = inner[~jumps]

    def velocity(at):
        q, dq, _ = states(trajectory, at)
        return np.array([arm.tool_jacobian(one)[:3] @ speed for one, speed in zip(q, dq, strict=True)])

    return np.linalg.norm((velocity(inner + step) - velocity(inner - step)) / (2 * step), axis=1)


@pytest.fixture
def timed(anything, arm, limits):
    def run(points, *, validity=anything, **changes):
        return time_move(JointPath(points), validity, arm, limits(**changes), resolution_rad=RESOLUTION)

    return run


@pytest.mark.verifies("SYS-015")
@pytest.mark.parametrize("tool_speed_m_s", [0.5, 1.0])
def test_speeds_and_accelerations_keep_their_limits(timed, arm, limits, polylines, tool_speed_m_s):
    kept = limits(tool_speed_m_s)
    for points in polylines(15):
        move = timed(points, tool_speed_m_s=tool_speed_m_s)
        assert move.outcome is TimingOutcome.TIMED
        _, q, dq, ddq = sampled(move.trajectory)
        assert np.max(np.abs(dq) / kept.speed_rad_s) <= 1.005
        assert np.max(np.abs(ddq) / kept.acceleration_rad_s2) <= 1.01
        peak = np.max(tool_speeds(arm, q, dq))
        assert peak <= tool_speed_m_s * 1.005
        assert move.trajectory.peak_tool_speed_m_s == pytest.approx(peak, rel=0.005)


def test_the_acceleration_of_the_tool_keeps_its_limit(timed, arm, polylines):
    for points in polylines(8, seed=1):
        trajectory = timed(points, tool_acceleration_m_s2=2.0).trajectory
        accelerations = tool_accelerations(arm, trajectory, np.linspace(0.0, trajectory.duration_s, 1500))
        assert np.max(accelerations) <= 2.0 * 1.005
        assert trajectory.peak_tool_acceleration_m_s2 == pytest.approx(np.max(accelerations), rel=0.01)


def test_a_limit_that_does_not_bind_changes_nothing(timed, polylines):
    for points in polylines(3, seed=2):
        free = timed(points).trajectory
        loose = timed(points, tool_acceleration_m_s2=1000.0).trajectory
        assert loose.duration_s == pytest.approx(free.duration_s, rel=1e-6)


def test_the_motion_is_as_fast_as_its_limits_allow(timed, arm, limits, polylines):
    kept = limits()
    for points in polylines(10, seed=3):
        _, q, dq, ddq = sampled(timed(points).trajectory)
        used = np.max(
            [
                np.max(np.abs(dq) / kept.speed_rad_s, axis=1),
                np.max(np.abs(ddq) / kept.acceleration_rad_s2, axis=1),
                tool_speeds(arm, q, dq) / kept.tool_speed_m_s,
            ],
            axis=0,
        )
        # Time-optimal means that something is at its limit nearly always.
        assert np.mean(used > 0.95) > 0.85


def test_a_single_joint_has_the_trapezoid_of_the_textbook(arm):
    # The last joint does not move the tool centre, which lies on its axis.
    goal = np.array([0.0, -1.2, 1.4, -1.5, -1.5, 2.0])
    start = np.array([*goal[:5], 0.0])

    class Anything:
        def is_valid(self, q):
            return True

    limits = MotionLimits(speed_rad_s=(1.0,) * 6, acceleration_rad_s2=(2.0,) * 6, tool_speed_m_s=1.0)
    move = time_move(JointPath(np.array([start, goal])), Anything(), arm, limits, resolution_rad=RESOLUTION)
    assert move.trajectory.duration_s == pytest.approx(2.0 / 1.0 + 1.0 / 2.0, rel=2e-3)
    q, dq, ddq = states(move.trajectory, [0.25, move.trajectory.duration_s / 2])
    assert q[0, 5] == pytest.approx(0.0625, rel=1e-2)
    assert dq[:, 5] == pytest.approx([0.5, 1.0], rel=2e-3)
    assert ddq[:, 5] == pytest.approx([2.0, 0.0], abs=0.05)


def test_positions_speeds_and_accelerations_belong_together(timed, polylines):
    for points in polylines(5, seed=4):
        times, q, dq, _ = sampled(timed(points).trajectory)
        step = times[1] - times[0]
        assert np.diff(q, axis=0) / step == pytest.approx((dq[1:] + dq[:-1]) / 2, abs=5e-3)


def test_it_starts_and_ends_at_rest_at_the_ends_of_the_path(timed, polylines):
    for points in polylines(5, seed=5):
        trajectory = timed(points).trajectory
        q, dq, _ = states(trajectory, [0.0, trajectory.duration_s])
        assert q == pytest.approx(points[[0, -1]], abs=1e-9)
        assert dq == pytest.approx(np.zeros((2, 6)), abs=1e-9)


def test_before_and_after_it_rests(timed, polylines):
    points = polylines(1, seed=6)[0]
    trajectory = timed(points).trajectory
    q, dq, ddq = states(trajectory, [-1.0, trajectory.duration_s + 1.0])
    assert q == pytest.approx(points[[0, -1]], abs=1e-9)
    assert not dq.any()
    assert not ddq.any()


def test_every_sampled_state_is_valid_beside_an_obstacle(timed, corner):
    validity = corner(0.03)
    # In the plane of the first two joints, an L around the obstacle.
    ell = np.zeros((3, 6))
    ell[:, :2] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
    move = timed(ell, validity=validity)
    assert move.outcome is TimingOutcome.TIMED
    assert (move.blended, move.stops) == (1, 0)
    _, q, _, _ = sampled(move.trajectory)
    assert all(validity.is_valid(state) for state in q)
    assert np.max(np.linalg.norm(np.diff(q, axis=0), axis=1)) < RESOLUTION


def test_a_stop_at_a_corner_is_a_rest(timed, corner):
    ell = np.zeros((3, 6))
    ell[:, :2] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]
    move = timed(ell, validity=corner(1e-9))
    assert (move.blended, move.stops) == (0, 1)
    trajectory = move.trajectory
    rests = trajectory.times_s[trajectory.rates == 0.0]
    middle = rests[(rests > 0.0) & (rests < trajectory.duration_s)]
    q, dq, _ = states(trajectory, middle)
    assert q == pytest.approx(np.tile(ell[1], (len(middle), 1)), abs=1e-9)
    assert not dq.any()
    _, q, _, _ = sampled(trajectory)
    assert all(corner(1e-9).is_valid(state) for state in q)


def test_a_path_in_collision_is_not_timed(timed):
    class Gate:
        def is_valid(self, q):
            return not 0.45 < q[0] < 0.55

    move = timed(np.array([np.zeros(6), np.ones(6)]), validity=Gate())
    assert (move.outcome, move.trajectory) == (TimingOutcome.IN_COLLISION, None)


def test_a_path_of_no_length_takes_no_time(timed):
    trajectory = timed(np.zeros((2, 6))).trajectory
    assert trajectory.duration_s == 0.0
    q, dq, ddq = states(trajectory, [-1.0, 0.0, 1.0])
    assert not q.any()
    assert not dq.any()
    assert not ddq.any()


@pytest.mark.parametrize("length", [1e-6, 1e-3, 0.05])
def test_short_moves(timed, length):
    move = timed(np.array([np.zeros(6), np.full(6, length)]))
    assert move.outcome is TimingOutcome.TIMED
    # From rest to rest at the smallest acceleration of all joints.
    assert move.trajectory.duration_s == pytest.approx(2 * math.sqrt(length / 3.0), rel=0.02)


def test_many_small_steps_are_one_motion(timed, arm):
    start = np.array([0.0, -1.2, 1.4, -1.5, -1.5, 0.0])
    fine = start + np.linspace(0.0, 1.0, 40)[:, None] * np.array([0.5, 0.2, -0.3, 0.1, 0.0, 0.4])
    coarse = fine[[0, -1]]
    one, other = timed(fine), timed(coarse)
    assert one.stops == 0
    assert one.trajectory.duration_s == pytest.approx(other.trajectory.duration_s, rel=0.01)


def test_rows_of_one_line_whose_distances_differ_by_rounding_are_one_motion(timed, arm, limits):
    start, end = np.zeros(6), np.array([0.03, 0.0, 0.0, 0.0, 0.0, 0.0])
    shares = np.linspace(0.0, 1.0, 94)[:, None]
    # Numerical inverse kinematics rounds its rows to 11 digits.
    rows = np.round(start + shares * (end - start), 11)

    whole, divided = (timed(np.vstack(points)).trajectory.duration_s for points in ([start, end], rows))

    assert divided == pytest.approx(whole, rel=1e-3)


def test_one_rounded_path_serves_several_speeds(anything, arm, limits, polylines):
    blended = blend(JointPath(polylines(1, seed=7)[0]), anything, resolution_rad=RESOLUTION)
    slow, fast = (time_blended(blended, arm, limits(speed)).trajectory for speed in (0.5, 1.0))
    assert slow.path is fast.path
    assert slow.duration_s > fast.duration_s


def test_the_same_path_has_the_same_timing(timed, polylines):
    points = polylines(4, seed=8)
    first = [timed(one).trajectory for one in points]
    again = [timed(one).trajectory for one in reversed(points)][::-1]
    for one, other in zip(first, again, strict=True):
        assert np.array_equal(one.times_s, other.times_s)
        assert np.array_equal(one.rates, other.rates)


def test_the_way_of_the_tool_is_that_of_the_path(timed, arm, polylines):
    points = polylines(1, seed=9)[0]
    trajectory = timed(points).trajectory
    _, q, dq, _ = sampled(trajectory)
    travelled = path_length(arm.tool_position(q))
    mean_speed = np.mean(tool_speeds(arm, q, dq))
    assert mean_speed * trajectory.duration_s == pytest.approx(travelled, rel=1e-3)


def test_limits_for_other_joints(anything, arm):
    limits = MotionLimits(speed_rad_s=(1.0,) * 5, acceleration_rad_s2=(1.0,) * 5, tool_speed_m_s=1.0)
    with pytest.raises(MotionError) as caught:
        time_move(JointPath(np.zeros((2, 6))), anything, arm, limits, resolution_rad=RESOLUTION)
    assert caught.value.message == "the limits must be for 6 joints, those of the path, got limits for 5"
    assert caught.value.hint == "give limits for every joint"


def test_a_motion_that_the_optimisation_does_not_find(timed, monkeypatch):
    monkeypatch.setattr("rgss.motion.timing.fastest_rates", lambda *_: None)
    move = timed(np.array([np.zeros(6), np.ones(6)]))
    assert (move.outcome, move.trajectory) == (TimingOutcome.INFEASIBLE, None)
