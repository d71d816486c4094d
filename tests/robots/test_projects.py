"""From a URDF to a decision: a project round an arm that nobody here modelled."""

from __future__ import annotations

import itertools
import json
import math
import re
import shutil
import xml.etree.ElementTree as ET
from dataclasses import replace

import pytest
import trimesh

from rgss.cli.main import main
from rgss.guard.schema import record_schema
from rgss.studies import load_project
from rgss.studies.robot_project import write_robot_project, writing
from rgss.studies.robot_project.first_trial import has_scene_errors
from rgss.studies.robot_project.fitting import CellSearch
from rgss.studies.robot_project.hand_size import hand_sizes
from tests.fixtures.serial_arms import Link, serial_urdf
from tests.robots.conftest import urdf_of
from tests.robots.test_arm_sizes import FOUR


def run(capsys, project, *arguments):
    status = main([*arguments, "--project", str(project)])
    return status, capsys.readouterr().out


def test_a_project_of_an_arm_is_checked_swept_and_decided(projects, arm_name, tmp_path, capsys):
    project = tmp_path / "project"
    shutil.copytree(projects[arm_name], project)
    study = project / "studies" / "pick_place.yaml"
    study.write_text(
        study.read_text(encoding="utf-8")
        .replace("fidelity: contact", "fidelity: kinematic")
        .replace("replicates: 2", "replicates: 1"),
        encoding="utf-8",
    )
    status, text = run(capsys, project, "check")
    # One of the arms has inertias that no body has.
    assert status == (1 if "robot.inertia" in text else 0)
    assert "error" not in text
    status, _ = run(capsys, project, "sweep", "--jobs", "1")
    assert status == 0
    status, text = run(capsys, project, "trade", "--json")
    decision = json.loads(text)
    assert status in (0, 1)
    assert decision["chosen"] is not None


@pytest.mark.parametrize("name", ["six", "seven"])
def test_a_joint_has_the_range_of_the_urdf_or_one_turn_of_it(projects, name):
    """Other tasks of the user's reach as far as the arm does; the whole range stands beside the turn."""
    (file,) = (projects[name] / "scenes" / "robots").glob("*.yaml")
    root = ET.parse(urdf_of(name)).getroot()  # noqa: S314 - it comes with the engine
    limits = {joint.get("name"): joint.find("limit") for joint in root.findall("joint")}
    lines = re.findall(
        r"name: (\w+), range: \[(\S+) rad, (\S+) rad\].*}(?: # of (\S+) rad to (\S+) rad)?$",
        file.read_text("utf-8"),
        re.MULTILINE,
    )
    assert len(lines) == {"six": 6, "seven": 7}[name]
    for joint, *written in lines:
        lower, upper, *beside = (float(one) if one else None for one in written)
        whole = [float(limits[joint].get(end)) for end in ("lower", "upper")]
        if whole[1] - whole[0] > 6.29:
            assert upper - lower == pytest.approx(6.29, abs=1e-3)
            assert whole[0] - 1e-6 <= lower < upper <= whole[1] + 1e-6
            assert beside == pytest.approx(whole, rel=1e-5)
        else:
            assert ([lower, upper], beside) == (pytest.approx(whole), [None, None])


def test_a_row_of_joints_has_as_many_entries_as_the_arm_has_joints(projects, tmp_path, capsys):
    project = tmp_path / "project"
    shutil.copytree(projects["seven"], project)
    measures = project / "requirements" / "measures.yaml"
    written = measures.read_text(encoding="utf-8")
    source = (
        "inputs:\n  - {id: torques, source: trial.peak_joint_torque_n_m, unit: N*m, length: 6, definition: Torques.}\n"
    )
    measures.write_text(written.replace("inputs:\n", source, 1), encoding="utf-8")
    assert main(["variants", "--project", str(project)]) == 2
    message = "torques: 'trial.peak_joint_torque_n_m' is a row of 7 (write 'length: 7')"
    assert message in " ".join(capsys.readouterr().err.split())
    measures.write_text(written.replace("inputs:\n", source.replace("6", "7"), 1), encoding="utf-8")
    assert main(["variants", "--project", str(project)]) == 0
    # What a baseline says of a record is that of the arm.
    assert record_schema(load_project(project))["peak_joint_torque_n_m"] == "7 × N*m"
    assert record_schema(load_project(project))["path_length_m"] == "5 × m"


def test_the_object_is_carried_in_contact(projects, tmp_path, capsys):
    project = tmp_path / "project"
    shutil.copytree(projects["seven with a hand"], project)
    status, text = run(capsys, project, "run", "2", "--fidelity", "contact", "--json")
    assert status == 0
    assert json.loads(text)["success"] is True


