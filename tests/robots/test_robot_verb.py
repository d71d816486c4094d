"""``rgss robot``: what an arm is, and what is wrong with its description."""

from __future__ import annotations

import json
import math

import pytest

from rgss.cli.main import main
from tests.fixtures.palletizer import palletizer_urdf
from tests.fixtures.serial_arms import SEVEN, serial_urdf
from tests.robots.conftest import urdf_of


@pytest.fixture
def written(tmp_path):
    def write(text=None, old="", new=""):
        path = tmp_path / "arm.urdf"
        text = serial_urdf(SEVEN) if text is None else text
        assert old in text
        path.write_text(text.replace(old, new, 1) if old else text, encoding="utf-8")
        return path

    return write


def test_an_arm_in_numbers(capsys, written):
    assert main(["robot", str(written()), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [joint["kind"] for joint in found["joints"]] == ["revolute"] * 7
    assert sum(found["masses_kg"].values()) == pytest.approx(7.0)
    # From the first axis along the links: 0.4, 0.39 and two short offsets.
    assert 0.75 < found["reach_m"] < 0.4 + 0.39 + 0.1
    assert found["findings"] == []
    # 100 N·m hold the arm's own kilograms and this mass at its reach.
    own = 9.81 * 7.0 * found["reach_m"]
    assert 100.0 / (9.81 * found["reach_m"]) > found["payload_kg"] > (100.0 - own) / (9.81 * found["reach_m"])


def test_an_arm_in_words_and_a_picture(capsys, written, tmp_path):
    for name in ("workspace.png", "workspace.svg"):
        assert main(["robot", str(written()), "-o", str(tmp_path / name)]) == 0
        assert (tmp_path / name).stat().st_size > 5000
    text = capsys.readouterr().out
    assert "serial: 7 joints to flange, 7 kg" in text
    assert "Payload by the joints' efforts, in the worst of 2048 configurations:" in text


def test_a_picture_of_another_kind_is_refused(capsys, written, tmp_path):
    assert main(["robot", str(written()), "-o", str(tmp_path / "workspace.gif")]) == 2
    assert "picture must be a PNG or SVG file, got" in capsys.readouterr().err
    assert main(["robot", str(written()), "-o", str(tmp_path / "none" / "workspace.png")]) == 2
    assert "cannot be written" in capsys.readouterr().err


def test_a_slide_is_in_millimetres(capsys, written):
    slide = SEVEN[0].__class__("prismatic", (0.0, 0.0, 0.1), range=(-0.5, 0.5))
    main(["robot", str(written(serial_urdf((slide, *SEVEN[1:]))))])
    assert "-500 to 500 mm" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('xyz="0.0 -0.4 0.0"', 'xyz="0.0 -400 0.0"', "joint_3 has a length of 400 m: are these millimetres?"),
        ('mass value="1"', 'mass value="4000"', "link_1 weighs 4000 kg: are these grams?"),
        ('ixx="0.01"', 'ixx="0.5"', "link_1 has moments of inertia that no body has"),
        ('effort="100"', 'effort="0"', "joint joint_1 has no effort"),
        ('velocity="2"', 'velocity="0"', "joint joint_1 has no velocity"),
        (' effort="100"', "", "joint joint_1 has no effort"),
        ('lower="-2.9" upper="2.9"', 'lower="2.9" upper="-2.9"', "joint joint_1 has a range from 2.9 to -2.9"),
        ('lower="-2.9" upper="2.9"', 'lower="-170" upper="170"', "joint joint_1 has a range from -170 to 170 rad: are"),
    ],
)
def test_what_is_suspicious_is_found_with_its_line(capsys, written, old, new, message):
    assert main(["robot", str(written(old=old, new=new))]) == 1
    assert f"arm.urdf:1:1: warning: {message}" in capsys.readouterr().out


def test_joints_that_do_not_hold_the_arm_are_found(capsys, written):
    assert main(["robot", str(written(serial_urdf(SEVEN).replace('effort="100"', 'effort="2"')))]) == 1
    text = capsys.readouterr().out
    assert "joint joint_2 gives 2 N*m, and needs " in text
    assert "joint joint_1 gives" not in text  # its axis is vertical


