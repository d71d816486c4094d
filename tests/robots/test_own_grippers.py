"""A new project with the gripper of a URDF: the hand that an arm has, or a gripper alone."""

from __future__ import annotations

import json
import math
import re
import shutil
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest
import trimesh
import yaml

from rgss.cli.main import main
from rgss.errors import DefinitionError
from rgss.scenes import load_gripper_file
from rgss.studies.robot_project.drafted_gripper import drafted_gripper
from tests.robots.conftest import urdf_of
from tests.scenes.linkage_texts import JAWS
from tests.trials.hands.gripper_files import TWO_FINGER, with_thin_pads

pytestmark = pytest.mark.engine

CLOSED_ALONG = ("z", "x", "y", "-x", "-y", "-z")
TURNS = {
    "z": (0, 0, 0),
    "x": (0, 90, 0),
    "y": (-90, 0, 0),
    "-x": (0, -90, 0),
    "-y": (90, 0, 0),
    "-z": (180, 0, 0),
}
RIGHT_ALONE = JAWS.replace(
    '<mimic joint="left_joint"/>', '<limit lower="-0.01" upper="0.03" effort="30" velocity="0.1"/>'
)
WITH_A_HAND = ("arm with a hand", "gripper alone")


def init(folder, *options):
    return main(["init", "--robot", *options, str(folder)])


def one_gripper(project):
    (file,) = (project / "scenes" / "grippers").glob("*.yaml")
    return yaml.safe_load(file.read_text(encoding="utf-8"))


@pytest.fixture(scope="module", params=WITH_A_HAND)
def project(request, tmp_path_factory):
    """A project round an arm with its own hand, and round one with a gripper of cranks."""
    folder = tmp_path_factory.mktemp("own") / "project"
    arm, gripper = (
        (urdf_of("seven with a hand"), urdf_of("seven with a hand"))
        if request.param == WITH_A_HAND[0]
        else (urdf_of("six"), TWO_FINGER)
    )
    assert init(folder, str(arm), "--gripper", str(gripper)) == 0
    return folder


def test_the_project_ends_in_a_decision_by_contact_trials(project, capsys):
    study = project / "studies" / "pick_place.yaml"
    study.write_text(
        study.read_text(encoding="utf-8").replace("replicates: 2", "replicates: 1"),
        encoding="utf-8",
    )
    status = main(["check", "--project", str(project)])
    text = capsys.readouterr().out
    assert status == (1 if "robot.inertia" in text else 0)  # one of the arms has inertias that no body has
    assert "error" not in text
    assert main(["sweep", "--jobs", "1", "--json", "--project", str(project)]) == 0
    capsys.readouterr()
    assert main(["measure", "--json", "--project", str(project)]) == 0
    measured = json.loads(capsys.readouterr().out)
    successes = {row["variant"]: row["value"] for row in measured if row["measure"] == "success"}
    assert successes == dict.fromkeys((1, 2, 3, 4), 1.0)
    assert main(["trade", "--json", "--project", str(project)]) in (0, 1)
    # The firmer grip has the greater payload.
    assert json.loads(capsys.readouterr().out)["chosen"] in (3, 4)


def test_the_hand_is_where_the_urdf_has_it(tmp_path):
    assert (
        init(tmp_path / "new", str(urdf_of("seven with a hand")), "--gripper", str(urdf_of("seven with a hand"))) == 0
    )
    gripper = one_gripper(tmp_path / "new")
    root = ET.parse(urdf_of("seven with a hand")).getroot()  # noqa: S314 - it comes with the engine
    joint = next(one for one in root if one.get("name") == "panda_hand_joint")
    roll, pitch, yaw = (math.degrees(float(word)) for word in joint.find("origin").get("rpy").split())

    assert gripper["palm"] == "panda_hand"
    assert gripper["pads"] == ["panda_leftfinger", "panda_rightfinger"]
    assert gripper["mount"] == {"yaw": f"{yaw:.0f} deg"}
    assert (roll, pitch) == (0.0, 0.0)
    robot = yaml.safe_load((tmp_path / "new" / "scenes" / "robots" / "panda.yaml").read_text(encoding="utf-8"))
    assert robot["without"] == ["panda_hand"]


