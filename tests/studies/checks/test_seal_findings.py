"""Objects on which a suction cup cannot seal are found before anything is simulated."""

from __future__ import annotations

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.documents import read_document
from rgss.findings import Severity
from rgss.scenes import Cylinder, GraspCandidates, MeshShape
from rgss.studies.checks.gripped_objects import NOT_SEALED
from rgss.studies.project import load_project
from rgss.studies.scene_findings import check_scene

REPOSITORY = Path(__file__).parents[3]
CUP = "scenes/grippers/lite6_vacuum.yaml"


@pytest.fixture(scope="module")
def project():
    return load_project(REPOSITORY, "lite6_cubes")


def cup_of(project, radius_m=0.01):
    return replace(project.grippers[CUP].geometry, cup=Cylinder(radius_m=radius_m, height_m=0.02))


def test_the_cubes_leave_room_for_the_cup(project):
    assert NOT_SEALED.objects(cup_of(project), project) == ()
    fingers = next(one.geometry for file, one in project.grippers.items() if file != CUP)
    assert NOT_SEALED.objects(fingers, project) == ()


def test_every_gripped_object_that_is_smaller_than_the_cup(project):
    found = NOT_SEALED.objects(cup_of(project, 0.0151), project)

    assert [name for name, _ in found] == [one.workpiece.id for one in project.scene.objects]
    assert all(
        f"the top of {name} of 30 mm is smaller than the cup of gripper lite6_vacuum" in why for name, why in found
    )


def test_a_stated_grasp_of_a_cup_needs_a_box_or_an_upright_cylinder(project):
    half = (-0.015, 0.015)
    corners = tuple((x, y, z) for x in half for y in half for z in half)
    mesh = MeshShape(parts_m=(corners,), sha256="0" * 64)
    scene = replace(project.scene, workpiece=replace(project.scene.workpiece, shape=mesh))
    with_mesh = replace(project, scene=scene)
    ((name, why),) = NOT_SEALED.objects(cup_of(project), with_mesh)

    assert name == scene.workpiece.id
    assert why.startswith(f"gripper lite6_vacuum takes {name} by candidates alone: the stated grasp of a cup is in")
    # Where the task chooses among candidates, its own findings tell of objects without any.
    chosen = replace(scene, task=replace(scene.task, candidates=GraspCandidates()))
    assert NOT_SEALED.objects(cup_of(project), replace(project, scene=chosen)) == ()


@pytest.mark.engine
def test_the_check_of_the_scene_notes_a_cup_that_is_too_large_for_the_cubes(tmp_path):
    for name in ("requirements", "designs", "scenes", "studies"):
        shutil.copytree(REPOSITORY / name, tmp_path / name)
    text = (tmp_path / CUP).read_text(encoding="utf-8")
    (tmp_path / CUP).write_text(text.replace("  radius: 10 mm", "  radius: 16 mm"), encoding="utf-8")
    found = [one for one in check_scene(load_project(tmp_path, "lite6_cubes")).findings if one.rule == "scene.seal"]

    assert {one.severity for one in found} == {Severity.INFO}
    assert found[0].message.endswith(f"({CUP})")


def test_no_other_gripper_makes_it_an_error():
    document = read_document(REPOSITORY / "scenes/restaurant.yaml", label="scenes/restaurant.yaml")
    finding = NOT_SEALED.finding(document, ("workpiece", "id"), "the cup is too large", [CUP], serves=False)

    assert (finding.rule, finding.severity) == ("scene.seal", Severity.ERROR)
    assert finding.hint == "take a smaller cup, or let the task choose the grasp with 'grasp: automatic'"
