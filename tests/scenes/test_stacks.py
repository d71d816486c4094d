"""Objects and places on other objects: where they are, and every mistake in naming a support."""

from __future__ import annotations

import math

import pytest

from rgss.errors import DocumentError
from rgss.scenes import ObjectPlacement, Pose, initial_placements, scene_about, with_raised_stack

PLATE = """\
workpieces:
  - id: plate
    box: [60 mm, 40 mm, 10 mm]
    mass: 200 g
    friction: 0.9
    force_limit: 20 N
    stands_on: {plate}
    at: [10 mm, -5 mm]
    yaw: 90 deg
    colour: "#FFFFFF"
    place_region: {{stands_on: {region}, at: [5 mm, 2 mm], radius: 1 cm, largest_tilt: 5 deg}}
  - id: nut
    radius: 8 mm
    height: 12 mm
    mass: 20 g
    friction: 0.9
    force_limit: 20 N
    stands_on: {nut}
    at: [20 mm, 0 m]
    colour: "#FFFFFF"
    place_region: {{stands_on: mug, at: [0 m, 0 m], radius: 1 cm, largest_tilt: 5 deg}}
places:
  - {{id: on_top, stands_on: {place}, at: [3 mm, 0 m], radius: 1 cm, largest_tilt: 5 deg}}
place_region:
"""


@pytest.fixture
def stacked(kitchen):
    """The kitchen with a plate on the mug and a nut on the plate."""

    def scene(*, mug="table", plate="mug", nut="plate", region="nut", place="plate"):
        texts = PLATE.format(plate=plate, nut=nut, region=region, place=place)
        kitchen.change("kitchen.yaml", "place_region:\n", texts)
        kitchen.change(
            "kitchen.yaml", "stands_on: table\n  at: [0.4 m, 0.1 m]", f"stands_on: {mug}\n  at: [0.4 m, 0.1 m]"
        )
        return kitchen.scene()

    return scene


def test_an_object_stands_on_another_at_a_position_in_its_frame(stacked):
    """By hand: the mug ends at 0.92 m; the plate is turned by 90 deg, so that the nut's x is along the world's y."""
    plate, nut = (one.workpiece.pose for one in stacked().others)
    assert plate.position_m == pytest.approx((0.41, 0.095, 0.92 + 0.005))
    assert plate.rotate((1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0), abs=1e-12)
    assert nut.position_m == pytest.approx((0.41, 0.115, 0.93 + 0.006))


def test_a_place_on_an_object_is_where_that_object_is(stacked):
    scene = stacked()
    plate, _ = scene.others
    assert (plate.place.offset_m, plate.place_support) == ((0.005, 0.002), "nut")
    # At the start on top of the nut, which has the yaw of the plate.
    assert plate.place.centre_m == pytest.approx((0.41 - 0.002, 0.115 + 0.005, 0.942))
    assert scene.place.offset_m is None

    moved = initial_placements(scene)
    moved["nut"] = ObjectPlacement(pose=Pose(position_m=(-1.0, 0.0, 2.006)), support="pole")
    about = scene_about(scene, "plate", place="", placements=moved)
    assert about.place.centre_m == pytest.approx((-0.995, 0.002, 2.012))
    assert about.placed_object.position_m == pytest.approx((-0.995, 0.002, 2.017))

    moved["plate"] = ObjectPlacement(pose=Pose.from_roll_pitch_yaw((0.0, 0.0, 1.0), (0.0, 0.0, math.pi)), support="")
    named = scene_about(scene, "mug", place="on_top", placements=moved)
    assert named.place.centre_m == pytest.approx((-0.003, 0.0, 1.005))


def test_a_region_on_a_body_does_not_move(stacked):
    region = stacked().place
    assert region.on(Pose(position_m=(3.0, 3.0, 3.0)), 0.1) is region


@pytest.mark.parametrize(
    ("changes", "message", "hint"),
    [
        ({"plate": "desk"}, "there is no body or object 'desk'", "known bodies: table, pole; objects: mug, nut"),
        ({"region": "tree"}, "there is no body or object 'tree'", "known bodies: table, pole; objects: mug, nut"),
        ({"place": "shelf"}, "there is no body or object 'shelf'", "bodies: table, pole; objects: mug, plate, nut"),
        ({"plate": "plate"}, "'plate' cannot be its own support", "name another support"),
        ({"region": "plate"}, "'plate' cannot be its own support", "name another support"),
        ({"plate": "nut"}, "plate, nut support each other in a cycle", "name a body as the support of the lowest"),
        ({"mug": "nut"}, "mug, nut, plate support each other in a cycle", "name a body as the support of the lowest"),
    ],
)
def test_a_support_that_is_none_is_one_finding(stacked, changes, message, hint):
    with pytest.raises(DocumentError) as error:
        stacked(**changes)
    (found,) = error.value.findings
    assert found.message == message
    assert hint in found.hint
    assert found.rule == ("scene.unknown-body" if "there is no" in message else "scene.stack")


def test_a_taller_object_of_the_workload_raises_what_stands_on_it(stacked):
    scene = stacked()
    raised = with_raised_stack(scene, "mug", 0.03)
    for one, other in zip(scene.others, raised.others, strict=True):
        x, y, z = one.workpiece.pose.position_m
        assert other.workpiece.pose.position_m == pytest.approx((x, y, z + 0.03))
    assert with_raised_stack(scene, "nut", 0.03) == scene


def test_colours_need_not_be_stated(kitchen):
    text = PLATE.format(plate="mug", nut="plate", region="nut", place="plate")
    kitchen.change("kitchen.yaml", "place_region:\n", text.replace('    colour: "#FFFFFF"\n', ""))
    kitchen.change("kitchen.yaml", '  colour: "#FFFFFF"\n', "")
    kitchen.change("kitchen.yaml", '    colour: "#000000"\n', "")
    scene = kitchen.scene()
    objects = [one.workpiece.colour for one in scene.objects]
    assert len(set(objects)) == 3
    assert scene.bodies[1].colour not in objects


def test_an_object_without_friction_is_refused(kitchen):
    """No hand could grip it: what its friction bears is what its weight is divided by."""
    before = PLATE.format(plate="mug", nut="plate", region="nut", place="plate")
    nothing = before.replace("friction: 0.9", "friction: 0", 1)
    kitchen.change("kitchen.yaml", "place_region:\n", nothing)
    (finding,) = kitchen.findings("scene")
    assert "scene.not-positive friction must be greater than zero" in finding
