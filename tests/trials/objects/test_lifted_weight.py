"""The predicted limit of what fingers lift, against contact trials on both sides of it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Failure
from rgss.scenes import Box
from rgss.trials import held_loads
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import gripper_of
from tests.trials.objects.two_objects import on_the_ground

pytestmark = pytest.mark.engine


def with_cube(spec, mass_kg, across_m):
    heavy = replace(spec.scene.workpiece, mass_kg=mass_kg, centre_of_mass_across_m=across_m)
    return replace(spec, scene=replace(spec.scene, workpiece=heavy))


@pytest.mark.parametrize(
    ("mass_kg", "across_m", "holds"),
    [
        (0.6, (0.0, 0.011), True),
        (0.6, (0.0, 0.0125), False),
        (0.75, (0.014, 0.005), True),
        (0.8, (0.014, 0.005), False),
    ],
)
def test_what_the_pads_do_not_bear_turns_in_the_hand(lite6, mass_kg, across_m, holds):
    """The friction available for the weight alone exceeds what the lift needs in all four, by a fifth and more."""
    spec = with_cube(lite6, mass_kg, across_m)
    load = next(load for load in held_loads(spec) if load.object == spec.scene.workpiece.id)
    assert load.needed == pytest.approx(1.0 + 2.0 / 9.81, rel=1e-3)
    assert load.is_borne is holds
    assert load.factor == pytest.approx(load.needed, rel=0.08)
    record = record_without_bench(spec)
    if holds:
        assert record.failure is None
    else:
        assert record.failure is Failure.OBJECT_DROPPED
        assert " deg in the gripper" in record.failure_detail


def test_objects_that_are_not_gripped_and_cups_have_none(lite6, with_two, tmp_path):
    assert [load.object for load in held_loads(lite6)] == [one.workpiece.id for one in lite6.scene.objects]
    spec = with_two(order="tin")
    assert [load.object for load in held_loads(spec)] == ["tin"]
    assert list(held_loads(replace(spec, gripper=gripper_of(tmp_path, "vacuum")))) == []


def test_an_object_without_a_grasp_has_none(with_two):
    wide = Box(size_m=(0.16, 0.16, 0.09))
    spec = with_two()
    own = spec.scene.workpiece
    carton = replace(
        own, shape=wide, pose=on_the_ground(own.pose, wide, foot_m=own.pose.position_m[2] - own.shape.half_height_m)
    )
    stuck = replace(spec, scene=replace(spec.scene, workpiece=carton))
    assert [load.object for load in held_loads(stuck)] == ["tin"]
