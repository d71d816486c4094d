"""Grippers as a linkage of a URDF: kinematics against another library, force by virtual work, what is refused."""

from __future__ import annotations

import math
import shutil
from itertools import pairwise

import numpy as np
import pytest

from rgss.errors import DocumentError
from rgss.scenes import LinkageMotion, Pose, at_opening, load_gripper_file
from tests.robots.conftest import urdf_of
from tests.scenes.linkage_texts import FILE, JAWS
from tests.trials.hands.gripper_files import TWO_FINGER, linkage_file

PANDA = """\
gripper: panda-hand
kind: linkage
description: franka_panda/panda.urdf
palm: panda_hand
pads: [panda_leftfinger, panda_rightfinger]
mount: {yaw: -45 deg}
"""


@pytest.fixture
def jaws(tmp_path):
    """Reads the jaws with one change of the URDF and additions to the gripper file."""

    def read(old="", new="", more="", file=FILE):
        assert JAWS.count(old) >= 1
        (tmp_path / "jaws.urdf").write_text(JAWS.replace(old, new) if old else JAWS, encoding="utf-8")
        (tmp_path / "gripper.yaml").write_text(file + more, encoding="utf-8")
        return load_gripper_file(tmp_path / "gripper.yaml", label="g")

    return read


@pytest.fixture
def two_finger(tmp_path):
    return linkage_file(tmp_path)


def test_jaws_close_where_they_meet_and_the_effort_is_shared(jaws):
    file = jaws(more="friction: 0.5\nfirm_grasp: {finger_force: 2 N}\n")
    geometry, linkage = file.geometry, file.geometry.linkage

    assert (linkage.opened, linkage.closed) == pytest.approx((0.03, 0.0), abs=1e-12)
    assert (geometry.largest_opening_m, geometry.least_opening_m) == pytest.approx((0.03, 0.0), abs=1e-12)
    assert geometry.finger.size_m == pytest.approx((0.01, 0.02, 0.04))
    assert (geometry.grasp_depth_m, geometry.base.height_m) == pytest.approx((0.08, 0.06))
    assert geometry.azimuths_rad == pytest.approx((math.pi / 2, -math.pi / 2))
    assert file.settings == pytest.approx(
        {
            "gripper.base.mass": 0.4,
            "gripper.finger.mass": 0.05,
            "gripper.finger.speed": 0.1,
            "gripper.finger.force": 15.0,
            "gripper.finger.friction": 0.5,
        }
    )
    assert file.drive.firm_force_n == 2.0


BOSS = '<collision><origin xyz="0 {} {}"/><geometry><box size="0.02 0.004 0.005"/></geometry></collision></link>'


def with_bosses(height_m):
    """The jaws, each with a boss that protrudes by 4 mm before its face, 5 mm long, at a height of its middle."""
    text = JAWS
    for name, y_m in (("left", -0.002), ("right", 0.002)):
        before, link, after = text.partition(f'<link name="{name}">')
        text = before + link + after.replace("</link>", BOSS.format(y_m, height_m), 1)
    return text


def test_a_boss_near_the_palm_is_no_pad(jaws):
    """The pad begins past it, objects stay below it, and the jaws meet at the bosses."""
    geometry = jaws(JAWS, with_bosses(0.003)).geometry

    assert geometry.finger.size_m == pytest.approx((0.01, 0.02, 0.04 - 0.0055))
    assert (geometry.largest_opening_m, geometry.least_opening_m) == pytest.approx((0.03, 0.004), abs=1e-9)
    assert geometry.base.height_m == geometry.palm_height_m == pytest.approx(0.06 + 0.0055)
    assert geometry.grasp_depth_m == pytest.approx(0.06 + 0.0055 + 0.0345 / 2)


def test_what_protrudes_at_the_tip_is_the_pad(jaws):
    geometry = jaws(JAWS, with_bosses(0.0375)).geometry

    assert geometry.finger.size_m == pytest.approx((0.014, 0.02, 0.005))
    assert (geometry.largest_opening_m, geometry.least_opening_m) == pytest.approx((0.026, 0.0), abs=1e-9)
    assert geometry.palm_height_m == pytest.approx(0.06)


