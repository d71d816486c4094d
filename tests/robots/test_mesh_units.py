"""Visual meshes whose unit is not that of the collision shapes, and COLLADA files whose up axis is not z."""

from __future__ import annotations

import numpy as np
import pytest
import trimesh

from rgss.scenes.mesh_shapes import read_mesh
from rgss.studies.robot_project.description import description_findings
from tests.robots.test_foreign_urdfs import CLEAN

LINK = "<visual>{}</visual><collision>{}</collision></link>"
BOX = '<geometry><box size="0.1 0.1 0.2"/></geometry>'


def shape(name, scale="1 1 1"):
    return f'<geometry><mesh filename="{name}" scale="{scale}"/></geometry>'


@pytest.fixture
def findings(tmp_path, draft):
    """Findings on the units of an arm with a box of 0.2 m as a link, seen as a mesh with a factor."""

    def found(factor, *, visual="seen.stl", collision=None, scale="1 1 1"):
        (package := tmp_path / "package").mkdir(exist_ok=True)
        trimesh.creation.box((0.1 * factor, 0.1 * factor, 0.2 * factor)).export(package / "seen.stl")
        trimesh.creation.box((0.1, 0.1, 0.2)).export(package / "touched.stl")
        touched = BOX if collision is None else shape(collision)
        text = CLEAN.replace("</link>", LINK.format(shape(visual, scale), touched), 1)
        robot = draft(text).robot
        found = description_findings(robot, package / "arm.urdf", "arm.urdf")
        return [one for one in found if one.rule == "robot.units"]

    return found


@pytest.mark.parametrize("collision", [None, "touched.stl"])
def test_a_visual_mesh_in_millimetres_beside_shapes_in_metres_is_a_finding(findings, collision):
    (finding,) = findings(1000.0, collision=collision)
    assert "the visual mesh seen.stl is 200 m long: is it in millimetres?" in finding.message
    assert finding.hint == 'write scale="0.001 0.001 0.001"'


def test_a_small_part_in_millimetres_is_found_by_the_collision_shapes(findings):
    """A mesh that is not longer than any arm, but has another unit than the shapes of its link."""
    (finding,) = findings(0.001)
    assert "0.0002 m long, the collision shapes of link_1 0.2 m: is its scale right?" in finding.message
    assert finding.hint == 'write scale="1000 1000 1000" if it is in metres'


def test_meshes_of_one_unit_are_no_finding(findings):
    assert findings(1.0, collision="touched.stl") == []
    assert findings(1000.0, scale="0.001 0.001 0.001") == []
    assert findings(3.0) == []
    assert findings(1.0, visual="touched.stl", collision="touched.stl") == []


def test_a_mesh_of_any_up_axis_keeps_its_axes(tmp_path):
    """Published URDFs have COLLADA files that state Y_UP, with coordinates in the frame of the link."""
    whole = trimesh.creation.box((0.1, 0.2, 0.4)).export(file_type="dae").decode()
    for axis in ("X_UP", "Y_UP", "Z_UP"):
        stated = f"<up_axis>{axis}</up_axis></asset>"
        (path := tmp_path / "part.dae").write_text(
            whole.replace("<up_axis>Y_UP</up_axis>", "").replace("</asset>", stated)
        )
        assert np.allclose(read_mesh(path, (1.0, 1.0, 1.0)).extents, (0.1, 0.2, 0.4))
