import math

import pytest

from rgss.scenes import Joint


def test_a_robot_is_read_in_si_units(kitchen):
    robot = kitchen.robot()
    assert (robot.id, robot.flange) == ("six", "flange")
    assert [joint.name for joint in robot.joints] == [f"joint_{number}" for number in range(1, 7)]
    assert robot.joints[2] == Joint(
        name="joint_3",
        lower_rad=math.radians(-160),
        upper_rad=math.radians(180),
        speed_rad_s=2.0,
        acceleration_rad_s2=3.0,
        torque_n_m=150.0,
    )
    assert robot.tool_acceleration_m_s2 == 1.2
    assert robot.home_rad == pytest.approx((0, -math.pi / 2, math.pi / 2, 0, 0, math.pi / 4))
    assert robot.urdf == kitchen.texts["robots/six.urdf"]


@pytest.mark.parametrize("limits", ["¦[180 deg, -170 deg]", "¦[10 deg, 10 deg]"])
def test_an_empty_range_is_found(kitchen, limits):
    kitchen.change("robots/six.yaml", "[-170 deg, 180 deg]", limits)
    assert kitchen.findings("robot") == [f"{kitchen.marks()[0]} scene.range joint 'joint_2' has an empty range"]


@pytest.mark.parametrize(
    ("old", "new", "name"),
    [
        ("2 rad/s, acceleration: 3 rad/s^2, torque: 150", "¦0 rad/s, acceleration: 3 rad/s^2, torque: 150", "speed"),
        ("acceleration: 3 rad/s^2, torque: 150", "acceleration: ¦-3 rad/s^2, torque: 150", "acceleration"),
        ("torque: 150", "torque: ¦0", "torque"),
        ("tool_acceleration: 1.2 m/s^2", "tool_acceleration: ¦0 m/s^2", "tool_acceleration"),
    ],
)
def test_a_limit_that_is_not_positive_is_found(kitchen, old, new, name):
    kitchen.change("robots/six.yaml", old, new)
    assert kitchen.findings("robot") == [f"{kitchen.marks()[0]} scene.not-positive {name} must be greater than zero"]


def test_a_missing_urdf_is_found_where_it_is_named(kitchen):
    kitchen.texts["robots/six.urdf"] = None
    kitchen.change("robots/six.yaml", "six.urdf", "¦six.urdf")
    assert kitchen.findings("robot") == [
        f"{kitchen.marks()[0]} scene.missing-file there is no file 'six.urdf' (file names are relative to this file)"
    ]


def test_a_joint_that_stands_twice_is_found(kitchen):
    kitchen.change("robots/six.yaml", "name: joint_4", "name: ¦joint_3")
    (finding,) = kitchen.findings("robot")
    assert finding == (
        f"{kitchen.marks()[0]} scene.duplicate-id joint 'joint_3' stands already above "
        "(name each joint of the arm once, from the base to the flange)"
    )


def test_six_joints_are_needed(kitchen):
    text = kitchen.texts["robots/six.yaml"]
    line = next(line for line in text.splitlines() if "joint_6" in line)
    kitchen.change("robots/six.yaml", line + "\n", "")
    assert any("at least 6 entries are expected" in finding for finding in kitchen.findings("robot"))


def test_all_problems_come_at_once(kitchen):
    kitchen.change("robots/six.yaml", "[-170 deg, 180 deg]", "¦[180 deg, 170 deg]")
    kitchen.change("robots/six.yaml", "torque: 150", "torque: ¦0")
    kitchen.change("robots/six.yaml", "name: joint_4", "name: ¦wrist")
    assert [finding.split()[0] for finding in kitchen.findings("robot")] == kitchen.marks()