def test_the_grasp_may_be_nearer_to_the_tip(jaws):
    geometry = jaws(more="grasp_from_tip: 10 mm\n").geometry

    assert geometry.grasp_depth_m == pytest.approx(0.09)
    assert geometry.base.height_m == pytest.approx(0.06)


@pytest.mark.engine
def test_forward_kinematics_of_cranks_agree_with_another_library(two_finger):
    import pinocchio

    model = pinocchio.buildModelFromUrdf(str(TWO_FINGER))
    data = model.createData()
    linkage = two_finger.geometry.linkage
    names = [link.name for link in linkage.links]
    follow = {"finger_joint": 1.0, "right_crank_joint": 1.0, "left_tip_joint": -1.0, "right_tip_joint": -1.0}
    for driven in np.linspace(linkage.opened, linkage.closed, 7):
        q = np.zeros(model.nq)
        for joint, multiplier in follow.items():
            q[model.joints[model.getJointId(joint)].idx_q] = multiplier * driven
        pinocchio.framesForwardKinematics(model, data, q)
        for name, pose in zip(names, linkage.link_poses(float(driven)), strict=True):
            theirs = data.oMf[model.getFrameId(name)]
            assert pose.position_m == pytest.approx(theirs.translation, abs=1e-12)
            for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
                assert pose.rotate(axis) == pytest.approx(theirs.rotation @ np.array(axis), abs=1e-12)


def test_pads_of_cranks_move_on_arcs(two_finger):
    geometry, linkage = two_finger.geometry, two_finger.geometry.linkage
    radius_m, from_rad = math.hypot(0.0325, 0.0463), math.atan2(0.0325, 0.0463)
    motion = LinkageMotion(linkage)
    for driven in np.linspace(0.0, 0.7, 9):
        angle = from_rad - driven
        assert linkage.opening_m(driven) == pytest.approx(0.012 + radius_m * math.sin(angle), abs=1e-9)
        assert linkage.depth_m(driven) == pytest.approx(0.07 + radius_m * math.cos(angle) + 0.025, abs=1e-9)
        assert motion.transmission(driven) == pytest.approx(radius_m * math.cos(angle), rel=2e-3)
        assert motion.driven_at(motion.travel_m(driven)) == pytest.approx(driven, abs=1e-12)
    # The grasp centre is 15 mm above the tips, where the pads are at the width of the object.
    at_object = at_opening(geometry, 0.02)
    angle = math.asin(0.008 / radius_m)
    assert at_object.grasp_depth_m == pytest.approx(0.07 + radius_m * math.cos(angle) + 0.05 - 0.015, abs=1e-6)
    # The effort of 2 N·m presses least where the pads' arm is longest.
    assert two_finger.settings["gripper.finger.force"] == pytest.approx(1.0 / radius_m, rel=1e-3)


def test_what_is_fixed_to_a_link_with_a_mass_needs_none(jaws):
    pad = """  <link name="pad"><collision><geometry><box size="0.02 0.002 0.04"/></geometry></collision></link>
  <joint name="pad_joint" type="fixed">
    <origin xyz="0 0.001 0.02"/><parent link="left"/><child link="pad"/>
  </joint>
</robot>"""
    linkage = jaws("</robot>", pad).geometry.linkage
    assert [link.name for link in linkage.links if not link.mass_kg] == ["camera", "pad"]
    assert linkage.moved_mass_kg == pytest.approx(0.1)
    assert [[linkage.links[index].name for index in parts] for parts in linkage.finger_parts] == [
        ["left", "pad"],
        ["right"],
    ]


