"""Habits of URDFs that others publish, each from an arm of which the clean description is known."""

from __future__ import annotations

import shutil
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from rgss.cli.main import main
from rgss.errors import DefinitionError
from rgss.kinematics import Arm, ArmDynamics, Load
from rgss.scenes import Pose, link_solid
from rgss.studies.robot_project import robot_summary, write_robot_project
from rgss.studies.robot_project.urdf import arm_of_urdf
from tests.fixtures.serial_arms import SIX_WITHOUT_DECOMPOSITION as SIX
from tests.fixtures.serial_arms import serial_urdf
from tests.robots.test_arm_sizes import FOUR

CLEAN = serial_urdf(SIX)


def parsed(text):
    return ET.fromstring(text)  # noqa: S314 - the test's own text


def written(root):
    return ET.tostring(root, encoding="unicode")


def rationales(drafted):
    return " ".join(note.rationale for note in drafted.arm.notes)


def tool(drafted, q):
    return Arm(drafted.robot, Pose()).tool_matrix(np.array(q))


def test_names_that_are_no_identifiers_are_changed_and_the_arm_stays_the_same(draft):
    clean = draft(CLEAN)
    text = CLEAN.replace('"joint_1"', '" arm/joint 1 "').replace('"link_2"', '"2nd/link"')
    foreign = draft(text)
    assert foreign.robot.joints[0].name == "arm_joint_1"
    assert "'2nd/link' is link_2nd_link" in rationales(foreign)
    q = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8]
    assert tool(foreign, q) == pytest.approx(tool(clean, q), abs=1e-12)


def test_two_names_that_become_one_stay_two(draft):
    text = CLEAN.replace('"joint_1"', '"a/b"').replace('"joint_2"', '"a b"')
    assert [joint.name for joint in draft(text).robot.joints[:2]] == ["a_b", "a_b_2"]


def test_what_is_only_looked_at_may_be_missing(draft):
    seen = '<visual><geometry><mesh filename="package://other/none.dae"/></geometry></visual></link>'
    drafted = draft(CLEAN.replace("</link>", seen, 1))
    assert "package://other/none.dae" in rationales(drafted)
    assert drafted.robot.files == ()


def test_shapes_without_an_extent_are_left_out(draft):
    empty = '<collision><geometry><box size="0 0 0"/></geometry></collision></link>'
    drafted = draft(CLEAN.replace("</link>", empty, 1))
    assert "Collision shapes of zero size are left out" in rationales(drafted)


def test_mesh_files_without_a_face_are_left_out(tmp_path, draft):
    (package := tmp_path / "package").mkdir()
    (package / "frame.stl").write_bytes(bytes(80))
    (package / "frame.obj").write_bytes(b"# a frame\n")
    frames = [f'<geometry><mesh filename="{name}"/></geometry>' for name in ("frame.stl", "frame.obj")]
    empty = "".join(f"<{kind}>{frame}</{kind}>" for kind in ("visual", "collision") for frame in frames)
    drafted = draft(CLEAN.replace("</link>", empty + "</link>", 1))
    assert "Meshes without a single face are left out, of link_1." in rationales(drafted)
    assert "frame" not in next((tmp_path / "project").rglob("*.urdf")).read_text(encoding="utf-8")


def test_prefixes_of_old_simulators_do_no_harm(draft):
    text = CLEAN.replace("</robot>", '<gazebo><sensor:camera name="c"/></gazebo></robot>')
    assert len(draft(text).robot.joints) == 6


def test_a_robot_without_a_name_has_that_of_its_file(draft):
    root = parsed(CLEAN)
    del root.attrib["name"]
    assert draft(written(root)).robot.id == "arm"


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("<robot ", '<robot xmlns:xacro="http://x/xacro" ', None),
        ("</robot>", '<xacro:property name="width" value="0.2"/></robot>', None),
        ('<child link="link_1"/>', '<child link="nowhere"/>', "has the child link 'nowhere', which the URDF has not"),
        ("</robot>", '<link name="left"/></robot>', "2 links that nothing carries: base, left"),
        (
            "</robot>",
            '<joint name="rod" type="fixed"><parent link="base"/><child link="link_2"/></joint></robot>',
            "the URDF has a link that 2 joints carry: link_2, by joint_2, rod",
        ),
        ('effort="100"', 'effort="much"', "has effort='much' in <limit>"),
    ],
)
def test_what_no_engine_reads_is_refused_in_one_line(draft, old, new, message):
    assert old in CLEAN
    text = CLEAN.replace(old, new, 1)
    if message is None:
        assert len(draft(text).robot.joints) == 6
        return
    with pytest.raises(DefinitionError) as error:
        draft(text)
    assert message in str(error.value)


