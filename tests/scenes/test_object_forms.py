"""Several objects of different forms in one scene, with stated and with chosen grasps."""

from __future__ import annotations

import shutil

import pytest

from rgss.scenes import ChosenGrasp, Pose, initial_placements, load_scene, scene_about
from tests.fixtures.shipped_project import REPOSITORY

CUBE = "  - id: green_cube\n    box: [30 mm, 30 mm, 30 mm]"
FORMS = {
    "size": "    box: [30 mm, 30 mm, 20 mm]",
    "centre of mass": "    box: [30 mm, 30 mm, 30 mm]\n    centre_of_mass: [0 mm, 5 mm, 0 mm]",
    "cylinder": "    cylinder: {radius: 12 mm, height: 40 mm}",
}


@pytest.fixture
def table(tmp_path):
    """Loads the scene of three cubes with one of another form."""
    shutil.copytree(REPOSITORY / "scenes", tmp_path / "scenes")
    path = tmp_path / "scenes" / "lite6_table.yaml"

    def load(form, grasp):
        text = path.read_text(encoding="utf-8")
        assert CUBE in text
        text = text.replace("  grasp_yaw: 0 deg\n", f"  grasp_yaw: 0 deg\n  grasp: {grasp}\n")
        path.write_text(text.replace(CUBE, f"  - id: green_cube\n{form}"), encoding="utf-8")
        return load_scene(path, project=tmp_path)

    return load


@pytest.mark.parametrize("grasp", ["automatic", "as_stated"])
@pytest.mark.parametrize("form", FORMS.values(), ids=FORMS)
def test_objects_may_have_different_forms(table, form, grasp):
    scene = table(form, grasp)
    assert [one.workpiece.id for one in scene.objects] == ["red_cube", "green_cube", "blue_cube"]
    assert scene.objects[0].workpiece.shape == scene.objects[2].workpiece.shape
    assert scene.grasps == {}


def test_the_scene_about_an_object_has_the_grasp_of_that_object(table):
    def grasp(name, height_m):
        return ChosenGrasp(
            id=name,
            tool_in_object=Pose(position_m=(0.0, 0.0, height_m), quaternion_xyzw=(1.0, 0.0, 0.0, 0.0)),
            opening_m=0.015,
            place_yaw_rad=0.0,
            quality_1=0.5,
            com_distance_m=0.0,
            candidates=1,
            rejected=0,
        )

    plain = table(FORMS["size"], "automatic")
    chosen = {"red_cube": grasp("upper", 0.004), "green_cube": grasp("lower", -0.003)}
    scene = plain.with_grasps({"red_cube": chosen["red_cube"]}).with_grasps({"green_cube": chosen["green_cube"]})
    assert scene.grasps == chosen
    placements = initial_placements(scene)
    for one in scene.objects:
        name, x, y, z = one.workpiece.id, *one.workpiece.pose.position_m
        view = scene_about(scene, name, place="", placements=placements)
        assert view.task.grasp == chosen.get(name)
        assert view.grasps == chosen
        height_m = chosen[name].tool_in_object.position_m[2] if name in chosen else 0.0
        assert view.grasp.position_m == pytest.approx((x, y, z + height_m))
        # And back again from the view.
        again = scene_about(view, "red_cube", place="", placements=placements)
        assert again.task == scene.task
