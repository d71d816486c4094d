"""An object that is released where it was gripped, without a move between."""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from rgss.evidence import Failure
from rgss.scenes import NamedPlace
from rgss.tasks import HandAction
from rgss.trials.geometry_checks import hand_step_problems
from tests.fixtures.shared_trials import record_without_bench

pytestmark = pytest.mark.engine


@pytest.fixture
def put_back(spec_of):
    """A trial that goes to the cup, grips it, and releases it there."""
    spec = spec_of(65)
    steps = tuple(step for step in spec.task.steps if step.hand in (HandAction.CLOSES, HandAction.OPENS))
    planning = replace(spec.settings.planning, moves=())
    task = replace(spec.task, steps=(spec.task.steps[0], *steps))
    return replace(spec, task=task, settings=replace(spec.settings, planning=planning))


def test_the_check_has_its_distance_from_its_place(put_back):
    scene, geometry = put_back.scene, put_back.gripper.geometry
    (found,) = hand_step_problems(scene, geometry, clearance_m=0.005, task=put_back.task)
    distance_m = math.dist(scene.workpiece.pose.position_m[:2], scene.place.centre_m[:2])
    assert (found.step, found.hand, found.is_aside) == (2, HandAction.OPENS, True)
    assert found.distance_m == pytest.approx(distance_m)
    x, y, z = scene.workpiece.pose.position_m
    here = replace(scene.place, centre_m=(x, y, z - scene.workpiece.shape.half_height_m))
    assert hand_step_problems(replace(scene, place=here), geometry, clearance_m=0.005, task=put_back.task) == ()


def test_a_trial_says_that_it_is_not_at_its_place(put_back):
    """It stands on its own support, which it does not collide with."""
    record = record_without_bench(put_back)
    assert record.failure is Failure.NOT_IN_PLACE_REGION
    assert "mm from the place and 0.0 mm off its height" in record.failure_detail


def test_at_a_named_place_it_stands_where_it_is_released(put_back):
    scene, (first, grip, release) = put_back.scene, put_back.task.steps
    x, y, z = scene.workpiece.pose.position_m
    region = replace(scene.place, centre_m=(x, y, z - scene.workpiece.shape.half_height_m))
    start = NamedPlace(id="start", region=region, support=scene.support)
    spec = replace(
        put_back,
        scene=replace(scene, places=(start,)),
        task=replace(put_back.task, steps=(first, grip, replace(release, place="start"))),
    )
    assert hand_step_problems(spec.scene, spec.gripper.geometry, clearance_m=0.005, task=spec.task) == ()
    assert record_without_bench(spec).failure is None
