"""Conditions of check steps that the task's own places exclude."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.scenes import NamedPlace, ObjectPlacement, PlaceRegion, Pose, SceneObject, scene_about
from rgss.tasks import CheckStep, HandAction, Nearness, ReleaseStep
from rgss.trials.geometry_checks import check_step_problems


@pytest.fixture
def found(spec_of):
    """Problems of the shipped task with a check inserted before one of its steps, as key and detail."""
    spec = spec_of(65)

    def check(before, scene=spec.scene, steps=spec.task.steps, **conditions):
        steps = (*steps[:before], CheckStep(name="there", **conditions), *steps[before:])
        problems = check_step_problems(scene, replace(spec.task, steps=steps))
        assert {one.step for one in problems} <= {before}
        return [(one.key, one.detail) for one in problems]

    check.scene = spec.scene
    (check.grip,) = (index for index, step in enumerate(spec.task.steps) if step.hand is HandAction.CLOSES)
    (check.release,) = (index for index, step in enumerate(spec.task.steps) if step.hand is HandAction.OPENS)
    return check


def with_places(scene):
    """The scene with its place, one 30 mm beside it and one under the object by name."""
    x, y, z = scene.place.centre_m
    beside = PlaceRegion(centre_m=(x + 0.03, y, z), radius_m=0.02, largest_tilt_rad=0.1)
    at = scene.workpiece.pose.position_m
    under = replace(beside, centre_m=(at[0], at[1], at[2] - scene.workpiece.shape.half_height_m))
    regions = {"own": scene.place, "beside": beside, "start": under}
    places = tuple(NamedPlace(id=name, region=one, support=scene.place_support) for name, one in regions.items())
    return replace(scene, places=places)


def test_a_place_is_compared_with_the_start_and_with_the_last_release(found):
    scene = with_places(found.scene)
    after = found.release + 1
    assert found(0, scene, at="start") == found(after, scene, at="own") == []
    assert found(after, scene, at="beside") == [("at", "cup is 30 mm from beside, at most 20 mm")]
    assert found(0, scene, at="own")[0][0] == found(after, scene, at="start")[0][0] == "at"


def test_a_release_at_a_named_place_leaves_it_there(found, spec_of):
    scene, steps = with_places(found.scene), spec_of(65).task.steps
    named = tuple(replace(step, place="beside") if isinstance(step, ReleaseStep) else step for step in steps)
    after = found.release + 1
    assert found(after, scene, named, at="beside") == []
    near = Nearness(within_m=0.029, place="own")
    detail = "the centre of cup is 30 mm from its position at own, at most 29 mm"
    assert found(after, scene, named, near=near) == [("near", detail)]
    assert found(after, scene, named, near=replace(near, within_m=0.03)) == []


def test_a_height_off_the_place_is_named(found):
    scene = with_places(found.scene)
    x, y, z = scene.place.centre_m
    high = replace(scene.places[0], region=replace(scene.place, centre_m=(x, y, z + 0.2)))
    ((key, detail),) = found(found.release + 1, replace(scene, places=(high,)), at="own")
    assert key == "at"
    assert "cup is 0 mm from own and 200 mm off its height there" in detail


def test_what_the_arm_carries_is_where_the_arm_is(found):
    """Before the first move after the grip it is still where it was."""
    scene = with_places(found.scene)
    far = Nearness(within_m=0.01, point_m=(0.0, 0.0, 0.0))
    assert found(found.grip + 2, scene, at="own", near=far, is_upright=True) == []
    assert [key for key, _ in found(found.grip + 1, scene, at="own", near=far)] == ["at", "near"]


def test_an_object_on_another_moves_with_it(found):
    """The box stands on the cup, whose centre it is 60 mm above."""
    scene = found.scene
    pose = scene.workpiece.pose.raised(0.06)
    box = SceneObject(
        workpiece=replace(scene.workpiece, id="box", pose=pose),
        support="cup",
        place=scene.place,
        place_support=scene.place_support,
    )
    both = replace(scene, others=(box,))
    near = Nearness(within_m=0.05, object="cup")
    assert found(0, both, object="box", near=near) == [
        ("near", "the centre of box is 60 mm from that of cup, at most 50 mm")
    ]
    assert found(found.grip + 2, both, object="box", near=near) == []


def test_an_object_that_leans_at_the_start_is_not_upright(found):
    scene = found.scene
    leaning = Pose.from_roll_pitch_yaw(scene.workpiece.pose.position_m, (math.radians(20), 0.0, 0.0))
    placed = {"cup": ObjectPlacement(pose=leaning, support=scene.support)}
    scene = scene_about(scene, "cup", place="", placements=placed)
    ((key, detail),) = found(0, scene, is_upright=True)
    assert key == "upright"
    assert detail.startswith("cup is tilted by 20 deg, at most ")
    assert found(found.release + 1, scene, is_upright=True) == []
