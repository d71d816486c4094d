"""The object of a scene file: shapes, mass properties, rest, and every mistake in them at its place."""

from __future__ import annotations

import math
import re

import numpy as np
import pytest
import trimesh

from rgss.errors import DocumentError
from rgss.findings import Severity
from rgss.scenes import Approach, Box, Cylinder, GraspCandidates, LyingCylinder, MeshShape, mesh_volume_findings

ROUND = "  radius: 40 mm\n  height: 120 mm\n"
MASS = "  mass: 300 g\n"


def stated(kitchen, shape, mass=MASS):
    kitchen.change("kitchen.yaml", ROUND + MASS, shape + mass)
    return kitchen


def mesh_of(kitchen, mesh, name="part.stl"):
    mesh.export(kitchen.folder / name)


def found(kitchen):
    with pytest.raises(DocumentError) as caught:
        kitchen.scene()
    return caught.value.findings


def test_a_cylinder_by_its_key_is_the_one_of_radius_and_height(kitchen):
    before = kitchen.scene().workpiece
    assert before.shape == Cylinder(radius_m=0.04, height_m=0.12)
    assert stated(kitchen, "  cylinder: {radius: 40 mm, height: 120 mm}\n").scene().workpiece == before


def test_a_lying_cylinder_has_its_axis_level_and_rests_on_its_wall(kitchen):
    shape = "  cylinder: {radius: 40 mm, height: 120 mm}\n  rests: lying\n  rolling_resistance: 0.5 mm\n"
    piece = stated(kitchen, shape).scene().workpiece
    assert piece.shape == LyingCylinder(radius_m=0.04, length_m=0.12)
    assert piece.pose.position_m[2] == pytest.approx(0.8 + 0.04)
    assert piece.rolling_resistance_m == 0.0005


def test_a_lying_box_is_tipped_about_its_y_axis_with_its_centre_of_mass(kitchen):
    shape = "  box: [60 mm, 50 mm, 80 mm]\n  rests: lying\n  yaw: 90 deg\n  centre_of_mass: [0 mm, 0 mm, 30 mm]\n"
    piece = stated(kitchen, shape, "  density: 1000 kg/m^3\n").scene().workpiece
    assert piece.shape == Box(size_m=(0.08, 0.05, 0.06))
    assert piece.mass_kg == pytest.approx(0.24)
    assert (*piece.centre_of_mass_across_m, piece.centre_of_mass_m) == pytest.approx((0.03, 0.0, 0.0))
    assert piece.pose.rotate((1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))


def test_a_mesh_has_the_mass_and_inertia_of_its_volume(kitchen):
    mesh_of(kitchen, trimesh.creation.box(extents=[60.0, 50.0, 80.0]))
    piece = stated(kitchen, "  mesh: part.stl\n  scale: 0.001\n", "  density: 1000 kg/m^3\n").scene().workpiece
    assert isinstance(piece.shape, MeshShape)
    assert piece.mass_kg == pytest.approx(0.24)
    assert piece.gyration_m2[:3] == pytest.approx((8900e-6 / 12, 10000e-6 / 12, 6100e-6 / 12))
    assert piece.shape.half_height_m == pytest.approx(0.04)


def test_a_given_grasp_turns_with_a_mesh_that_lies(kitchen):
    mesh_of(kitchen, trimesh.creation.box(extents=[0.06, 0.05, 0.08]))
    grasp = "  grasps:\n    - {id: top, at: [0 mm, 0 mm, 10 mm], roll: 180 deg, width: 60 mm}\n"
    piece = stated(kitchen, "  mesh: part.stl\n  rests: lying\n" + grasp).scene().workpiece
    (only,) = piece.grasps
    assert only.tool_in_object.position_m == pytest.approx((0.01, 0.0, 0.0))
    # The tool came down along the file's -z, which lies along -x now.
    assert only.tool_in_object.rotate((0.0, 0.0, 1.0)) == pytest.approx((-1.0, 0.0, 0.0))
    assert only.width_m == 0.06


@pytest.mark.parametrize(
    ("said", "meant"),
    [
        ("as_stated", None),
        ("automatic", GraspCandidates()),
        ("{candidates: {approaches: [side], yaws: 4}}", GraspCandidates(approaches=(Approach.SIDE,), yaws=4)),
    ],
)
def test_a_task_says_which_grasps_are_tried(kitchen, said, meant):
    kitchen.change("kitchen.yaml", "place_yaw: 90 deg", f"place_yaw: 90 deg\n  grasp: {said}")
    assert kitchen.scene().task.candidates == meant