def test_init_names_what_was_written(tmp_path, capsys):
    assert main(["init", "--robot", str(urdf_of("six")), str(tmp_path / "new"), "--json"]) == 0
    files = json.loads(capsys.readouterr().out)["files"]
    assert "scenes/robots/xarm6.urdf" in files
    assert all((tmp_path / "new" / name).is_file() for name in files)
    assert main(["init", "--robot", str(urdf_of("six")), str(tmp_path / "new")]) == 2
    assert "are there already, and nothing is overwritten" in capsys.readouterr().err


TWO_ARMS = (
    '<robot name="two"><link name="body"/>'
    + "".join(
        f'<link name="{side}"/><joint name="{side}_joint" type="revolute"><parent link="body"/><child link="{side}"/>'
        '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        for side in ("left", "right")
    )
    + "</robot>"
)


WITHOUT_ITS_MESH = (
    '<robot name="r"><link name="base"/><link name="tip"><inertial><mass value="1"/>'
    '<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>'
    '<mesh filename="no.stl"/></geometry></collision></link>'
    '<joint name="j" type="revolute"><parent link="base"/><child link="tip"/></joint></robot>'
)


@pytest.mark.parametrize(
    ("text", "more", "message"),
    [
        (TWO_ARMS, [], "the URDF divides at body into left, right, before any joint moves"),
        (TWO_ARMS, ["--flange", "hand"], "the URDF has no link hand"),
        (TWO_ARMS, ["--flange", "body"], "the arm has 0 movable joints from its base to body"),
        (TWO_ARMS.replace("revolute", "planar"), ["--flange", "left"], "the joint left_joint is planar"),
        ("<robot", [], "is not XML"),
        ("<model/>", [], "is not a URDF: it has no robot with links"),
        (
            '<robot xmlns:xacro="u"><xacro:macro name="a" params=""><link name="a"/></xacro:macro></robot>',
            [],
            "defines macros and has no link of its own (name the xacro that calls them with the robot)",
        ),
        ("<!DOCTYPE robot><robot/>", [], "declares a document type"),
        (WITHOUT_ITS_MESH, [], "the file no.stl of arm.urdf is not there"),
    ],
)
def test_what_is_no_arm_is_said_in_one_line(tmp_path, capsys, text, more, message):
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(text, encoding="utf-8")
    assert main(["init", "--robot", str(urdf), *more, str(tmp_path / "new")]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert "Traceback" not in error
    assert not (tmp_path / "new").exists()


def test_a_urdf_that_is_not_there(tmp_path, capsys):
    assert main(["init", "--robot", str(tmp_path / "no.urdf"), str(tmp_path / "new")]) == 2
    assert "no.urdf cannot be read" in capsys.readouterr().err


@pytest.mark.parametrize(("verb", "after"), [(["robot"], []), (["init", "--robot"], ["new"])], ids=["robot", "init"])
def test_a_urdf_without_end_is_not_read(tmp_path, capsys, verb, after):
    assert main([*verb, "/dev/zero", *(str(tmp_path / name) for name in after)]) == 2
    assert "/dev/zero cannot be read: not a regular file (name a URDF" in capsys.readouterr().err


def test_a_flange_needs_a_urdf(tmp_path, capsys):
    assert main(["init", "--flange", "tool0", str(tmp_path / "new")]) == 2
    assert "--flange names a link of a URDF (give the URDF with --robot)" in " ".join(capsys.readouterr().err.split())


def test_an_arm_that_cannot_turn_its_tool_down(tmp_path, capsys):
    joint = '<joint name="j" type="revolute"><parent link="base"/><child link="tip"/><axis xyz="0 0 1"/>'
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(
        '<robot name="r"><link name="base"/><link name="tip"><inertial><mass value="1"/><inertia ixx="1" iyy="1" '
        f'izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>{joint}'
        '<limit lower="-1" upper="1" effort="9" velocity="1"/></joint></robot>',
        encoding="utf-8",
    )
    assert main(["init", "--robot", str(urdf), str(tmp_path / "new")]) == 2
    error = " ".join(capsys.readouterr().err.split())
    assert "no layout was found in which r grasps a cup" in error
    urdf.write_text(
        urdf.read_text(encoding="utf-8").replace("<axis", '<origin rpy="0.7 0.6 0"/><axis'), encoding="utf-8"
    )
    assert main(["init", "--robot", str(urdf), str(tmp_path / "new")]) == 2
    error = " ".join(capsys.readouterr().err.split())
    assert "r does not turn any axis of tip down: in 2048 configurations the nearest, " in error
    assert "deg from the vertical on a level base (name the link that carries the gripper" in error


def test_an_arm_with_meshes_in_millimetres_and_no_scale(tmp_path, capsys):
    """An arm of a kilometre has no place at a table: the hint is the unit, and not another flange."""
    trimesh.creation.box((90.0, 90.0, 400.0)).export(tmp_path / "link.stl")
    shape = '<collision><geometry><mesh filename="link.stl"/></geometry></collision></link>'
    text = serial_urdf(FOUR).replace("</link>", shape, 1)
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(text, encoding="utf-8")
    assert main(["init", "--robot", str(urdf), "--tool-axis", "z", str(tmp_path / "new")]) == 2
    error = " ".join(capsys.readouterr().err.split())
    assert "no layout was found in which serial grasps a cup" in error
    assert re.search(r'\(the mesh \S+ is 400 m long: is it in millimetres\? write scale="0.001 0.001 0.001"; ', error)


@pytest.fixture
def one_size(monkeypatch):
    """Leaves the search for a layout the largest hand alone; with each smaller one it begins anew."""
    monkeypatch.setattr(writing, "hand_sizes", lambda *arm: itertools.islice(hand_sizes(*arm), 1))


def test_an_arm_that_points_down_at_none_of_its_places(one_size, tmp_path, capsys):
    """A tool that is bent by 20 deg from the last of two parallel axes."""
    bent = Link("revolute", (0.0, 0.0, 0.1), (0.35, 0.0, 0.0))
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(serial_urdf((*FOUR[:3], bent)), encoding="utf-8")
    assert main(["init", "--robot", str(urdf), "--tool-axis", "z", str(tmp_path / "new")]) == 2
    error = " ".join(capsys.readouterr().err.split())
    assert "no layout was found in which serial grasps a cup on a table with its tool pointing down: with the " in error
    assert "the tool points down at none of 63 places within its reach" in error
    assert "An arm that cannot turn its tool down needs a scene and a task of its own)" in error


def test_an_arm_whose_tool_points_down_but_at_none_of_the_places(one_size, tmp_path, capsys):
    """One joint moves a tool that always points down on a circle."""
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(serial_urdf((FOUR[0], Link("fixed", (0.5, 0.0, -0.03), (math.pi, 0.0, 0.0)))), encoding="utf-8")
    assert main(["init", "--robot", str(urdf), str(tmp_path / "new")]) == 2
    error = " ".join(capsys.readouterr().err.split())
    assert "the tool points down, but the joints bring it so to none of 63 places within its reach" in error
    assert "one with too few joints for that needs a scene and a task of its own)" in error


def test_an_arm_that_its_urdf_mounts_at_a_tilt(one_size, tmp_path, capsys):
    tilted = Link("revolute", (0.0, 0.0, 0.2), (0.25, 0.0, 0.0))
    urdf = tmp_path / "arm.urdf"
    urdf.write_text(serial_urdf((tilted, *FOUR[1:])), encoding="utf-8")
    assert main(["init", "--robot", str(urdf), "--tool-axis", "z", str(tmp_path / "new")]) == 2
    error = " ".join(capsys.readouterr().err.split())
    reason = "with the gripper along z, its first joint does not turn about a vertical axis on a level base ("
    assert f"{reason}if the URDF mounts the arm at a tilt, take the tilt out of its base's joint" in error


def test_a_layout_that_the_check_refuses_is_not_written(one_size, tmp_path, capsys, monkeypatch):
    """Even if the search takes it for valid, as it does where links touch in every configuration of the draft."""
    found = CellSearch.cells

    def too_high(search):
        for cell in itertools.islice(found(search), 1):
            yield replace(cell, layout=replace(cell.layout, table_m=cell.layout.table_m + 2.0 * cell.layout.reach_m))

    monkeypatch.setattr(CellSearch, "cells", too_high)
    assert main(["init", "--robot", str(urdf_of("six")), "--tool-axis", "z", str(tmp_path / "new")]) == 2
    assert "no layout was found in which xarm6 grasps a cup" in " ".join(capsys.readouterr().err.split())
    assert not (tmp_path / "new").exists()


def test_a_layout_without_a_finding_is_written_though_the_first_trial_fails(tmp_path, monkeypatch):
    monkeypatch.setattr(writing, "carries_object", lambda project: False)
    monkeypatch.setattr(writing, "_MOST_CELLS", 2)
    stages = []
    write_robot_project(urdf_of("six"), tmp_path / "new", on_stage=stages.append)
    first = stages.index("gripper along z, size 1 of 3: trying a cell in a trial")
    assert set(stages[:first]) == {f"gripper along z, size 1 of 3: layout {tried}" for tried in range(1, first + 1)}
    assert stages.count("gripper along z, size 1 of 3: places where the tool comes down") == 1
    assert not has_scene_errors(load_project(tmp_path / "new"))