def arm_with(tmp_path, added):
    """The arm of six joints with more links and joints, in a folder with its meshes."""
    source = urdf_of("six")
    shutil.copytree(source.parent, tmp_path / "arm")
    urdf = tmp_path / "arm" / source.name
    text = urdf.read_text(encoding="utf-8")
    assert text.count("</robot>") == 1
    urdf.write_text(text.replace("</robot>", f"{added}</robot>"), encoding="utf-8")
    return urdf


def test_fingers_on_the_last_link_of_the_arm_are_a_hand(tmp_path):
    fingers = re.sub(
        r"(?s).*?(  <link name=\"left\">.*)  <link name=\"camera\"/>(.*)  <joint name=\"camera.*", r"\1\2", JAWS
    )
    urdf = arm_with(tmp_path, fingers.replace('link="palm"', 'link="link6"').replace('xyz="0 0 0.06"', 'xyz="0 0 0.1"'))
    assert init(tmp_path / "new", str(urdf), "--gripper", str(urdf)) == 0
    gripper = one_gripper(tmp_path / "new")
    assert (gripper["palm"], gripper["pads"]) == ("link6_palm", ["left", "right"])
    (file,) = (tmp_path / "new" / "scenes" / "robots").glob("*.yaml")
    robot = yaml.safe_load(file.read_text(encoding="utf-8"))
    assert robot["without"] == ["link6_palm"]
    reasons = [one["rationale"] for one in robot["assumptions"] if one["about"] == "description"]
    assert any(reason.startswith("The fingers move on link6, a link of the arm") for reason in reasons)
    # The pads are where the URDF has them, 120 mm from the last link, of which the mount is 100 mm away.
    (path,) = (tmp_path / "new" / "scenes" / "grippers").glob("*.yaml")
    geometry = load_gripper_file(path, project=tmp_path / "new").geometry
    assert geometry.base.height_m + geometry.finger.size_m[2] / 2 == pytest.approx(0.02)
    assert geometry.largest_opening_m == pytest.approx(0.03)
    assert main(["run", "1", "--project", str(tmp_path / "new")]) == 0


def test_what_turns_beside_a_hand_is_left_out(tmp_path, capsys):
    jaws = re.sub(r"(?s)<robot[^>]*>|</robot>", "", JAWS)
    added = f"""{jaws}
  <joint name="palm_joint" type="fixed"><parent link="link6"/><child link="palm"/></joint>
  <link name="motor"/>
  <joint name="motor_joint" type="continuous">
    <parent link="link6"/><child link="motor"/><axis xyz="0 0 1"/><limit effort="1" velocity="1"/>
  </joint>"""
    urdf = arm_with(tmp_path, added)
    assert init(tmp_path / "new", str(urdf), "--gripper", str(urdf)) == 0
    assert "motor of the URDF, beside the palm, is left out." in capsys.readouterr().err
    assert one_gripper(tmp_path / "new")["palm"] == "palm"
    (file,) = (tmp_path / "new" / "scenes" / "robots").glob("*.yaml")
    assert sorted(yaml.safe_load(file.read_text(encoding="utf-8"))["without"]) == ["motor", "palm"]


def turned(text, angles_deg):
    """A gripper whose base frame is turned, with the gripper itself as it was."""
    roll, pitch, yaw = (math.radians(angle) for angle in angles_deg)
    base = (
        '<link name="base"/><joint name="base_joint" type="fixed"><parent link="base"/><child link="palm"/>'
        f'<origin xyz="0 0 0" rpy="{roll!r} {pitch!r} {yaw!r}"/></joint></robot>'
    )
    return text.replace("</robot>", base)


@pytest.mark.parametrize("axis", CLOSED_ALONG)
def test_a_gripper_is_mounted_along_its_own_axis(tmp_path, axis):
    """The same gripper in a frame whose axis is any of six is the same gripper at the flange."""
    plain, other = tmp_path / "plain.urdf", tmp_path / "other.urdf"
    text = TWO_FINGER.read_text(encoding="utf-8")
    plain.write_text(text, encoding="utf-8")
    other.write_text(turned(text, TURNS[axis]), encoding="utf-8")
    one, same = drafted_gripper(plain, tmp_path / "one"), drafted_gripper(other, tmp_path / "same")

    for name in ("largest_opening_m", "stroke_m", "grasp_depth_m"):
        assert getattr(same.geometry, name) == pytest.approx(getattr(one.geometry, name), abs=1e-9)
    assert (same.force_n, same.cups) == (one.force_n, one.cups)
    text = (tmp_path / "same" / "scenes" / "grippers" / "two_finger.yaml").read_text(encoding="utf-8")
    assert "pads: [left_tip, right_tip]" in text
    assert ("mount:" in text) is (axis != "z")


