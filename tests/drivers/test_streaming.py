"""A stream starts slowly, keeps its rate, and stops the robot in every case that is not as planned."""

import math

import numpy as np
import pytest

from rgss.drivers import GripperState, Segment, StreamOutcome, StreamSettings, TimedTask, stream
from rgss.drivers.task import TaskCursor, rate_candidates
from rgss.errors import DefinitionError
from tests.drivers.conftest import Cosine, Robot, guard, limits, pick_task

SETTINGS = StreamSettings(speed=0.5)


def run(robot, task=None, given=None, settings=SETTINGS, **options):
    return stream(robot, task or pick_task(), guard(given), robot, settings, **options)


def test_a_task_is_completed_and_the_robot_stopped_and_left(robot):
    result = run(robot)
    assert (result.outcome, result.detail) == (StreamOutcome.COMPLETED, "")
    assert robot.calls == ["connect", "stop", "disconnect"]
    assert robot.sent[-1].positions_rad == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)
    assert max(point.positions_rad[0] for point in robot.sent) == pytest.approx(0.5)
    assert result.sent == len(robot.sent) == len(result.samples) - 1


def test_half_the_speed_takes_twice_the_time_and_waits_keep_theirs(robot):
    result = run(robot)
    lengths = {name: sum(s.phase == name for s in result.samples[1:]) for name in ("go", "close", "back")}
    # The first motion begins slowly: half of the ramp's 0.5 s is lost.
    assert lengths == {"go": pytest.approx(225, abs=2), "close": 30, "back": pytest.approx(200, abs=2)}


def test_the_gripper_closes_from_the_beginning_of_its_segment(robot):
    result = run(robot)
    for sample in result.samples[1:]:
        assert sample.commanded.gripper is (GripperState.OPEN if sample.phase == "go" else GripperState.CLOSED)


def test_it_starts_slowly(robot):
    run(robot)
    path = np.array([point.positions_rad[0] for point in robot.sent])
    planned = Cosine((0.0,), (0.5,), 1.0).positions(0.5 * 0.01 * np.arange(1, 50))[:, 0]
    assert np.all(path[:49] <= planned + 1e-12)
    assert path[24] < 0.4 * planned[24]


def test_periods_are_those_of_the_rate(robot):
    result = run(robot)
    times = np.array([sample.time_s for sample in result.samples])
    np.testing.assert_allclose(np.diff(times), 0.01, atol=1e-9)


def test_speeds_and_accelerations_of_what_is_sent_keep_the_limits(robot):
    given = limits(speed_rad_s=(0.79,) * 3, acceleration_rad_s2=(2.47,) * 3)
    # The motion needs the limits in full: pi/4 rad/s and pi**2/4 rad/s^2. So the ramp itself must give way.
    result = run(robot, given=given, settings=StreamSettings(speed=1.0, ramp_s=0.05))
    assert result.outcome is StreamOutcome.COMPLETED
    path = np.array([(0.0,) * 3, *(point.positions_rad for point in robot.sent)])
    speeds = np.diff(path, axis=0) * 100
    assert np.max(np.abs(speeds)) <= 0.79 * 1.01
    assert np.max(np.abs(np.diff(speeds, axis=0))) * 100 <= 2.47 * 1.01


def test_a_set_point_outside_the_limits_is_not_sent(robot):
    result = run(robot, given=limits(upper_rad=(1.0, 0.25, 1.0)))
    assert result.outcome is StreamOutcome.REFUSED
    assert result.detail.startswith("joint j1 would be at 14.")
    assert max(point.positions_rad[1] for point in robot.sent) <= 0.25
    assert robot.calls == ["connect", "stop", "disconnect"]


def test_nothing_is_sent_if_the_robot_is_elsewhere():
    robot = Robot((0.0, 0.5, 0.0))
    result = run(robot)
    assert result.outcome is StreamOutcome.REFUSED
    assert "bring the robot there first" in result.detail
    assert robot.sent == []


def test_nothing_is_sent_to_a_robot_with_other_joints():
    robot = Robot((0.0,) * 7)
    assert run(robot).detail == "the robot reports 7 joints, the task moves 3"
    assert robot.sent == []


def test_nothing_is_sent_to_a_robot_with_a_fault(robot):
    robot.fault_after = 0
    assert run(robot).outcome is StreamOutcome.FAULT
    assert robot.sent == []