@pytest.mark.engine
def test_the_hand_of_a_whole_robot_is_read_from_its_urdf(tmp_path):
    shutil.copytree(urdf_of("seven with a hand").parent, tmp_path / "franka_panda")
    (tmp_path / "gripper.yaml").write_text(PANDA, encoding="utf-8")
    file = load_gripper_file(tmp_path / "gripper.yaml")

    geometry = file.geometry
    # Of the maker: the tool centre 103.4 mm from the flange, 80 mm between the open fingers.
    assert geometry.grasp_depth_m == pytest.approx(0.1034, abs=2e-4)
    assert 2 * geometry.largest_opening_m == pytest.approx(0.08, abs=3e-4)
    assert geometry.azimuths_rad == pytest.approx((math.pi / 4, -3 * math.pi / 4), abs=1e-9)
    assert [link.name for link in geometry.linkage.links if link.mass_kg] == [
        "panda_hand",
        "panda_leftfinger",
        "panda_rightfinger",
    ]
    # An effort of 20 N on one joint moves both fingers.
    assert file.settings["gripper.finger.force"] == 10.0


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('type="prismatic"', 'type="fixed"', "has 0 driven joints, a gripper has one"),
        ('<mimic joint="left_joint"/>', "", "has 2 driven joints (left_joint, right_joint), a gripper has one"),
        (
            '<mimic joint="left_joint"/>',
            '<mimic joint="lift"/>',
            "lets the joint 'right_joint' follow 'lift', which is",
        ),
        ('<mimic joint="left_joint"/>', '<mimic joint="camera_joint"/>', "follow the fixed joint 'camera_joint'"),
        ('<mimic joint="left_joint"/>', '<mimic joint="right_joint"/>', "lets the joint 'right_joint' follow itself"),
        (
            'joint="left_joint"/>',
            'joint="left_joint" multiplier="x"/>',
            "has multiplier='x' in <mimic> of 'right_joint'",
        ),
        ('joint="left_joint"/>', 'joint="left_joint" multiplier="0"/>', "follow with a multiplier of 0"),
        ('joint="left_joint"/>', 'joint="left_joint" multiplier="-1"/>', "never lets the pads 'left' and 'right' meet"),
        ('joint="left_joint"/>', 'joint="left_joint" multiplier="0.5"/>', "mm beside the tool axis"),
        ('joint="left_joint"/>', 'joint="left_joint" offset="0.01"/>', "mm beside the tool axis"),
        ('value="0.05"', 'value="0"', "has no mass or no inertia for link 'left'"),
        ('value="0.4"', 'value="0"', "has no mass or no inertia for link 'palm'"),
        ('xyz="0 0 0.06"', 'xyz="0 0 60"', "places a part of the link 'left' 60.04 m from the flange"),
        ('value="0.4"', 'value="400"', "gives the link 'palm' 400 kg"),
        ('effort="30"', 'effort="0"', "gives the driven joint 'left_joint' no effort"),
        ('lower="-0.01"', 'lower="0.03"', "leaves the driven joint 'left_joint' no travel"),
        ('upper="0.03" effort="30" ', "", "does not limit the driven joint 'left_joint'"),
        ("0.02 0.01 0.04", "0.02 0.08 0.04", "never opens the pads"),
        ('lower="-0.01" upper="0.03"', 'lower="0.0299" upper="0.03"', "never lets the pads 'left' and 'right' meet"),
        ('<box size="0.02 0.01 0.04"/>', '<sphere radius="0.005"/>', "has no flat face of 4 mm on the pad 'left'"),
        ('type="prismatic"', 'type="revolute"', "turns the pad 'left' by 2.29 deg over the stroke"),
        ('type="prismatic"', 'type="planar"', "has the planar joint 'left_joint'"),
        ('xyz="0 0 0.06"', 'xyz="0 zero 0.06"', "has xyz='0 zero 0.06' in <origin> of 'left_joint'"),
        ("</robot>", "", "is not XML"),
        (
            '<child link="camera"/>',
            '<child link="lens"/>',
            "lets the joint 'camera_joint' carry 'lens', which is not one of its links",
        ),
        ('<child link="camera"/>', '<child link="left"/>', "has several joints that carry the link 'left'"),
    ],
)
def test_a_mechanism_that_cannot_grip_is_refused_in_one_line(jaws, old, new, expected):
    with pytest.raises(DocumentError) as caught:
        jaws(old, new)
    (finding, *_) = [str(finding) for finding in caught.value.findings if expected in str(finding)]
    assert finding.startswith("g:")


