"""What grippers of a kind cannot do is refused with a reason."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import pytest

from rgss.errors import SimulationError
from rgss.physics import open_world
from rgss.tasks import HandAction
from rgss.trials.geometry_checks import hand_step_problems
from rgss.trials.hands import hand_of
from rgss.trials.payload_bench import bench_of
from rgss.trials.payload_bench.of_trial import payload_bench
from rgss.trials.payload_bench.range import outside
from tests.trials.hands.gripper_files import gripper_of


def test_the_payload_bench_of_a_cup_is_that_of_its_place_on_the_object(spec_of, tmp_path):
    spec = replace(spec_of(), gripper=gripper_of(tmp_path, "vacuum"))
    bench = payload_bench(spec)

    assert bench.suction is not None
    assert bench.suction.position_m == (0.0, 0.0, spec.scene.workpiece.shape.half_height_m)
    assert bench_of(spec) == (None if outside(bench) else bench)


def test_there_is_no_bench_for_an_object_that_the_gripper_cannot_hold(spec_of, tmp_path):
    assert bench_of(replace(spec_of(), gripper=gripper_of(tmp_path, "parallel"))) is None


def test_drives_must_be_lighter_than_the_base(spec_of, tmp_path):
    gripper = replace(gripper_of(tmp_path, "parallel"), base_mass_kg=0.2)
    expected = "the drives' inertia of 0.2 kg must be less than the base's mass of 0.2 kg"
    with pytest.raises(SimulationError, match=expected):
        open_world(spec_of().scene, gripper, spec_of().settings.physics)


def test_a_hand_that_meets_nothing_says_so(spec_of):
    hand = hand_of(spec_of().gripper)
    assert hand.shortfall((0.0, 0.0), 1.75) == (
        "nothing is between the fingers: fingers press with 0.00, 0.00 N, each needs 1.75 N"
    )
    assert hand.shortfall((0.5, 0.0), 1.75) == "fingers press with 0.50, 0.00 N, each needs 1.75 N"


def test_a_cup_that_stops_above_the_object_grips_nothing(spec_of, tmp_path):
    spec = spec_of()
    geometry = gripper_of(tmp_path, "vacuum", spec.scene.workpiece.shape).geometry
    problems = partial(hand_step_problems, spec.scene, geometry, clearance_m=0.005)
    assert [one for one in problems(task=spec.task) if one.hand is HandAction.CLOSES] == []

    first, *others = spec.task.steps
    # At the grasp the lip is half of the largest gap of 3 mm above the object.
    for raised_m, found in ((0.0014, []), (0.0016, [0.0031]), (0.05, [0.0515])):
        raised = replace(first, target=replace(first.target, raised_m=raised_m))
        task = replace(spec.task, steps=(raised, *others))
        closing = [one for one in problems(task=task) if one.hand is HandAction.CLOSES]
        assert [one.distance_m for one in closing] == pytest.approx(found, abs=1e-6)
        assert all(one.has_cup and one.step == 1 for one in closing)
