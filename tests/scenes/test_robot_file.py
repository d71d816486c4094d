import hashlib
import math
from dataclasses import replace

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
        f"{kitchen.marks()[0]} scene.duplicate-id joint 'joint_3' is listed twice "
        "(name each joint of the arm once, from the base to the flange)"
    )


def test_a_joint_that_is_left_out_is_named(kitchen):
    text = kitchen.texts["robots/six.yaml"]
    line = next(line for line in text.splitlines() if "joint_6" in line)
    kitchen.change("robots/six.yaml", line + "\n", "")
    found = kitchen.findings("robot")
    assert any("home has 6 positions, and the arm 5 joints" in finding for finding in found)
    names = ", ".join(f"joint_{number}" for number in range(1, 7))
    assert any(f"the movable joints {names}" in finding for finding in found)


def test_all_problems_come_at_once(kitchen):
    kitchen.change("robots/six.yaml", "[-170 deg, 180 deg]", "¦[180 deg, 170 deg]")
    kitchen.change("robots/six.yaml", "torque: 150", "torque: ¦0")
    kitchen.change("robots/six.yaml", "name: joint_4", "name: ¦wrist")
    assert [finding.split()[0] for finding in kitchen.findings("robot")] == kitchen.marks()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("home: [0 deg", "home: [¦1000 deg", "'joint_1' is 1000 deg, above its upper limit of 180 deg"),
        ("45 deg]", "¦-130.5 deg]", "'joint_6' is -130.5 deg, below its lower limit of -130 deg"),
    ],
)
def test_a_home_outside_a_joint_s_range_is_found(kitchen, old, new, message):
    kitchen.change("robots/six.yaml", old, new)
    (finding,) = kitchen.findings("robot")
    assert finding.startswith(f"{kitchen.marks()[0]} scene.home home of joint {message} (give a position from ")


def test_a_home_at_the_end_of_a_range_is_taken(kitchen):
    kitchen.change("robots/six.yaml", "45 deg]", "180 deg]")
    assert kitchen.robot().home_rad[5] == kitchen.robot().joints[5].upper_rad


@pytest.fixture
def elsewhere(tmp_path_factory):
    """A folder outside the kitchen's with a sound URDF and robot file."""
    return tmp_path_factory.mktemp("elsewhere")


@pytest.mark.parametrize("how", ["absolute", "dots", "link", "dangling"])
@pytest.mark.parametrize("what", ["robot", "scene"])
def test_a_description_that_is_not_in_the_project_is_found_where_it_is_named(kitchen, elsewhere, what, how):
    file, name, old = {
        "robot": ("robots/six.yaml", "six.urdf", "description: six.urdf"),
        "scene": ("kitchen.yaml", "six.yaml", "description: robots/six.yaml"),
    }[what]
    kitchen.scene()
    if how != "dangling":
        for source in ("six.urdf", "six.yaml"):
            (elsewhere / source).write_bytes((kitchen.folder / "robots" / source).read_bytes())
    if how == "absolute":
        named = str(elsewhere / name)
    elif how == "dots":
        named = "/".join([".."] * len(kitchen.folder.parts)) + str(elsewhere / name)
    else:
        named = "away"
        (kitchen.folder / file).parent.joinpath(named).symlink_to(elsewhere / name)
    kitchen.change(file, old, f"description: ¦{named}")
    (finding,) = kitchen.findings(what)
    place, rule, message = finding.split(" ", 2)
    assert (place, rule) == (kitchen.marks()[0], "scene.outside")
    assert ("is not a relative path" if how == "absolute" else "leads out of the project") in message
    assert "copy the file into the project" in message


def test_a_link_within_the_project_is_followed(kitchen):
    kitchen.scene()
    (kitchen.folder / "robots/other.urdf").symlink_to("six.urdf")
    kitchen.change("robots/six.yaml", "description: six.urdf", "description: other.urdf")
    assert kitchen.scene().robot.urdf == kitchen.texts["robots/six.urdf"]


def seen(mesh: str) -> str:
    return f'<visual><geometry>\n<mesh filename="{mesh}"/></geometry></visual></link>'


def with_mesh(kitchen, element: str):
    text = kitchen.texts["robots/six.urdf"]
    kitchen.texts["robots/six.urdf"] = text.replace("</link>", element, 1)
    return kitchen


@pytest.mark.parametrize(
    "name", ["part.stl", "../robots/part.stl", "package://robots/part.stl", "package://meshes/part.stl"]
)
def test_a_mesh_that_is_only_seen_is_an_input_by_its_content(kitchen, name):
    folder = kitchen.folder / ("meshes" if "meshes" in name else "robots")
    folder.mkdir()
    (folder / "part.stl").write_bytes(b"a cube of 6 cm")
    with_mesh(kitchen, seen(name))
    first = kitchen.scene().robot
    (folder / "part.stl").write_bytes(b"a cube of 1.2 m")
    second = kitchen.scene().robot
    assert [(file.name, file.sha256) for file in first.files] == [(name, hashlib.sha256(b"a cube of 6 cm").hexdigest())]
    assert first != second
    assert replace(first, files=second.files) == second
    # No engine is given the mesh; the link is seen as what it collides as.
    assert "mesh" not in first.urdf
    assert first.urdf.count("<cylinder") == kitchen.texts["robots/six.urdf"].count("<cylinder") + 1


def test_a_mesh_that_collides_but_is_none_is_found(kitchen):
    (kitchen.folder / "robots").mkdir()
    (kitchen.folder / "robots/part.stl").write_bytes(b"solid")
    with_mesh(kitchen, '<collision><geometry>\n <mesh filename="part.stl"/></geometry></collision></link>')
    (finding,) = kitchen.findings("robot")
    assert "scene.mesh the collision mesh 'part.stl' of 'base': part.stl " in finding
    assert "(export the mesh again)" in finding


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("/part.stl", "is not a relative path"),
        ("file:///part.stl", "is named by 'file://', which is not a path inside the project"),
        ("model://part.stl", "is named by 'model://', which is not a path inside the project"),
        ("C:\\part.stl", "is not a relative path"),
        ("../../../part.stl", "leads out of the project"),
        ("package://../part.stl", "is not a path inside the project"),
        ("package://robots/../../part.stl", "leads out of the project"),
        ("link.stl", "leads out of the project"),
        ("none.stl", "is not there"),
        ("package://none/part.stl", "is not there"),
        (".", "is not there"),
        ("", "names no file"),
    ],
)
def test_a_mesh_that_is_not_in_the_project_is_found_at_its_place_in_the_urdf(kitchen, elsewhere, name, message):
    (kitchen.folder / "robots").mkdir()
    (kitchen.folder / "robots/link.stl").symlink_to(elsewhere / "part.stl")
    (kitchen.folder.parent / "part.stl").write_bytes(b"solid")
    (finding,) = with_mesh(kitchen, seen(name)).findings("robot")
    assert finding.startswith("robots/six.urdf:3:1 scene.mesh ")
    assert message in finding


def test_a_mesh_that_is_too_large_is_found(kitchen, monkeypatch):
    (kitchen.folder / "robots").mkdir()
    (kitchen.folder / "robots/part.stl").write_bytes(b"solid")
    monkeypatch.setattr("rgss.scenes.urdf_meshes.LARGEST_MESH_BYTES", 4)
    (finding,) = with_mesh(kitchen, seen("part.stl")).findings("robot")
    assert "is larger than" in finding