@pytest.mark.parametrize(
    ("file", "expected"),
    [
        (FILE.replace("jaws.urdf", "claws.urdf"), "there is no file 'claws.urdf'"),
        (FILE.replace("jaws.urdf", "../jaws.urdf"), "leads out of the project"),
        (FILE + "palm: fist\n", "has no link 'fist'"),
        (FILE.replace("right]", "wrong]"), "has no link 'wrong' below the palm"),
        (FILE.replace("right]", "left]"), "has the link 'left' for both pads"),
        (FILE.replace("right]", "camera]"), "has no collision shape for the pad 'camera'"),
        (FILE + "mount: {at: [0 mm, 5 mm, 0 mm]}\n", "closes the pads 'left' and 'right' 5 mm beside the tool axis"),
        (FILE + "mount: {roll: 90 deg}\n", "never"),
        (FILE + "force: 16 N\n", "presses with 15 N on each pad, less than the force of 16 N"),
        (FILE + "speed: 0.2 m/s\n", "moves each pad at 0.1 m/s, less than the speed of 0.2 m/s"),
        (FILE + "speed: 0.1 mm/s\n", "speed must be at least 1 mm/s"),
        (FILE + "friction: 0\n", "friction must be greater than zero"),
        (FILE + "grasp_from_tip: 40 mm\n", "the grasp centre must lie on the pads, which are 40 mm long"),
    ],
)
def test_a_gripper_file_that_does_not_fit_its_urdf_is_refused(jaws, file, expected):
    with pytest.raises(DocumentError) as caught:
        jaws(file=file)
    assert any(expected in str(finding) for finding in caught.value.findings), str(caught.value)


def test_a_pad_that_approaches_and_parts_again_is_refused(two_finger, tmp_path):
    text = TWO_FINGER.read_text(encoding="utf-8").replace('lower="0" upper="0.7"', 'lower="-1.5" upper="0.7"')
    (tmp_path / TWO_FINGER.name).write_text(text, encoding="utf-8")
    with pytest.raises(DocumentError, match="approach and separate again"):
        load_gripper_file(tmp_path / "gripper.yaml")


def test_followers_of_followers_and_offsets_are_followed(jaws):
    joint = '<mimic joint="left_joint" multiplier="2" offset="-0.03"/>'
    chained = (
        JAWS.replace(
            '<joint name="camera_joint" type="fixed"><parent link="palm"/><child link="camera"/></joint>',
            '<joint name="camera_joint" type="prismatic"><parent link="palm"/><child link="camera"/>'
            f'<axis xyz="0 0 1"/>{joint}</joint>',
        )
        .replace(
            '<link name="camera"/>',
            '<link name="camera"><inertial><mass value="0.01"/>'
            '<inertia ixx="1e-6" iyy="1e-6" izz="1e-6" ixy="0" ixz="0" iyz="0"/></inertial></link>',
        )
        .replace('<mimic joint="left_joint"/>', '<mimic joint="camera_joint" multiplier="0.5" offset="0.015"/>')
    )
    file = jaws(JAWS, chained)
    linkage = file.geometry.linkage
    right = [link.name for link in linkage.links].index("right")

    assert (linkage.links[right].multiplier, linkage.links[right].offset) == pytest.approx((1.0, 0.0))
    poses = [linkage.link_poses(driven) for driven in (0.0, 0.01, 0.02)]
    heights = [one[[link.name for link in linkage.links].index("camera")].position_m[2] for one in poses]
    assert [later - before for before, later in pairwise(heights)] == pytest.approx([0.02, 0.02])
    assert poses[1][0] == Pose()