@pytest.mark.parametrize(
    ("shape", "mass", "rule"),
    [
        ("", MASS, "scene.shape"),
        ("  radius: 40 mm\n", MASS, "scene.shape"),
        (ROUND + "  box: [1 m, 1 m, 1 m]\n", MASS, "scene.shape"),
        (ROUND + "  scale: 2\n", MASS, "scene.shape"),
        (ROUND, "", "scene.mass"),
        (ROUND + "  density: 1 kg/m^3\n", MASS, "scene.mass"),
        (ROUND + "  rests: lying\n", MASS, "scene.rolling"),
        (ROUND + "  centre_of_mass: [0 m, 0 m, 61 mm]\n", MASS, "scene.centre-of-mass"),
        (
            ROUND
            + "  centre_of_mass: [0 m, 0 m, 0 m]\n"
            + "  inertia: [1 kg*m^2, 1 kg*m^2, 3 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]\n",
            MASS,
            "scene.inertia",
        ),
        (ROUND + "  inertia: [1 kg*m^2, 1 kg*m^2, 1 kg*m^2, 0 kg*m^2, 0 kg*m^2, 0 kg*m^2]\n", MASS, "scene.mass"),
        ("  box: [0 m, 1 m, 1 m]\n", MASS, "scene.not-positive"),
        ("  mesh: none.stl\n", MASS, "scene.missing-file"),
    ],
)
def test_mistakes_are_found_at_their_places(kitchen, shape, mass, rule):
    stated(kitchen, shape, mass)
    assert rule in [finding.rule for finding in found(kitchen)]


def test_two_grasps_cannot_have_one_name(kitchen):
    grasp = "    - {id: top, at: [0 m, 0 m, 0 m], width: 60 mm}\n"
    stated(kitchen, ROUND + "  grasps:\n" + 2 * grasp)
    assert [finding.rule for finding in found(kitchen)] == ["scene.duplicate-id"]


def test_mesh_mistakes_say_how_to_mend_them(kitchen):
    hollow = trimesh.creation.box(extents=[0.06, 0.05, 0.08])
    hollow.update_faces(np.arange(len(hollow.faces)) > 1)
    bent = trimesh.creation.annulus(0.02, 0.04, 0.05)
    cases = {
        "open.stl": (hollow, "scene.mesh-open"),
        "ring.stl": (bent, "scene.mesh-concave"),
        "millimetres.stl": (trimesh.creation.box(extents=[60.0, 50.0, 80.0]), "scene.mesh-units"),
    }
    shape = ROUND
    for name, (mesh, rule) in cases.items():
        mesh_of(kitchen, mesh, name)
        kitchen.change("kitchen.yaml", shape, f"  mesh: {name}\n")
        shape = f"  mesh: {name}\n"
        (finding,) = found(kitchen)
        assert finding.rule == rule
        assert finding.hint


def test_a_file_that_is_no_mesh_is_a_finding(kitchen):
    (kitchen.folder / "part.stl").write_text("nothing", encoding="utf-8")
    stated(kitchen, "  mesh: part.stl\n")
    assert [finding.rule for finding in found(kitchen)] == ["scene.mesh"]


def test_a_yaw_of_the_object_is_kept_in_its_pose(kitchen):
    stated(kitchen, "  box: [60 mm, 50 mm, 80 mm]\n  yaw: 30 deg\n")
    x, y, _ = kitchen.scene().workpiece.pose.rotate((1.0, 0.0, 0.0))
    assert math.atan2(y, x) == pytest.approx(math.radians(30.0))


def ratio_of(kitchen, collision):
    """The ratio that the finding names; none without a finding."""
    kitchen.scene()
    found = list(mesh_volume_findings(kitchen.folder / "kitchen.yaml", label="kitchen.yaml"))
    assert all(one.rule == "scene.mesh-volume" and one.severity is Severity.WARNING for one in found)
    assert all(f"'collision: {collision}'" in one.message and one.hint for one in found)
    return [float(re.search(r"with (.*) times", one.message)[1]) for one in found]


@pytest.mark.parametrize(("collision", "warned"), [("hull", True), ("boxes", False), ("decompose", False)])
def test_shapes_with_clearly_more_volume_than_their_mesh_are_a_warning(kitchen, collision, warned):
    first, second = trimesh.creation.box((0.06, 0.01, 0.01)), trimesh.creation.box((0.01, 0.05, 0.01))
    second.apply_translation((-0.025, 0.03, 0.0))
    mesh_of(kitchen, trimesh.util.concatenate([first, second]))
    stated(kitchen, f"  mesh: part.stl\n  collision: {collision}\n")
    found = ratio_of(kitchen, collision)
    # The hull of an L with arms of 60 mm, 10 mm thick, is their square without a triangle of 50 mm by 50 mm.
    expected = round((0.06 * 0.06 - 0.05 * 0.05 / 2) / (0.06 * 0.01 + 0.05 * 0.01), 2)
    assert found == ([expected] if warned else [])


def test_a_box_about_a_round_body_is_a_warning(kitchen):
    mesh_of(kitchen, trimesh.creation.cylinder(radius=0.03, height=0.08, sections=64))
    stated(kitchen, "  mesh: part.stl\n  collision: boxes\n")
    assert ratio_of(kitchen, "boxes") == [pytest.approx(4 / math.pi, abs=0.02)]