def test_fingers_that_are_driven_alike_follow_each_other(tmp_path):
    alone, with_mimic = tmp_path / "alone.urdf", tmp_path / "mimic.urdf"
    alone.write_text(RIGHT_ALONE, encoding="utf-8")
    with_mimic.write_text(JAWS, encoding="utf-8")
    found, expected = drafted_gripper(alone, tmp_path / "one"), drafted_gripper(with_mimic, tmp_path / "other")

    assert found.geometry.linkage == replace(expected.geometry.linkage, effort=60.0)
    # 30 N of each motor on each pad, of which the project demands 20 N at most; with a mimic joint both share them.
    speeds_and_forces = [load_gripper_file(path).settings for path in sorted(tmp_path.rglob("jaws.yaml"))]
    assert sorted(one["gripper.finger.force"] for one in speeds_and_forces) == [15.0, 30.0]
    assert found.notes[0].rationale == (
        "The URDF drives left_joint and right_joint alike; right_joint follows left_joint here, with the effort of "
        "both, 60 N."
    )
    file = load_gripper_file(tmp_path / "one" / "scenes" / "grippers" / "jaws.yaml")
    assert file.geometry == found.geometry


def test_a_mirrored_range_is_followed_backwards(tmp_path):
    mirrored = RIGHT_ALONE.replace('<axis xyz="0 -1 0"/>', '<axis xyz="0 1 0"/>').replace(
        '<limit lower="-0.01" upper="0.03" effort="30" velocity="0.1"/>\n  </joint>\n  <joint name="camera',
        '<limit lower="-0.03" upper="0.01" effort="30" velocity="0.1"/>\n  </joint>\n  <joint name="camera',
    )
    urdf, plain = tmp_path / "mirrored.urdf", tmp_path / "plain.urdf"
    urdf.write_text(mirrored, encoding="utf-8")
    plain.write_text(JAWS, encoding="utf-8")
    found, expected = drafted_gripper(urdf, tmp_path / "one"), drafted_gripper(plain, tmp_path / "other")

    assert 'multiplier="-1"' in (tmp_path / "one" / "scenes" / "grippers" / "jaws.urdf").read_text(encoding="utf-8")
    assert found.geometry.largest_opening_m == pytest.approx(expected.geometry.largest_opening_m)
    assert found.geometry.stroke_m == pytest.approx(expected.geometry.stroke_m)


@pytest.mark.parametrize(("kind", "assumed"), [("prismatic", ("0.05 m/s", "40 N")), ("revolute", ("1 rad/s", "2 N*m"))])
def test_a_drive_without_speed_or_effort_is_assumed(tmp_path, kind, assumed):
    text = JAWS if kind == "prismatic" else TWO_FINGER.read_text(encoding="utf-8")
    lacking = re.sub(r'effort="[^"]*" velocity="[^"]*"', 'effort="0" velocity="0"', text)
    assert lacking != text
    (tmp_path / "g.urdf").write_text(lacking, encoding="utf-8")
    drafted = drafted_gripper(tmp_path / "g.urdf", tmp_path / "project")

    found = {note.about: note.rationale for note in drafted.notes if note.rationale.startswith("The URDF has no")}
    assert list(found) == ["speed", "force"]
    for rationale, value in zip(found.values(), assumed, strict=True):
        assert rationale.endswith(f": {value}.")
    assert drafted.force_n > 0.0


FINGER = """<collision><geometry><mesh filename="{}.stl"/></geometry></collision>"""


@pytest.fixture
def bossed(tmp_path):
    """The jaws with meshes of two boxes: a pad, and before it a boss of 14 mm near the palm; their hull has no pad."""
    text = JAWS
    for name, sign in (("left", 1.0), ("right", -1.0)):
        pad = trimesh.creation.box(bounds=[[-0.01, 0.0, 0.0], [0.01, 0.01, 0.04]])
        boss = trimesh.creation.box(bounds=[[-0.01, -0.014, 0.0], [0.01, 0.0, 0.003]])
        mesh = trimesh.util.concatenate([pad, boss])
        mesh.apply_scale([1.0, sign, 1.0])
        mesh.fix_normals()
        mesh.export(tmp_path / f"{name}.stl")
        before, link, after = text.partition(f'<link name="{name}">')
        text = before + link + re.sub(r"<collision>.*</collision>", FINGER.format(name), after, count=1)
    (tmp_path / "jaws.urdf").write_text(text, encoding="utf-8")
    return tmp_path / "jaws.urdf"