def test_a_slide_needs_a_range(draft):
    root = parsed(CLEAN)
    joint = root.find("joint")
    joint.set("type", "prismatic")
    joint.remove(joint.find("limit"))
    with pytest.raises(DefinitionError, match="the sliding joint joint_1 has no range"):
        draft(written(root))


def test_a_turn_without_a_range_is_half_a_turn_either_way_and_says_so(draft):
    root = parsed(CLEAN)
    joint = root.find("joint")
    joint.remove(joint.find("limit"))
    drafted = draft(written(root))
    assert drafted.robot.joints[0].upper_rad == pytest.approx(np.pi)
    assert "The URDF has no range of joint_1" in drafted.file.read_text(encoding="utf-8")


BOXES = '<collision><geometry><box size="0.1 0.2 {}"/></geometry></collision></link>'


def without_masses(sizes):
    """The arm without masses, each link a box as high as it is given, the base first."""
    root = parsed(CLEAN)
    for link, size in zip(root.findall("link"), sizes, strict=False):
        for part in list(link):
            link.remove(part)
        link.append(parsed(BOXES.format(size).removesuffix("</link>")))
    return written(root)


def test_the_mass_of_an_arm_is_shared_by_volume(draft):
    sizes = [0.4, 0.3, 0.1, 0.1, 0.05, 0.03, 0.02]
    with pytest.raises(DefinitionError) as error:
        draft(without_masses(sizes))
    assert "has no mass or no inertia for 6 links: link_1" in str(error.value)
    assert "--mass '20 kg'" in error.value.hint
    drafted = draft(without_masses(sizes), mass_kg=20.0)
    links = {link.get("name"): link for link in parsed(drafted.robot.urdf).findall("link")}
    moving = [*(f"link_{number}" for number in range(1, 6)), "flange"]
    found = [float(links[name].find("inertial/mass").get("value")) for name in moving]
    assert found == pytest.approx([20.0 * size for size in sizes[1:]])
    # A homogeneous box: m (b² + c²) / 12.
    inertia = links["link_1"].find("inertial/inertia")
    assert float(inertia.get("ixx")) == pytest.approx(6.0 * (0.2**2 + 0.3**2) / 12)
    assert "20 kg of the whole arm are distributed" in rationales(drafted)


def test_masses_are_kept_where_no_link_without_one_has_a_shape(draft):
    text = serial_urdf(SIX)
    start = text.index("<inertial>", text.index('name="link_3"'))
    end = text.index("</inertial>", start) + len("</inertial>")
    drafted = draft(text[:start] + text[end:], mass_kg=20.0)
    masses = [float(mass.get("value")) for mass in parsed(drafted.robot.urdf).iter("mass")]
    assert sum(masses) == pytest.approx(5.015, abs=1e-4)
    note = (
        "link_3 have neither a mass nor a shape in the URDF, and weigh 0.015 kg each: the 5 kg of the other links are"
    )
    assert f"{note} kept, not scaled to 20 kg" in rationales(drafted)


def test_a_mass_that_is_none(draft, tmp_path, capsys):
    with pytest.raises(DefinitionError, match="every link of the arm has a mass"):
        draft(CLEAN, mass_kg=20.0)
    one = without_masses([0.1, 0.1])
    with pytest.raises(DefinitionError, match="--mass is 1 kg, and the links that state a mass weigh 5 kg"):
        draft(one, mass_kg=1.0)
    urdf = tmp_path / "package" / "arm.urdf"
    for mass, message in (("0 kg", "--mass must be greater than zero, got"), ("20 m", "--mass: ")):
        assert main(["init", "--robot", str(urdf), "--mass", mass, str(tmp_path / "new")]) == 2
        assert message in capsys.readouterr().err
    assert main(["init", "--mass", "20 kg", str(tmp_path / "new")]) == 2
    assert "--mass is that of the arm of a URDF" in capsys.readouterr().err


def test_a_link_fixed_to_one_with_a_mass_is_weighed_with_it(draft):
    more = (
        '<link name="plate"><collision><geometry><box size="0.1 0.1 0.01"/></geometry></collision></link>'
        '<joint name="plate_joint" type="fixed"><parent link="flange"/><child link="plate"/></joint></robot>'
    )
    drafted = draft(CLEAN.replace("</robot>", more))
    assert "plate have no mass in the URDF, and are fixed to links that have one" in rationales(drafted)


def test_a_mass_without_an_inertia_is_a_homogeneous_body(draft):
    root = parsed(CLEAN)
    link = next(link for link in root.findall("link") if link.get("name") == "link_2")
    link.find("inertial").remove(link.find("inertial/inertia"))
    link.append(parsed('<collision><geometry><sphere radius="0.1"/></geometry></collision>'))
    drafted = draft(written(root))
    links = {link.get("name"): link for link in parsed(drafted.robot.urdf).findall("link")}
    inertia = links["link_2"].find("inertial/inertia")
    mass = float(links["link_2"].find("inertial/mass").get("value"))
    assert float(inertia.get("iyy")) == pytest.approx(0.4 * mass * 0.1**2)