def test_a_lost_heartbeat_stops_the_robot(robot):
    robot.silent_after = 40
    result = run(robot)
    assert result.outcome is StreamOutcome.HEARTBEAT_LOST
    assert result.detail == "the controller has not reported for 110 ms, at most 100 ms are allowed"
    assert 40 < len(robot.sent) <= 52
    assert robot.calls[-2:] == ["stop", "disconnect"]


def test_a_fault_on_the_way_stops_the_robot(robot):
    robot.fault_after = 30
    result = run(robot)
    assert (result.outcome, result.detail) == (StreamOutcome.FAULT, "the robot is protective stopped")
    assert len(robot.sent) == 30


def test_a_refused_call_stops_the_robot(robot):
    robot.refuses_after = 10
    result = run(robot)
    assert (result.outcome, result.detail) == (StreamOutcome.FAULT, "the controller refused servo with code 9")
    assert robot.calls == ["connect", "stop", "disconnect"]


def test_a_robot_that_does_not_follow_is_stopped(robot):
    robot.stuck_after = 20
    result = run(robot)
    assert result.outcome is StreamOutcome.FOLLOWING_ERROR
    assert result.detail.startswith("joint 1 is 0.1")
    assert result.detail.endswith("rad from its set point, at most 0.1 rad are allowed")
    assert robot.calls[-2:] == ["stop", "disconnect"]


def test_a_joint_that_slides_may_be_fifty_millimetres_from_its_set_point(robot):
    robot.stuck_after = 20
    sliding = guard(limits(slides=frozenset({"j0", "j1", "j2"})))
    result = stream(robot, pick_task(), sliding, robot, StreamSettings(speed=1.0))
    assert result.outcome is StreamOutcome.FOLLOWING_ERROR
    assert result.detail.startswith("joint 1 is 0.05")
    assert result.detail.endswith("m from its set point, at most 0.05 m are allowed")


def test_a_program_that_was_paused_stops_the_robot(robot):
    robot.pause_after = 15
    result = run(robot)
    assert result.outcome is StreamOutcome.LATE
    assert result.detail == "a period began 1000 ms late, at most 50 ms are allowed"
    assert len(robot.sent) == 15


@pytest.mark.parametrize("call", ["read", "send"])
def test_a_controller_that_answers_late_is_no_paused_program(robot, call):
    """By 70 ms, of which 50 are allowed."""
    answers = getattr(robot, call)

    def slow(*arguments):
        robot.time_s += 0.07 if len(robot.sent) == 20 else 0.0
        return answers(*arguments)

    setattr(robot, call, slow)
    result = run(robot)
    assert result.outcome is StreamOutcome.HEARTBEAT_LOST
    assert result.detail.startswith("the controller took 70 ms to answer, which made a period ")
    assert result.detail.endswith(" ms late, at most 50 ms are allowed")
    assert robot.calls[-2:] == ["stop", "disconnect"]


def test_an_interrupted_motion_comes_to_rest_on_its_path(robot):
    result = run(robot, is_interrupted=lambda: len(robot.sent) == 100)
    assert (result.outcome, result.detail) == (StreamOutcome.INTERRUPTED, "interrupted in go")
    path = np.array([point.positions_rad for point in robot.sent])
    speeds = np.diff(path, axis=0) * 100
    assert np.max(np.abs(np.diff(speeds, axis=0))) * 100 <= 4.0 * 1.01
    assert np.abs(speeds[-1]).max() < 0.01
    # Half of the ramp, and not past the end of the motion.
    assert 100 < len(path) <= 152


def test_an_interrupt_while_the_gripper_closes_ends_at_once(robot):
    result = run(robot, is_interrupted=lambda: bool(robot.sent) and robot.sent[-1].gripper is GripperState.CLOSED)
    assert (result.outcome, result.detail) == (StreamOutcome.INTERRUPTED, "interrupted in close")
    assert sum(point.gripper is GripperState.CLOSED for point in robot.sent) == 1


def test_an_error_of_the_program_stops_the_robot(robot):
    def fail():
        if len(robot.sent) == 5:
            raise ZeroDivisionError
        return False

    with pytest.raises(ZeroDivisionError):
        run(robot, is_interrupted=fail)
    assert robot.calls == ["connect", "stop", "disconnect"]


def test_a_stop_that_is_not_confirmed_is_reported(robot):
    robot.stop_fails = True
    result = run(robot)
    assert (result.outcome, result.detail) == (StreamOutcome.FAULT, "the stop was not confirmed: no answer")
    robot = Robot((0.0,) * 3, silent_after=3, stop_fails=True)
    result = run(robot)
    assert result.outcome is StreamOutcome.HEARTBEAT_LOST
    assert result.detail.endswith("; the stop was not confirmed: no answer")


