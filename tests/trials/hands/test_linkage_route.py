"""Tool poses of a linkage whose pads move along the tool axis, at objects of several widths."""

from __future__ import annotations

import math
import shutil

import pytest

from rgss.scenes import at_object, initial_placements, load_scene, object_in_hand, scene_about
from rgss.studies.project import load_project
from rgss.trials.route import route_of
from tests.fixtures.shipped_project import REPOSITORY
from tests.trials.hands.gripper_files import linkage_file

FORMS = {
    "wider": ("    box: [70 mm, 30 mm, 30 mm]", 0.035),
    "narrower": ("    box: [15 mm, 20 mm, 30 mm]", 0.0075),
    "cylinder": ("    cylinder: {radius: 25 mm, height: 30 mm}", 0.025),
}


@pytest.fixture
def scene(request, tmp_path):
    """The scene of three cubes with the second of another form."""
    shutil.copytree(REPOSITORY / "scenes", tmp_path / "scenes")
    path = tmp_path / "scenes" / "lite6_table.yaml"
    text = path.read_text(encoding="utf-8")
    cube = "  - id: green_cube\n    box: [30 mm, 30 mm, 30 mm]"
    assert cube in text
    path.write_text(text.replace(cube, f"  - id: green_cube\n{request.param}"), encoding="utf-8")
    return load_scene(path, project=tmp_path)


@pytest.fixture
def two_finger(tmp_path):
    return linkage_file(tmp_path)


def depth_of_pads_m(half_width_m):
    """Distance from the flange to the grasp on the pads, 15 mm from their tips, where they hold a width.

    The cranks of 56.6 mm turn about joints 70 mm from the flange; the tips are 50 mm long and stay parallel, 12 mm
    nearer to the object than the cranks' ends.
    """
    return 0.07 + math.sqrt(0.0325**2 + 0.0463**2 - (half_width_m - 0.012) ** 2) + 0.05 - 0.015


@pytest.mark.parametrize(("scene", "half_m"), FORMS.values(), ids=FORMS, indirect=["scene"])
def test_the_pads_meet_each_object_in_its_middle(scene, half_m, two_finger):
    geometry = at_object(two_finger.geometry, scene)
    halves_m = {"red_cube": 0.015, "green_cube": half_m, "blue_cube": 0.015}
    assert depth_of_pads_m(half_m) != pytest.approx(geometry.grasp_depth_m, abs=5e-5)
    route = route_of(scene, geometry, load_project(REPOSITORY, "lite6_cubes").study.task)
    grips = [(route.stops[leg.goal], leg) for leg in route.legs if "to_grasp" in leg.step.name]
    assert [stop.object for stop, _ in grips] == list(halves_m)
    for stop, leg in grips:
        flange = stop.pose @ geometry.grasp_centre.inverse()
        pads_z_m = flange.position_m[2] - depth_of_pads_m(halves_m[stop.object])
        assert pads_z_m == pytest.approx(leg.scene.workpiece.pose.position_m[2], abs=1e-6)
        # The tool comes straight down to it from above by the approach height.
        above = route.stops[leg.start].pose.position_m
        assert above == pytest.approx((*stop.pose.position_m[:2], stop.pose.position_m[2] + 0.06), abs=1e-9)


@pytest.mark.parametrize(("scene", "half_m"), FORMS.values(), ids=FORMS, indirect=["scene"])
def test_an_object_is_carried_between_the_pads_and_released_on_its_place(scene, half_m, two_finger):
    geometry = at_object(two_finger.geometry, scene)
    route = route_of(scene, geometry, load_project(REPOSITORY, "lite6_cubes").study.task)
    (down,) = [leg for leg in route.legs if "to_place" in leg.step.name and leg.scene.workpiece.id == "green_cube"]
    tool = route.stops[down.goal].pose
    assert (geometry.grasp_centre @ down.context.carried).position_m[2] == pytest.approx(
        depth_of_pads_m(half_m), abs=1e-6
    )
    x, y, z = down.scene.place.centre_m
    above = z + down.scene.workpiece.shape.half_height_m + scene.task.place_clearance_m
    assert (tool @ down.context.carried).position_m == pytest.approx((x, y, above), abs=1e-9)
    # Where no finger is simulated, the object is fixed to the hand in the same pose.
    view = scene_about(scene, "green_cube", place="", placements=initial_placements(scene))
    fixed = object_in_hand(view, geometry)
    assert fixed.position_m == pytest.approx(down.context.carried.position_m, abs=1e-9)
    for axis in ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)):
        assert fixed.rotate(axis) == pytest.approx(down.context.carried.rotate(axis), abs=1e-9)
    red = scene_about(scene, "red_cube", place="", placements=initial_placements(scene))
    assert object_in_hand(red, geometry).position_m == (0.0, 0.0, 0.0)
