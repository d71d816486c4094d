"""Mimic joints within an arm: what is read of them, the limits of their drivers, and what is refused."""

from __future__ import annotations

import pytest

from rgss.errors import DocumentError
from rgss.scenes import JointKind
from tests.fixtures.palletizer import PALLETIZER_YAML, palletizer

ELBOW_LEVEL = '<mimic joint="elbow" multiplier="-1.0" offset="0.0"/>'
SHOULDER_LEVEL = '<mimic joint="shoulder" multiplier="-1.0" offset="0.0"/>'
LEVEL_LIMIT = '<limit lower="-1.4" upper="0.7" velocity="4.0" effort="300.0"/>'


def findings(folder, *changed, yaml=PALLETIZER_YAML):
    with pytest.raises(DocumentError) as caught:
        palletizer(folder, *changed, yaml=yaml)
    return [str(one) for one in caught.value.findings]


def test_followers_are_no_degrees_of_freedom(tmp_path):
    robot = palletizer(tmp_path)
    assert [joint.name for joint in robot.joints] == ["turret", "shoulder", "elbow", "wrist"]
    assert [(one.name, one.driver, one.multiplier, one.offset) for one in robot.followers] == [
        ("shoulder_level", 1, -1.0, 0.0),
        ("elbow_level", 2, -1.0, 0.0),
    ]
    assert [one.effort for one in robot.followers] == [300.0, 100.0]
    assert robot.follower_positions((0.1, 0.2, 0.3, 0.4)) == (-0.2, -0.3)
    assert robot.whole_turns_are_equal == (True,) * 4


def test_a_follower_of_a_follower_follows_the_driven_joint(tmp_path):
    chained = '<mimic joint="shoulder_level" multiplier="-0.5" offset="0.1"/>'
    robot = palletizer(tmp_path, (SHOULDER_LEVEL, SHOULDER_LEVEL.replace('"0.0"', '"0.2"')), (ELBOW_LEVEL, chained))
    one = robot.followers[1]
    assert (one.name, one.driver) == ("elbow_level", 1)
    # The half of a negative of a negative, where the two offsets cancel.
    assert (one.multiplier, one.offset) == pytest.approx((0.5, 0.0))
    # Half a turn of the follower for a whole one of the driven joint.
    assert robot.whole_turns_are_equal == (True, False, True, True)


def test_a_follower_limits_its_driver(tmp_path):
    narrow = '<limit lower="-0.8" upper="0.5" velocity="3.0" effort="300.0"/>'
    doubled = SHOULDER_LEVEL.replace("-1.0", "-2.0").replace('"0.0"', '"0.1"')
    shoulder = palletizer(tmp_path, (LEVEL_LIMIT, narrow), (SHOULDER_LEVEL, doubled)).joints[1]
    # -2 q + 0.1 is from -0.8 to 0.5.
    assert (shoulder.lower_rad, shoulder.upper_rad) == pytest.approx((-0.2, 0.45))
    assert shoulder.speed_rad_s == pytest.approx(1.5)


def test_a_continuous_follower_limits_nothing_and_gets_a_range(tmp_path):
    level = '<joint name="shoulder_level" type="revolute">'
    robot = palletizer(tmp_path, (level, level.replace("revolute", "continuous")))
    assert (robot.joints[1].lower_rad, robot.joints[1].upper_rad) == (-0.7, 1.4)
    assert 'name="shoulder_level" type="revolute"' in robot.urdf


def test_a_sliding_follower_has_its_kind(tmp_path):
    level = '<joint name="elbow_level" type="revolute">'
    robot = palletizer(tmp_path, (level, level.replace("revolute", "prismatic")))
    assert robot.followers[1].kind is JointKind.PRISMATIC
    assert robot.whole_turns_are_equal == (True, True, False, True)


def test_a_frozen_follower_and_the_follower_of_a_frozen_joint_are_fixed(tmp_path):
    yaml = PALLETIZER_YAML + "frozen: {elbow_level: 10 deg}\n"
    assert [one.name for one in palletizer(tmp_path, yaml=yaml).followers] == ["shoulder_level"]
    lines = [line for line in PALLETIZER_YAML.splitlines() if "elbow" not in line]
    yaml = "\n".join(lines).replace(", 0 deg]", "]") + "\nfrozen: {elbow: 20 deg}\n"
    robot = palletizer(tmp_path, yaml=yaml)
    assert [one.name for one in robot.followers] == ["shoulder_level"]
    assert 'name="elbow_level" type="fixed"' in robot.urdf


def test_home_keeps_followers_within_their_ranges(tmp_path):
    narrow = '<limit lower="0.1" upper="0.5" velocity="3.0" effort="300.0"/>'
    (found,) = findings(tmp_path, (LEVEL_LIMIT, narrow))
    assert "scene.home" in found
    assert "home of joint 'shoulder' has what follows it, 'shoulder_level', outside its range" in found
    assert "-28.6479 deg to -5.72958 deg" in found


def test_a_range_without_a_position_of_the_follower_is_refused(tmp_path):
    (found,) = findings(tmp_path, (LEVEL_LIMIT, LEVEL_LIMIT.replace("-1.4", "0.75").replace('"0.7"', '"0.9"')))
    assert "no position of joint 'shoulder' has what follows it, 'shoulder_level', within its range" in found


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ((ELBOW_LEVEL, ELBOW_LEVEL.replace('"elbow"', '"elbow_level"')), "lets the joint 'elbow_level' follow itself"),
        ((ELBOW_LEVEL, ELBOW_LEVEL.replace('"elbow"', '"elbo"')), "follow 'elbo', which is not one of its joints"),
        ((ELBOW_LEVEL, ELBOW_LEVEL.replace("-1.0", "0")), "lets the joint 'elbow_level' follow with a multiplier of 0"),
        ((ELBOW_LEVEL, ELBOW_LEVEL.replace("-1.0", "x")), "has multiplier='x' in <mimic> of 'elbow_level'"),
    ],
    ids=["itself", "unknown", "zero", "no-number"],
)
def test_a_wrong_mimic_is_one_finding(tmp_path, changed, said):
    (found,) = findings(tmp_path, changed)
    assert said in found


def test_a_driver_off_the_chain_is_refused(tmp_path):
    off = (
        '<link name="side"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
        '</inertial></link><joint name="aside" type="revolute"><parent link="base"/><child link="side"/>'
        '<axis xyz="0 0 1"/><limit lower="-1" upper="1" velocity="1" effort="1"/></joint></robot>'
    )
    (found,) = findings(tmp_path, ("</robot>", off), (ELBOW_LEVEL, ELBOW_LEVEL.replace('"elbow"', '"aside"')))
    assert (
        "lets the joint 'elbow_level' of the arm follow 'aside', which is not between its base and its flange" in found
    )


def test_a_follower_is_not_listed_as_a_joint(tmp_path):
    line = "  - {name: elbow_level, range: [-1 rad, 0.9 rad], speed: 2 rad/s, acceleration: 5 rad/s^2, torque: 9 N*m}\n"
    yaml = PALLETIZER_YAML.replace("  - {name: wrist", line + "  - {name: wrist").replace("0 deg]\n", "0 deg, 0 deg]\n")
    (found,) = findings(tmp_path, yaml=yaml)
    assert "the movable joints turret, shoulder, elbow, wrist besides those that follow them" in found
