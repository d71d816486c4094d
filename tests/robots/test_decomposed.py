"""Concave collision meshes of an arm: divided where their hulls leave no layout."""

from __future__ import annotations

import importlib.util
import xml.etree.ElementTree as ET

import numpy as np
import pytest
import trimesh

from rgss.errors import DefinitionError
from rgss.studies.robot_project import write_robot_project, writing
from rgss.studies.robot_project.unfit_shapes import UnfitShapesError, is_any_mesh_concave
from rgss.studies.robot_project.urdf import decompose, has_concave_meshes
from tests.fixtures.serial_arms import SIX_WITHOUT_DECOMPOSITION as SIX
from tests.fixtures.serial_arms import serial_urdf
from tests.scenes.linkage_texts import JAWS

pytestmark = pytest.mark.engine

SHAPE = (
    '<collision><origin xyz="0 0 0.01"/><geometry><mesh filename="{}" scale="0.001 0.001 0.001"/></geometry>'
    "</collision></link>"
)
# Another range than that of the first finger, which would let it follow.
TWICE = '<limit lower="-0.02" upper="0.03" effort="30" velocity="0.1"/>'
INNER_M, OUTER_M, HEIGHT_M = 0.04, 0.06, 0.05


@pytest.fixture
def arm(tmp_path):
    """An arm whose first link has a ring, in millimetres, and whose second link has a box."""
    trimesh.creation.annulus(1e3 * INNER_M, 1e3 * OUTER_M, 1e3 * HEIGHT_M).export(tmp_path / "ring.stl")
    trimesh.creation.box(extents=(30, 30, 30)).export(tmp_path / "box.stl")
    text = serial_urdf(SIX)
    for name, mesh in (("link_1", "ring.stl"), ("link_2", "box.stl")):
        before, link, after = text.partition(f'<link name="{name}">')
        text = before + link + after.replace("</link>", SHAPE.format(mesh), 1)
    (tmp_path / "arm.urdf").write_text(text, encoding="utf-8")
    return tmp_path / "arm.urdf"


def contained(root, folder, points):
    """For each point, whether a collision mesh of the first link contains it."""
    found = np.zeros(len(points), dtype=bool)
    for mesh in root.iterfind("link[@name='link_1']/collision/geometry/mesh"):
        part = trimesh.load_mesh(folder / mesh.get("filename"))
        part.apply_scale([float(word) for word in mesh.get("scale", "1 1 1").split()])
        assert part.is_convex
        normals, corners = part.face_normals, part.triangles[:, 0]
        found |= np.all(np.einsum("kj,ikj->ik", normals, points[:, None] - corners) < 1e-6, axis=1)
    return found


def test_the_parts_of_a_ring_leave_its_hole_free(arm):
    root = ET.parse(arm).getroot()  # noqa: S314 - written here
    assert has_concave_meshes(root, arm.parent)
    (note,) = decompose(root, arm.parent)

    assert not has_concave_meshes(root, arm.parent)
    parts = root.findall("link[@name='link_1']/collision")
    assert 4 <= len(parts) <= 16
    assert note.rationale == (
        f"The hulls of its collision meshes did not suit the task. {len(parts)} convex parts stand for those of link_1."
    )
    assert {part.find("origin").get("xyz") for part in parts} == {"0 0 0.01"}
    turns = np.linspace(0.0, 2 * np.pi, 50)
    around = np.stack([np.cos(turns), np.sin(turns), np.zeros_like(turns)], axis=1)
    assert contained(root, arm.parent, 0.5 * (INNER_M + OUTER_M) * around).all()
    assert not contained(root, arm.parent, 0.7 * INNER_M * around).any()
    assert not contained(root, arm.parent, 1.1 * OUTER_M * around).any()
    # The box is left as it is.
    assert root.find("link[@name='link_2']/collision/geometry/mesh").get("filename") == "box.stl"