def test_a_finger_with_a_boss_has_its_pad_in_the_parts_of_its_mesh(bossed, tmp_path):
    with pytest.raises(DefinitionError, match=r"^jaws\.urdf "):
        drafted_gripper(bossed, tmp_path / "hull")
    geometry = drafted_gripper(bossed, tmp_path / "parts", is_decomposed=True).geometry

    assert geometry.finger.size_m == pytest.approx((0.01, 0.02, 0.037), abs=1e-6)
    assert geometry.largest_opening_m == pytest.approx(0.03, abs=1e-6)
    assert geometry.least_opening_m == pytest.approx(0.014, abs=1e-6)
    assert geometry.palm_height_m == pytest.approx(0.063, abs=1e-6)
    (cup, *_) = drafted_gripper(bossed, tmp_path / "again", is_decomposed=True).cups
    # Its top stays 10 mm below the bosses.
    assert geometry.grasp_depth_m - cup.height_m / 2 >= 0.063 + 0.01 - 1e-9


def test_a_palm_is_divided_only_if_the_fingers_have_pads(bossed, tmp_path):
    """To divide a palm of 37,000 faces takes ten minutes, and fingers without pads are refused all the same."""
    trimesh.creation.annulus(0.02, 0.03, 0.06).export(tmp_path / "palm.stl")
    text = bossed.read_text(encoding="utf-8")
    palm = re.search(r"<geometry><cylinder[^>]*></geometry>", text).group()
    text = text.replace(palm, '<geometry><mesh filename="palm.stl"/></geometry>')
    bossed.write_text(text, encoding="utf-8")
    drafted_gripper(bossed, tmp_path / "pads", is_decomposed=True)
    assert list((tmp_path / "pads").rglob("palm_0/palm_0.stl"))

    for name, sign in (("left", 1.0), ("right", -1.0)):
        mesh, beside = (trimesh.creation.icosphere(radius=0.01) for _ in range(2))
        mesh.apply_translation([0.0, sign * 0.01, 0.0])
        beside.apply_translation([0.0, sign * 0.01, 0.04])
        trimesh.util.concatenate([mesh, beside]).export(tmp_path / f"{name}.stl")
    with pytest.raises(DefinitionError, match=r"^jaws\.urdf .*on the pad") as refused:
        drafted_gripper(bossed, tmp_path / "none", is_decomposed=True)
    assert "e-" not in refused.value.message
    assert list((tmp_path / "none").rglob("left_0/left_0.stl"))
    assert not list((tmp_path / "none").rglob("palm_0/*"))


def test_a_fast_gripper_of_long_pads_is_slowed_and_grasps_near_its_tips(tmp_path):
    drafted = drafted_gripper(TWO_FINGER, tmp_path)
    text = (tmp_path / "scenes" / "grippers" / "two_finger.yaml").read_text(encoding="utf-8")

    assert "speed: 50 mm/s" in text
    assert "grasp_from_tip: 14 mm" in text
    assert [note.about for note in drafted.notes] == ["speed", "grasp_from_tip"]


def test_what_carries_a_pad_takes_no_room_above_the_object(tmp_path):
    """A pad of its own before each tip, without a mass: the object of the new project is as large as without them."""
    urdf = tmp_path / "two_finger.urdf"
    urdf.write_text(with_thin_pads(TWO_FINGER.read_text(encoding="utf-8")), encoding="utf-8")
    plain = drafted_gripper(TWO_FINGER, tmp_path / "plain")
    own = drafted_gripper(urdf, tmp_path / "own")

    assert "pads: [left_pad, right_pad]" in (tmp_path / "own/scenes/grippers/two_finger.yaml").read_text("utf-8")
    assert own.geometry.grasp_depth_m > plain.geometry.grasp_depth_m - 2e-3
    for one, other in zip(own.cups, plain.cups, strict=True):
        assert (one.radius_m, one.height_m) == pytest.approx((other.radius_m, other.height_m), abs=3e-3)