@pytest.mark.parametrize(("mass", "found"), [("0.01", True), ("0.04", True), ("0.2", False), ("1", False)])
def test_masses_that_no_arm_of_this_length_has_are_found(capsys, written, mass, found):
    """Seven links of 2 to 200 g over the sum of their offsets."""
    length_m = sum(math.dist((0, 0, 0), link.xyz) for link in SEVEN)
    total_kg = len(SEVEN) * float(mass)
    assert (total_kg < 0.3 * length_m) is found
    main(["robot", str(written(serial_urdf(SEVEN).replace('mass value="1"', f'mass value="{mass}"')))])
    text = capsys.readouterr().out
    message = f"weigh {total_kg:.3g} kg over a length of {length_m:.3g} m: are their masses placeholders?"
    assert (message in text) is found
    assert ("[robot.placeholder-mass]" in text) is found


def test_moments_that_are_zero_are_those_of_the_shape(capsys, written):
    zeros = " ".join(f'{name}="0"' for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    head, tail = serial_urdf(SEVEN).split("<inertia ", 1)
    path = written(f"{head}<inertia {zeros}/>{tail.split('/>', 1)[1]}")
    main(["robot", str(path)])
    assert "Assumed: The URDF has a mass and no inertia of link_1" in capsys.readouterr().out
    main(["robot", str(path), "--json"])
    assert len(json.loads(capsys.readouterr().out)["assumed"]) == 1


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('axis xyz="0 0 1"', 'axis xyz="0 0 0"', "arm.urdf has an axis without a direction for 'joint_1'"),
        ('mass value="1"', 'mass value="0.00"', "arm.urdf has no mass or no inertia for 1 link: link_1"),
        ('mass value="1"', 'mass value="nan"', "arm.urdf has value='nan' in <mass> of 'link_1'"),
        ('joint name="joint_2"', 'joint name="joint_1"', "the URDF has two joints of the name 'joint_1'"),
    ],
)
def test_what_cannot_be_used_is_said_of_the_urdf(capsys, written, old, new, message):
    assert main(["robot", str(written(old=old, new=new))]) == 2
    assert message in capsys.readouterr().err


def test_links_that_touch_at_the_home_are_found(capsys, written):
    ball = "<collision><geometry><sphere radius='0.25'/></geometry></collision></link>"
    text = serial_urdf(SEVEN).replace("</link>", ball, 1)
    head, last = text.split('<link name="flange">')
    main(["robot", str(written(f'{head}<link name="flange">' + last.replace("</link>", ball, 1)))])
    assert "touches" not in capsys.readouterr().out
    curled = tuple(
        link.__class__(link.kind, link.xyz, link.rpy, link.axis, (1.9, 2.4)) if number == 3 else link
        for number, link in enumerate(SEVEN)
    )
    text = serial_urdf(curled).replace("</link>", ball, 1)
    head, last = text.split('<link name="flange">')
    status = main(["robot", str(written(f'{head}<link name="flange">' + last.replace("</link>", ball, 1)))])
    text = capsys.readouterr().out
    assert status == (1 if "touches" in text else 0)
    assert "flange touches link_1 at the home" in text or "since they touch however the arm stands" in text


def test_an_arm_of_a_project_and_its_meshes(capsys, projects):
    (path,) = (projects["six"] / "scenes" / "robots").glob("*.yaml")
    assert main(["robot", str(path)]) == 1
    text = capsys.readouterr().out
    assert "Collision meshes: 7 convex shapes stand for them." in text
    assert "link2_vhacd.obj is concave: its hull has 1.48 times its volume" in text
    assert main(["robot", str(urdf_of("seven"))]) == 1
    assert "link_0.stl is not closed" in capsys.readouterr().out


def test_a_mesh_in_millimetres(capsys, written, tmp_path):
    import trimesh

    trimesh.creation.box((120, 80, 60)).export(tmp_path / "part.stl")
    mesh = '<collision><geometry><mesh filename="part.stl"/></geometry></collision></link>'
    text = serial_urdf(SEVEN).replace("</link>", mesh, 1)
    assert main(["robot", str(written(text))]) == 1
    assert "the mesh part.stl is 120 m long: is it in millimetres?" in capsys.readouterr().out
    scaled = text.replace('"part.stl"', '"part.stl" scale="0.001 0.001 0.001"')
    assert main(["robot", str(written(scaled))]) == 0


def test_joints_that_follow_others_are_named_with_their_drivers(capsys, written):
    path = written(palletizer_urdf())
    assert main(["robot", str(path)]) == 0
    shown = capsys.readouterr().out
    assert "palletizer: 4 joints to flange" in shown
    assert "elbow_level (revolute) follows: -1 * elbow." in shown
    assert main(["robot", str(path), "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert [(one["name"], one["driver"]) for one in found["followers"]] == [
        ("shoulder_level", "shoulder"),
        ("elbow_level", "elbow"),
    ]
