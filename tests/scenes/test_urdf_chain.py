"""An arm of any URDF: joints off the chain are fixed, frames need no mass, units fit the joints."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from rgss.errors import DocumentError
from rgss.scenes import JointKind, Pose, load_robot

MATTER = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
URDF = f"""<robot name="gantry">
<link name="base"/><link name="beam">{MATTER}</link><link name="column">{MATTER}</link><link name="flange"/>
<link name="hand">{MATTER}</link><link name="left">{MATTER}</link><link name="right">{MATTER}</link>
<joint name="slide" type="prismatic"><parent link="base"/><child link="beam"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="100" velocity="1"/></joint>
<joint name="turn" type="continuous"><parent link="beam"/><child link="column"/><axis xyz="0 0 1"/></joint>
<joint name="mount" type="fixed"><parent link="column"/><child link="flange"/><origin xyz="0.3 0 0"/></joint>
<joint name="wrist" type="revolute"><parent link="flange"/><child link="hand"/><origin xyz="0 0 0.1" rpy="0.2 0.1 0"/>
<axis xyz="0 1 1"/><limit lower="0.3" upper="2" effort="9" velocity="1"/></joint>
<joint name="finger" type="prismatic"><parent link="hand"/><child link="left"/><axis xyz="1 0 0"/>
<limit lower="0" upper="0.1" effort="9" velocity="1"/></joint>
<joint name="other" type="prismatic"><parent link="hand"/><child link="right"/><axis xyz="1 0 0"/>
<limit lower="-1" upper="1" effort="9" velocity="1"/><mimic joint="finger" multiplier="-2" offset="0.01"/></joint>
</robot>"""
YAML = """robot: gantry
description: gantry.urdf
flange: flange
joints:
  - {name: slide, range: [-500 mm, 500 mm], speed: 0.5 m/s, acceleration: 2 m/s^2, torque: 200 N}
  - {name: turn, range: [-90 deg, 90 deg], speed: 90 deg/s, acceleration: 3 rad/s^2, torque: 50 N*m}