@pytest.mark.parametrize("joints", [1, 7, 8])
def test_any_number_of_joints(joints):
    robot = Robot((0.0,) * joints)
    assert run(robot, pick_task(joints), limits(joints)).outcome is StreamOutcome.COMPLETED
    assert {len(point.positions_rad) for point in robot.sent} == {joints}


@pytest.mark.parametrize("speed", [0.0, 0.009, -0.1, 1.01, math.nan])
def test_the_speed_is_a_share(speed):
    with pytest.raises(DefinitionError, match="the speed of a driver must be from 1 % to 100 %, got"):
        StreamSettings(speed=speed)


def test_times_are_positive():
    with pytest.raises(DefinitionError, match="times and the following error of a stream must be positive"):
        StreamSettings(ramp_s=0.0)


def test_a_task_has_a_motion():
    wait = Segment(name="close", gripper=GripperState.CLOSED, wait_s=1.0)
    for segments in ((), (wait,)):
        with pytest.raises(DefinitionError, match="a timed task must have a motion"):
            TimedTask(segments=segments)


def test_a_task_that_begins_with_a_wait_begins_where_its_first_motion_does():
    task = pick_task()
    wait = Segment(name="before", gripper=GripperState.OPEN, wait_s=1.0)

    later = TimedTask(segments=(wait, *task.segments))

    assert later.start_rad == task.start_rad != ()
    assert TaskCursor(later, 0.01).segment is wait


def test_a_wait_is_as_long_at_every_rate():
    cursor = TaskCursor(pick_task(), 0.01)
    while cursor.segment.name == "go":
        cursor.advance(1.0)
    count = 0
    while cursor.segment.name == "close":
        cursor.advance(0.1)
        count += 1
    assert count == 30


def test_rates_are_tried_from_the_target_to_the_present_one():
    assert rate_candidates(0.4, 0.5, 0.04) == pytest.approx([0.44, 0.42, 0.41, 0.4])
    assert rate_candidates(0.02, 0.0, 0.04) == pytest.approx([0.0, 0.01, 0.015, 0.02])
    assert rate_candidates(0.5, 0.5, 0.04) == [0.5]


def test_a_stall_is_not_made_up_for(robot):
    """Of 40 ms, of which 50 are allowed: the points after it keep their distance in time."""
    waited, times = robot.wait_until, []

    def stalling(time_s):
        waited(time_s)
        robot.time_s += 0.04 if len(robot.sent) == 50 else 0.0
        times.append(robot.time_s)

    robot.wait_until = stalling
    result = run(robot)

    assert result.outcome is StreamOutcome.COMPLETED
    assert np.diff(times).min() > 0.0099


def test_a_signal_does_not_keep_the_robot_from_stopping(robot):
    stop, times = robot.stop, []

    def interrupted():
        stop()
        times.append(robot.time_s)
        if len(times) == 1:
            raise KeyboardInterrupt

    robot.stop = interrupted
    with pytest.raises(KeyboardInterrupt):
        run(robot)

    assert robot.calls[-3:] == ["stop", "stop", "disconnect"]


def test_what_the_robot_did_is_known_after_a_second_interrupt(robot):
    """The first one is a flag; the second one interrupts what the program waits for."""
    send, sent = robot.send, []

    def hanging(point):
        sent.append(point)
        if len(sent) == 60:
            raise KeyboardInterrupt
        send(point)

    robot.send = hanging
    result = run(robot, is_interrupted=lambda: len(sent) >= 50)
    assert (result.outcome, result.detail) == (
        StreamOutcome.INTERRUPTED,
        "interrupted again in go, and stopped at once",
    )
    assert (len(result.samples), result.sent) == (60, 59)
    assert robot.calls == ["connect", "stop", "disconnect"]


def test_a_second_interrupt_while_the_robot_is_stopped_loses_nothing(robot):
    stop, stops = robot.stop, []

    def interrupted():
        stops.append(robot.time_s)
        stop()
        if len(stops) == 1:
            raise KeyboardInterrupt

    robot.stop = interrupted
    result = run(robot, is_interrupted=lambda: len(robot.sent) >= 50)
    assert (result.outcome, result.detail) == (StreamOutcome.INTERRUPTED, "interrupted in go")
    assert len(result.samples) == result.sent + 1
    assert robot.calls[-3:] == ["stop", "stop", "disconnect"]