BACK_TO_THE_PALM = '<joint name="back" type="fixed"><parent link="left"/><child link="palm"/></joint></robot>'
ONE_FINGER = re.sub(
    r"  <link name=\"right\">(?s:.*?)</link>\n|  <joint name=\"right_joint\"(?s:.*?)</joint>\n", "", JAWS
)

PALM = (
    '<link name="palm"><inertial><mass value="0.4"/>'
    '<inertia ixx="5e-4" iyy="5e-4" izz="6e-4" ixy="0" ixz="0" iyz="0"/></inertial>'
    '<collision><geometry><box size="0.1 0.1 0.06"/></geometry></collision></link>'
)


def sliding_finger(number, azimuth_deg, follows):
    """A link with a face towards the axis of the palm, on a slide at an azimuth."""
    return (
        f'<link name="f{number}"><inertial><mass value="0.03"/>'
        '<inertia ixx="7e-6" iyy="7e-6" izz="1e-6" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<collision><origin xyz="0 0 0.03"/><geometry><box size="0.01 0.02 0.05"/></geometry></collision></link>'
        f'<joint name="j{number}" type="prismatic"><parent link="palm"/><child link="f{number}"/>'
        f'<origin xyz="0 0 0.03" rpy="0 0 {math.radians(azimuth_deg)}"/><axis xyz="1 0 0"/>'
        f'<limit lower="0.006" upper="0.04" effort="20" velocity="0.05"/>{follows}</joint>'
    )


FOLLOWS = '<mimic joint="j0"/>'
FINGERS = [sliding_finger(0, 30, ""), sliding_finger(1, 150, FOLLOWS), sliding_finger(2, 270, FOLLOWS)]
THREE_FINGERS = f'<robot name="three">{PALM}{"".join(FINGERS)}</robot>'
SEVERAL = (
    "gripper.urdf has 3 fingers that slide towards its axis, and a linkage has two pads that face each other (state it "
    "by its sizes in a gripper file (kind: fingers, azimuths: [30 deg, 150 deg, 270 deg]))"
)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (THREE_FINGERS, SEVERAL),
        (
            ONE_FINGER.replace("<collision>", "<visual>").replace("</collision>", "</visual>"),
            "no two links with a coll",
        ),
        (ONE_FINGER, "gripper.urdf has no two links that close on an object (a pad is a link with a flat face)"),
        (
            RIGHT_ALONE.replace('upper="0.03"', 'upper="0.02"', 1),
            "gripper.urdf has 2 driven joints (left_joint, right_j",
        ),
        (JAWS.replace("0 1 0", "1 0 0").replace("0 -1 0", "1 0 0"), "never lets the pads 'left' and 'right' meet"),
        (JAWS.replace("</robot>", ""), "is not XML"),
        (
            JAWS.replace("</robot>", BACK_TO_THE_PALM),
            "gripper.urdf has a joint that carries its palm (a gripper begins",
        ),
    ],
)
def test_what_is_no_gripper_is_said_in_one_line(tmp_path, capsys, text, message):
    urdf = tmp_path / "gripper.urdf"
    urdf.write_text(text, encoding="utf-8")

    assert init(tmp_path / "new", str(urdf_of("six")), "--gripper", str(urdf)) == 2
    error = capsys.readouterr().err
    assert message in error
    assert len(error.splitlines()) == 1
    assert not (tmp_path / "new").exists()


def test_an_arm_without_a_hand_has_none_to_use(tmp_path, capsys):
    assert init(tmp_path / "new", str(urdf_of("seven")), "--gripper", str(urdf_of("seven"))) == 2
    assert capsys.readouterr().err == (
        "rgss: model.urdf has no hand at lbr_iiwa_link_7: one link that is fixed to it and carries the fingers is "
        "expected, found nothing (name the link that carries the hand with --flange, or give the URDF of a gripper "
        "alone)\n"
    )


def test_a_gripper_needs_an_arm(tmp_path, capsys):
    assert main(["init", "--gripper", str(TWO_FINGER), str(tmp_path / "new")]) == 2
    assert capsys.readouterr().err == "rgss: --gripper is for the arm of a URDF (give the URDF with --robot)\n"


def test_a_gripper_that_is_not_there(tmp_path, capsys):
    assert init(tmp_path / "new", str(urdf_of("six")), "--gripper", str(tmp_path / "no.urdf")) == 2
    assert "no.urdf cannot be read" in capsys.readouterr().err