payload: 2 kg
tool_acceleration: 1 m/s^2
home: [100 mm, 30 deg]
"""


def read(tmp_path, *, yaml=YAML, urdf=URDF):
    (tmp_path / "gantry.urdf").write_text(urdf, encoding="utf-8")
    (tmp_path / "gantry.yaml").write_text(yaml, encoding="utf-8")
    return load_robot(tmp_path / "gantry.yaml", base=Pose(), label="gantry.yaml", project=tmp_path)


def findings(tmp_path, **changes):
    with pytest.raises(DocumentError) as caught:
        read(tmp_path, **changes)
    return [str(finding) for finding in caught.value.findings]


def parsed(robot):
    return ET.fromstring(robot.urdf)  # noqa: S314 - written by the test


def joint_of(robot, name):
    return next(joint for joint in parsed(robot).findall("joint") if joint.get("name") == name)


def test_a_slide_and_a_continuous_joint_have_the_units_and_the_range_of_the_file(tmp_path):
    robot = read(tmp_path)
    slide, turn = robot.joints
    assert (slide.kind, slide.lower_rad, slide.speed_rad_s, slide.torque_n_m) == (JointKind.PRISMATIC, -0.5, 0.5, 200.0)
    assert turn.kind is JointKind.REVOLUTE
    assert robot.home_rad == pytest.approx((0.1, math.radians(30)))
    limit = joint_of(robot, "turn").find("limit")
    assert joint_of(robot, "turn").get("type") == "revolute"
    assert float(limit.get("upper")) == pytest.approx(math.pi / 2)


def test_joints_off_the_arm_are_fixed_where_they_follow_or_are_put(tmp_path):
    robot = read(tmp_path, yaml=YAML + "frozen: {finger: 40 mm}\n")
    assert {joint_of(robot, name).get("type") for name in ("wrist", "finger", "other")} == {"fixed"}
    assert joint_of(robot, "finger").find("origin").get("xyz").split()[0] == "0.04"
    assert float(joint_of(robot, "other").find("origin").get("xyz").split()[0]) == pytest.approx(-0.07)


def test_a_frozen_turn_is_the_turn_that_the_joint_would_make(tmp_path):
    import pinocchio

    robot = read(tmp_path, yaml=YAML + "frozen: {wrist: 40 deg}\n")
    fixed, free = pinocchio.buildModelFromXML(robot.urdf), pinocchio.buildModelFromXML(URDF)
    q = pinocchio.neutral(free)
    q[free.joints[free.getJointId("wrist")].idx_q] = math.radians(40)
    places = []
    for model, at in ((fixed, pinocchio.neutral(fixed)), (free, q)):
        data = model.createData()
        pinocchio.framesForwardKinematics(model, data, at)
        places.append(data.oMf[model.getFrameId("hand")].homogeneous)
    assert np.allclose(places[0], places[1], atol=1e-12)


def test_a_joint_that_is_not_told_rests_as_near_to_zero_as_it_may(tmp_path):
    given, resting = read(tmp_path, yaml=YAML + "frozen: {wrist: 0.3 rad}\n"), read(tmp_path)
    assert given.urdf == resting.urdf


def test_links_that_are_left_out_go_with_what_they_carry(tmp_path):
    robot = read(tmp_path, yaml=YAML + "without: [hand]\n")
    names = {link.get("name") for link in parsed(robot).findall("link")}
    assert names == {"base", "beam", "column", "flange"}


def test_a_frame_without_mass_weighs_nothing_to_speak_of(tmp_path):
    masses = [float(mass.get("value")) for mass in parsed(read(tmp_path)).iter("mass")]
    assert sum(masses) == pytest.approx(5.0, abs=1e-5)


def test_the_length_of_an_axis_changes_neither_places_nor_torques(tmp_path):
    import pinocchio

    oblique = URDF.replace('xyz="0 0 1"', 'xyz="0.6 0 0.8"').replace('xyz="0 1 0"', 'xyz="0 1 0.0"')
    scaled = oblique.replace('xyz="0.6 0 0.8"', 'xyz="1.2 0 1.6"').replace('xyz="0 1 0.0"', 'xyz="0 0.25 0"')
    (tmp_path / "scaled").mkdir()
    unit, other = read(tmp_path, urdf=oblique), read(tmp_path / "scaled", urdf=scaled)
    assert 'xyz="0.6 0 0.8"' in unit.urdf, "a unit axis keeps its text"
    for name in ("slide", "turn"):
        axis = np.array(joint_of(other, name).find("axis").get("xyz").split(), dtype=float)
        assert axis @ axis == pytest.approx(1.0, abs=1e-15)
    q, rest, push = np.array([0.2, 0.4]), np.zeros(2), np.array([1.0, -2.0])
    found = []
    for text in (unit.urdf, other.urdf):
        model = pinocchio.buildModelFromXML(text)
        data = model.createData()
        pinocchio.framesForwardKinematics(model, data, q)
        found.append((data.oMf[model.getFrameId("flange")].homogeneous, pinocchio.rnea(model, data, q, rest, push)))
    assert np.allclose(found[1][0], found[0][0], atol=1e-12)
    assert np.allclose(found[1][1], found[0][1], atol=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "[-500 mm, 500 mm]",
            "[-90 deg, 90 deg]",
            "'slide' is prismatic in the URDF, and its range must be linear",
        ),
        ("torque: 50 N*m", "torque: 50 N", "joint 'turn' is revolute in the URDF, and its torque must be angular"),
        ("home: [100 mm, 30 deg]", "home: [100 mm]", "home has 1 position, and the arm 2 joints"),
        (
            "home: [100 mm, 30 deg]",
            "home: [700 mm, 30 deg]",
            "'slide' is 700 mm, above its upper limit of 500 mm",
        ),
        ("home:", "frozen: {nothing: 1 deg}\nhome:", "has no joint 'nothing'"),
        (
            "home:",
            "frozen: {wrist: 1 mm}\nhome:",
            "'wrist' is revolute in the URDF, and its frozen must",
        ),
        ("home:", "without: [nothing]\nhome:", "has no link 'nothing'"),
        ("home:", "without: [beam]\nhome:", "needs the link 'beam' to carry the flange"),
        ("home:", "collision: balls\nhome:", "collision"),
        ("flange: flange", "flange: hand", "the movable joints slide, turn, wrist"),
        ("range: [-500 mm, 500 mm]", "range: [-500 kg, 500 mm]", "kg"),
    ],
)
def test_what_does_not_fit_is_found_at_its_place(tmp_path, old, new, message):
    assert old in YAML
    assert any(message in finding for finding in findings(tmp_path, yaml=YAML.replace(old, new)))


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"continuous"', '"planar"', "has the planar joint 'turn' in the arm"),
        ('<axis xyz="0 0 1"/></joint>', '<mimic joint="slide"/></joint>', "the movable joints slide besides those"),
    ],
)
def test_an_arm_that_is_not_simulated_is_found(tmp_path, old, new, message):
    assert old in URDF
    assert any(message in finding for finding in findings(tmp_path, urdf=URDF.replace(old, new)))