def test_a_solid_of_several_shapes_obeys_steiner():
    """Two halves of a cylinder are the cylinder."""
    half = '<collision><origin xyz="0 0 {}"/><geometry><cylinder radius="0.1" length="0.2"/></geometry></collision>'
    link = parsed(f"<link>{half.format(0.1)}{half.format(-0.1)}</link>")
    whole = parsed('<link><visual><geometry><cylinder radius="0.1" length="0.4"/></geometry></visual></link>')
    found, wanted = link_solid(link, lambda _: None), link_solid(whole, lambda _: None)
    assert found.volume_m3 == pytest.approx(wanted.volume_m3)
    assert found.centre_m == pytest.approx(np.zeros(3), abs=1e-15)
    assert found.inertia_m5 == pytest.approx(wanted.inertia_m5, abs=1e-12)


CUBE = """solid cube
{}endsolid cube
"""


def cube_stl():
    """A tetrahedron of 0.1 m."""
    corners = [(0, 0, 0), (0.1, 0, 0), (0, 0.1, 0), (0, 0, 0.1)]
    facets = ""
    for a, b, c in ((0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)):
        rows = "".join("vertex {} {} {}\n".format(*corners[index]) for index in (a, b, c))
        facets += f"facet normal 0 0 0\nouter loop\n{rows}endloop\nendfacet\n"
    return CUBE.format(facets)


@pytest.mark.parametrize(
    ("name", "place"),
    [
        ("package://other/meshes/part.stl", "meshes/part.stl"),
        ("package://stated/meshes/part.stl", "meshes/part.stl"),
        ("package://deep/other/meshes/part.STL", "meshes/part.stl"),
        ("meshes\\\\part.stl", "meshes/part.stl"),
        ("model://other/meshes/part.stl", "meshes/part.stl"),
        ("../part.stl", "../part.stl"),
    ],
)
def test_files_are_found_in_packages_of_another_name(draft, tmp_path, name, place):
    path = tmp_path / "package" / place
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(cube_stl(), encoding="utf-8")
    (tmp_path / "package" / "package.xml").write_text("<package><name>stated</name></package>", encoding="utf-8")
    mesh = f'<collision><geometry><mesh filename="{name}"/></geometry></collision></link>'
    drafted = draft(CLEAN.replace("</link>", mesh, 1))
    assert len(drafted.robot.files) == 1


def test_the_gripper_points_away_from_the_arm_where_z_does_not(tmp_path):
    """An arm whose last link has z up: the frame of the gripper is turned, and the arm works as the one with z out."""
    from tests.robots.conftest import urdf_of

    text = urdf_of("six").read_text(encoding="utf-8")
    root = parsed(text)
    last = [joint for joint in root.findall("joint") if joint.get("type") == "revolute"][-1]
    name = last.find("child").get("link")
    ET.SubElement(root, "link", {"name": "sideways"})
    joint = ET.SubElement(root, "joint", {"name": "sideways_joint", "type": "fixed"})
    # Its -x axis is the z axis of the last link.
    ET.SubElement(joint, "origin", {"xyz": "0 0 0", "rpy": "0 1.5707963267948966 0"})
    ET.SubElement(joint, "parent", {"link": name})
    ET.SubElement(joint, "child", {"link": "sideways"})
    package = tmp_path / "xarm"
    shutil.copytree(urdf_of("six").parent, package)
    (package / "sideways.urdf").write_text(written(root), encoding="utf-8")
    project = write_robot_project(package / "sideways.urdf", tmp_path / "project", flange="sideways")
    assert any("points along the -x axis of sideways" in note.rationale for note in project.notes)


def test_efforts_that_are_stated_assumptions_are_notes(projects, draft, tmp_path):
    text = CLEAN.replace('effort="100"', 'effort="0"')
    drafted = draft(text)
    found = robot_summary(drafted.file).findings
    assert {finding.severity.value for finding in found if finding.rule == "robot.limit"} == {"info"}
    found = robot_summary(tmp_path / "package" / "arm.urdf").findings
    assert {finding.severity.value for finding in found if finding.rule == "robot.limit"} == {"warning"}