def test_shapes_of_one_mesh_at_other_scales_have_parts_of_their_own(arm):
    text = arm.read_text(encoding="utf-8").replace("box.stl", "ring.stl")
    before, scale, after = text.rpartition('scale="0.001 0.001 0.001"')
    root = ET.fromstring(before + scale.replace("0.001 0.001 0.001", "0.002 0.001 0.001") + after)  # noqa: S314
    decompose(root, arm.parent)

    widths_m = []
    for link in ("link_1", "link_2"):
        meshes = [
            trimesh.load_mesh(arm.parent / mesh.get("filename"))
            for mesh in root.iterfind(f"link[@name='{link}']/collision/geometry/mesh")
        ]
        widths_m.append(max(mesh.bounds[1][0] for mesh in meshes))
    assert widths_m == pytest.approx([OUTER_M, 2 * OUTER_M], rel=0.02)


@pytest.fixture
def search(monkeypatch):
    """Replaces the search of a layout, which takes minutes where there is none: it succeeds with an arm's parts."""
    seen = []

    def install(*, also_parts_fail=False):
        def write(project, tool_axis, draft, draft_gripper, currency, *, on_stage):
            drafted = draft(tool_axis="z")
            meshes = sorted(path.name for path in project.rglob("*.stl"))
            seen.append(meshes)
            if also_parts_fail or len(seen) == 1:
                raise UnfitShapesError(
                    f"no layout {len(seen)}", hint="turn it", is_concave=is_any_mesh_concave(project)
                )
            return drafted.arm.notes

        monkeypatch.setattr(writing, "_write_files", write)
        return seen

    return install


def test_an_arm_without_a_layout_is_tried_with_the_parts_of_its_meshes(arm, tmp_path, search):
    seen = search()
    stages = []
    written = write_robot_project(arm, tmp_path / "project", on_stage=stages.append)
    assert stages == ["dividing concave collision meshes"]
    assert seen[0] == ["box.stl", "ring.stl"]
    assert len(seen[1]) > 4
    assert any("convex parts stand for those of link_1" in note.rationale for note in written.notes)
    assert (tmp_path / "project" / "scenes" / "robots" / "convex_parts" / "link_1_0" / "ring_0.stl").is_file()
    assert sorted(path.name for path in (tmp_path / "project").rglob("*.stl")) == seen[1]


def test_the_reason_is_that_of_the_whole_meshes_if_the_parts_have_no_layout_either(arm, tmp_path, search):
    search(also_parts_fail=True)
    with pytest.raises(DefinitionError, match=r"^no layout 1 \(turn it\)$"):
        write_robot_project(arm, tmp_path / "project")
    assert not (tmp_path / "project").exists()


def test_convex_meshes_are_not_divided(arm, tmp_path, search):
    trimesh.creation.cylinder(60, 50).export(arm.with_name("ring.stl"))
    seen = search()
    with pytest.raises(DefinitionError, match="no layout 1"):
        write_robot_project(arm, tmp_path / "project")
    assert len(seen) == 1


def test_a_gripper_of_two_motors_is_refused_before_any_mesh_is_divided(arm, tmp_path):
    """No division gives it one driven joint."""
    (tmp_path / "two.urdf").write_text(JAWS.replace('<mimic joint="left_joint"/>', TWICE), encoding="utf-8")
    stages = []
    with pytest.raises(DefinitionError, match=r"^two\.urdf has 2 driven joints \(left_joint, right_joint\)"):
        write_robot_project(arm, tmp_path / "project", gripper=tmp_path / "two.urdf", on_stage=stages.append)
    assert stages == []


def test_without_the_package_that_divides_them_the_remedy_is_named(arm, tmp_path, search, monkeypatch):
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *more: None if name == "coacd" else find_spec(name, *more)
    )
    search()
    with pytest.raises(DefinitionError) as error:
        write_robot_project(arm, tmp_path / "project")
    assert error.value.message == "no layout 1"
    assert error.value.hint == (
        "turn it. Or pip install 'rgss[meshes]': concave collision meshes are divided into convex parts then"
    )
