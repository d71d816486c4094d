"""Xacros: their arm is that of the URDF which they stand for, and what is wrong with one is said in a line."""

from __future__ import annotations

import importlib.util

import numpy as np
import pytest

from rgss.cli.main import main
from rgss.errors import DefinitionError
from rgss.kinematics import Arm
from rgss.scenes import Pose
from rgss.studies.robot_project import robot_summary
from rgss.studies.robot_project.draft import drafted_robot
from tests.fixtures.serial_arms import SIX_WITHOUT_DECOMPOSITION as SIX
from tests.fixtures.serial_arms import serial_urdf

pytestmark = pytest.mark.engine

CLEAN = serial_urdf(SIX)
XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
BODY = CLEAN[CLEAN.index(">", CLEAN.index("<robot")) + 1 : CLEAN.rindex("</robot>")]
PREFIXED = BODY.replace('"joint_', '"${prefix}joint_').replace('"link_', '"${prefix}link_')
MACRO = f'<robot {XACRO}><xacro:macro name="arm" params="prefix">{PREFIXED}</xacro:macro></robot>'


@pytest.fixture
def package(tmp_path):
    """Writes an arm as makers lay it out: a macro in a package, and a file that uses it with an argument."""

    def write(include="$(find maker_description)/urdf/arm.xacro", *, prefix="$(arg prefix)", rest=""):
        folder = tmp_path / "maker" / "description"
        (folder / "urdf").mkdir(parents=True)
        (folder / "package.xml").write_text("<package><name>maker_description</name></package>", encoding="utf-8")
        (folder / "urdf" / "arm.xacro").write_text(MACRO, encoding="utf-8")
        file = folder / "urdf" / "six.urdf.xacro"
        file.write_text(
            f'<robot name="six" {XACRO}><xacro:arg name="prefix" default="a_"/>'
            f'<xacro:include filename="{include}"/><xacro:arm prefix="{prefix}"/>{rest}</robot>',
            encoding="utf-8",
        )
        return file

    return write


@pytest.mark.parametrize("include", ["$(find maker_description)/urdf/arm.xacro", "arm.xacro"])
def test_the_arm_is_that_of_the_urdf(package, tmp_path, include):
    (tmp_path / "clean.urdf").write_text(CLEAN, encoding="utf-8")
    clean = drafted_robot(tmp_path / "clean.urdf", tmp_path / "clean")
    found = drafted_robot(package(include), tmp_path / "project")

    assert found.robot.id == "six"
    assert [joint.name for joint in found.robot.joints] == [f"a_{joint.name}" for joint in clean.robot.joints]
    q = np.array([0.3, -0.4, 0.5, 0.6, -0.7, 0.8])
    places = [Arm(drafted.robot, Pose()).tool_matrix(q) for drafted in (clean, found)]
    assert places[1] == pytest.approx(places[0], abs=1e-12)
    assert "xacro" not in found.file.with_suffix(".urdf").read_text(encoding="utf-8")


def test_arguments_are_given_on_the_command_line(package, capsys):
    assert main(["robot", str(package()), "--xacro", "prefix:=left_"]) == 0
    assert "left_joint_1" in capsys.readouterr().out


def test_a_missing_argument_is_named_as_it_is_given(package, capsys):
    assert main(["robot", str(package(prefix="$(arg side)"))]) == 2
    assert "(give the xacro's arguments with --xacro side:=VALUE, as ROS does)" in capsys.readouterr().err


def test_arguments_are_given_from_python(package):
    assert robot_summary(package(), xacro={"prefix": "b"}).robot.joints[0].name == "bjoint_1"


@pytest.mark.parametrize("text", ["prefix=left_", ":=left_", " :=x"])
def test_an_argument_of_another_form_is_refused(package, capsys, text):
    assert main(["robot", str(package()), "--xacro", text]) == 2
    expected = f"rgss: --xacro: {text!r} is not of the form NAME:=VALUE (write it as --xacro ur_type:=ur5e)\n"
    assert capsys.readouterr().err == expected


def test_an_argument_without_an_arm_is_refused(tmp_path, capsys):
    assert main(["init", str(tmp_path / "new"), "--xacro", "a:=b"]) == 2
    assert "--xacro is an argument of a URDF (give the URDF with --robot)" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--flange", "--mass", "--gripper", "--xacro"])
def test_an_empty_value_without_an_arm_is_refused_too(tmp_path, capsys, option):
    assert main(["init", str(tmp_path / "new"), option, ""]) == 2
    assert "(give the URDF with --robot)" in capsys.readouterr().err
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize(
    ("changes", "message", "hint"),
    [
        (
            {"prefix": "$(arg side)"},
            "six.urdf.xacro cannot be expanded: Undefined substitution argument side",
            "--xacro",
        ),
        ({"prefix": "${1 / 0}"}, "six.urdf.xacro cannot be expanded: division by zero", "--xacro NAME:=VALUE"),
        ({"rest": "<xacro:gripper/>"}, "cannot be expanded: unknown macro name: xacro:gripper", "--xacro"),
        ({"include": "none.xacro"}, "cannot be expanded: No such file or directory", "--xacro"),
        (
            {"include": "$(find other_description)/arm.xacro"},
            "six.urdf.xacro names the package 'other_description', which is not there",
            "put its folder beside that of the file's package",
        ),
    ],
)
def test_what_cannot_be_expanded_is_said_in_one_line(package, tmp_path, capfd, changes, message, hint):
    with pytest.raises(DefinitionError) as error:
        drafted_robot(package(**changes), tmp_path / "project")
    assert message in error.value.message
    assert "\n" not in error.value.message
    assert hint in error.value.hint
    assert capfd.readouterr() == ("", "")


def test_a_package_beside_that_of_the_file_is_found(package, tmp_path):
    file = package("$(find arms)/arm.xacro")
    beside = tmp_path / "maker" / "common"
    beside.mkdir()
    (beside / "package.xml").write_text("<package><name>arms</name></package>", encoding="utf-8")
    (beside / "arm.xacro").write_text(MACRO, encoding="utf-8")
    assert len(drafted_robot(file, tmp_path / "project").robot.joints) == 6


def test_a_folder_farther_away_with_the_name_of_a_package_is_not_it(package, tmp_path):
    (tmp_path / "arms").mkdir()
    test_a_package_beside_that_of_the_file_is_found(package, tmp_path)


def test_without_the_package_that_expands_it_the_remedy_is_named(package, tmp_path, monkeypatch):
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *more: None if name == "xacrodoc" else find_spec(name, *more)
    )
    with pytest.raises(DefinitionError) as error:
        drafted_robot(package(), tmp_path / "project")
    assert error.value.message == "six.urdf.xacro is a xacro, which needs xacrodoc, which is not installed"
    assert error.value.hint == "pip install 'rgss[xacro]', or expand it: xacro FILE > arm.urdf"