def test_an_arm_whose_shapes_reach_below_its_base_has_a_lower_pedestal(tmp_path):
    from tests.robots.conftest import urdf_of

    package = tmp_path / "xarm"
    shutil.copytree(urdf_of("six").parent, package)
    root = parsed(urdf_of("six").read_text(encoding="utf-8"))
    first = next(joint for joint in root.findall("joint") if joint.get("type") == "revolute").find("child").get("link")
    link = next(link for link in root.findall("link") if link.get("name") == first)
    # The first joint is 267 mm above the base, so that this ball ends 133 mm below it.
    ball = '<collision><origin xyz="0 0 -0.3"/><geometry><sphere radius="0.1"/></geometry></collision>'
    link.append(parsed(ball))
    (package / "below.urdf").write_text(written(root), encoding="utf-8")
    write_robot_project(package / "below.urdf", tmp_path / "project")
    scene = (tmp_path / "project" / "scenes" / "kitchen.yaml").read_text(encoding="utf-8")
    assert "height: 0.45 m" in scene
    assert "The pedestal ends below the arm's base" in scene


def test_rounded_right_angles_of_an_arm_of_few_joints_are_exact(draft):
    """An arm whose pitch axes are 0.8 mrad off could never turn its tool exactly down."""
    text = serial_urdf(FOUR)
    rounded = text.replace('rpy="0.0 0.0 0.0"', 'rpy="0 -1.57 3.1416"')
    foreign = draft(rounded)
    assert "Rounded right angles are made exact, of the frames of joint_1, joint_2" in rationales(foreign)
    exact = draft(text.replace('rpy="0.0 0.0 0.0"', f'rpy="0 {-np.pi / 2} {np.pi}"'))
    q = [0.3, -0.4, 0.5, 0.6]
    assert tool(foreign, q) == pytest.approx(tool(exact, q), abs=1e-9)
    assert "right angles" not in rationales(draft(CLEAN.replace('rpy="0.0 0.0 0.0"', 'rpy="0 -1.57 0"')))


def test_materials_without_a_colour_are_left_out(draft, capfd):
    shape = '<geometry><box size="0.1 0.1 0.1"/></geometry>'
    plain = f'<visual>{shape}<material name="none"/></visual><visual>{shape}<material name="given"/></visual></link>'
    text = CLEAN.replace("</link>", plain, 1).replace(
        "</robot>",
        '<material name="none"><color/><texture filename="none.png"/></material>'
        '<material name="given"><color rgba="1 0 0 1"/></material></robot>',
    )
    foreign = draft(text)
    tool(foreign, [0.0] * 6)
    assert "none" not in foreign.robot.urdf
    assert 'name="given"' in foreign.robot.urdf
    assert "Material" not in "".join(capfd.readouterr())


def test_a_joint_may_have_the_name_of_a_link(draft):
    clean = draft(CLEAN)
    foreign = draft(CLEAN.replace('"joint_6"', '"flange"').replace('"joint_2"', '"link_2"'))
    assert [joint.name for joint in foreign.robot.joints] == [
        {"joint_6": "flange", "joint_2": "link_2"}.get(joint.name, joint.name) for joint in clean.robot.joints
    ]
    q, still, moving = [0.3, -0.4, 0.5, 0.6, -0.7, 0.8], [0.0] * 6, [0.1, 0.2, -0.3, 0.4, -0.5, 0.6]
    assert tool(foreign, q) == pytest.approx(tool(clean, q), abs=1e-12)
    load = Load(
        mass_kg=2.0, moments_kg_m2=(0.01, 0.02, 0.03), pose=Pose.from_roll_pitch_yaw((0.1, 0.0, 0.2), (0.1, 0.2, 0.3))
    )
    torques = [
        ArmDynamics(one.robot, [load], gravity_m_s2=9.81).torques(np.array(q), np.array(still), np.array(moving))
        for one in (clean, foreign)
    ]
    assert torques[0] == pytest.approx(torques[1], abs=1e-12)


@pytest.mark.parametrize(("name", "is_noted"), [("gripper", True), ("moving_Jaw_joint", True), ("joint_6", False)])
def test_a_last_joint_named_for_a_jaw_is_noted(name, is_noted):
    joints = ["joint_1", "joint_2", name]
    links = "".join(f'<link name="link_{place}"/>' for place in range(4))
    chain = "".join(
        f'<joint name="{joint}" type="revolute"><parent link="link_{place}"/><child link="link_{place + 1}"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for place, joint in enumerate(joints)
    )
    root = parsed(f'<robot name="arm">{links}{chain}</robot>')
    found, stated = arm_of_urdf(root), arm_of_urdf(root, flange="link_2")
    assert (found.flange, len(found.joints)) == ("link_3", 3)
    reasons = [note.rationale for note in found.notes]
    expected = (
        f"The joint {name} counts as the arm's last, although by its name it may drive a jaw: with --flange link_2 the "
        "arm ends before it."
    )
    assert reasons == ([expected] if is_noted else [])
    assert (stated.flange, stated.hands, stated.notes) == ("link_2", ("link_3",), ())
