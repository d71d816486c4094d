"""Places marked in films and replays: those at which the task releases an object, on fixed bodies."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import pytest

from rgss.physics import Camera, Posture
from rgss.physics.pictures.camera import View
from rgss.scenes import NamedPlace, PlaceRegion
from rgss.studies import load_project, trial_specs
from rgss.tasks import HandAction, default_task
from rgss.trials.marked_places import marked_places

ROOT = Path(__file__).resolve().parents[3]
ABOVE = View(azimuth_rad=math.radians(-90), elevation_rad=math.radians(90), distance_m=1.2)


@pytest.fixture(scope="module")
def cubes():
    """A trial in which three cubes are moved."""
    project = load_project(ROOT, "lite6_cubes")
    return trial_specs(project, variants=project.designs.expand()[:1], seeds=[1])[0]


def test_each_object_has_its_place(cubes):
    found = marked_places(cubes.scene, cubes.task)
    first, *others = [one.workpiece.id for one in cubes.scene.objects]
    assert list(found) == ["place", *(f"place of {name}" for name in others)]
    assert list(found.values()) == [one.place for one in cubes.scene.objects]
    assert first == cubes.scene.workpiece.id


def test_a_place_on_an_object_is_not_marked_and_one_of_several_objects_once(cubes):
    first, second, third = cubes.scene.objects
    stacked = replace(second, place=replace(second.place, offset_m=(0.0, 0.0)), place_support=first.workpiece.id)
    beside = replace(third, place=first.place)
    scene = replace(cubes.scene, others=(stacked, beside))
    assert list(marked_places(scene, cubes.task)) == ["place"]


def test_a_named_place_takes_the_place_of_the_objects_own(cubes):
    region = PlaceRegion(centre_m=(0.3, 0.1, 0.0), radius_m=0.02, largest_tilt_rad=0.1)
    scene = replace(cubes.scene, places=(NamedPlace(id="bin", region=region, support="table"),))
    task = default_task()
    steps = tuple(replace(step, place="bin") if step.hand is HandAction.OPENS else step for step in task.steps)
    assert marked_places(scene, replace(task, steps=steps)) == {"bin": region}


@pytest.mark.engine
def test_the_picture_shows_a_mat_on_each(cubes):
    scene = cubes.scene
    posture = Posture(
        joints_rad=list(scene.robot.home_rad),
        finger_travel_m=[0.0] * cubes.gripper.geometry.fingers,
        workpiece=scene.workpiece.pose,
        others={one.workpiece.id: one.workpiece.pose for one in scene.others},
    )
    pictures = []
    places = marked_places(scene, cubes.task)
    for marked in ({}, dict(list(places.items())[:1]), places):
        with Camera(scene, cubes.gripper, ABOVE, width=320, height=240, places=marked.values()) as camera:
            pictures.append(camera.picture(posture).astype(int))
    bare = pictures[0]
    of_one, of_all = ((abs(picture - bare).sum(axis=2) > 30).sum() for picture in pictures[1:])
    assert of_one > 10
    assert of_all > 2 * of_one
