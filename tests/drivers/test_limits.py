"""The guard refuses what is outside the limits, and says what."""

import math
from dataclasses import replace

import pytest

from rgss.drivers import limits_of
from rgss.errors import DefinitionError
from rgss.scenes import Joint, JointKind
from tests.drivers.conftest import guard, limits

STILL = (0.0, 0.0, 0.0)


def _begun(**changed):
    found = guard(limits(**changed))
    assert found.begin(STILL, STILL) == ""
    return found


def test_nothing_is_admitted_before_the_start():
    assert guard().check(STILL) == "no set point may be sent before the start of the task is admitted"


def test_the_robot_must_be_at_the_start():
    reason = guard().begin((0.0, 0.02, 0.0), STILL)
    assert reason == "joint j1 is at 1.15 deg, the task begins at 0.00 deg: bring the robot there first"
    assert guard().begin((0.0, 0.009, 0.0), STILL) == ""


def test_a_position_that_is_no_number_is_not_at_the_start():
    assert "j2 is at nan deg" in guard().begin((0.0, 0.0, math.nan), STILL)


def test_the_robot_must_have_the_task_s_joints():
    assert guard().begin((0.0,) * 7, STILL) == "the robot reports 7 joints, the task moves 3"
    assert _begun().check((0.0, 0.0)) == "a set point has 2 joints, the limits have 3"


@pytest.mark.parametrize("value", [1.001, -1.001, math.nan, math.inf])
def test_a_position_outside_the_range_is_refused(value):
    reason = _begun().check((0.0, value, 0.0))
    assert reason.startswith("joint j1 would be at")
    assert reason.endswith("outside -57.30 to 57.30 deg")


def test_a_start_outside_the_range_is_refused():
    assert "outside -57.30 to 57.30 deg" in guard().begin((2.0, 0.0, 0.0), (2.0, 0.0, 0.0))


def test_speed_acceleration_and_tool_speed_are_limited():
    fast = _begun(acceleration_rad_s2=(1e6,) * 3)
    assert fast.check((0.0, 0.02, 0.0)) == "speed of joint j1 would be 2 rad/s, its limit is 1 rad/s"
    assert fast.check((0.0, 0.0099, 0.0)) == ""
    reason = _begun().check((0.0, 0.0, 0.005))
    assert reason == "acceleration of joint j2 would be 50 rad/s^2, its limit is 4 rad/s^2"
    tool = _begun(acceleration_rad_s2=(1e6,) * 3, tool_speed_m_s=0.5)
    assert tool.check((0.005, 0.0, 0.0)) == "speed of the tool would be 1 m/s, its limit is 0.5 m/s"
    assert tool.check((0.0, 0.005, 0.0)) == ""


def test_the_acceleration_of_a_sudden_stop_is_refused():
    found = _begun(acceleration_rad_s2=(10.0,) * 3)
    position = 0.0
    for step in range(1, 9):
        position += step * 1e-3
        assert found.check((position, 0.0, 0.0)) == ""
        found.admit((position, 0.0, 0.0))
    assert "acceleration of joint j0 would be 80" in found.check((position, 0.0, 0.0))


def test_checking_remembers_nothing():
    found = _begun()
    for _ in range(3):
        assert "acceleration" in found.check((0.0, 0.0, 0.009))
    assert found.check(STILL) == ""


@pytest.mark.parametrize("joints", [1, 2, 7, 8])
def test_any_number_of_joints(joints):
    found = guard(limits(joints))
    still = (0.0,) * joints
    assert found.begin(still, still) == ""
    assert found.check(still) == ""
    assert f"joint j{joints - 1} would be" in found.check((*still[1:], 1.5))


def test_limits_must_fit_and_be_positive():
    with pytest.raises(DefinitionError, match="limits of 3 joints must have 3 values each"):
        limits(upper_rad=(1.0,))
    with pytest.raises(DefinitionError, match="limits of a driver must be positive"):
        limits(tool_speed_m_s=0.0)


def test_a_joint_that_slides_is_in_millimetres_and_has_tolerances_of_its_own():
    found = guard(limits(slides=frozenset({"j1"})))
    reason = found.begin((0.0, 0.006, 0.0), STILL)
    assert reason == "joint j1 is at 6.00 mm, the task begins at 0.00 mm: bring the robot there first"
    assert found.begin((0.0, 0.004, 0.009), STILL) == ""
    assert found.check((0.0, 1.001, 0.0)) == "joint j1 would be at 1001.00 mm, outside -1000.00 to 1000.00 mm"
    assert found.check((0.0, 0.02, 0.0)) == "speed of joint j1 would be 2 m/s, its limit is 1 m/s"
    assert "4 m/s^2" in found.check((0.0, 0.005, 0.0))


def test_the_kinds_of_the_joints_are_those_of_the_robot_file():
    joint = Joint(
        name="rail",
        lower_rad=-1.0,
        upper_rad=1.0,
        speed_rad_s=1.0,
        acceleration_rad_s2=1.0,
        torque_n_m=1.0,
        kind=JointKind.PRISMATIC,
    )
    found = limits_of((joint, replace(joint, name="turn", kind=JointKind.REVOLUTE)), tool_speed_m_s=1.0)
    assert (found.unit_of("rail"), found.unit_of("turn")) == ("m", "rad")
