"""Whole trials of objects that are no upright cylinder, on both grippers and at every fidelity."""

from __future__ import annotations

import itertools
import math
import re
from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity
from rgss.scenes import Approach, Box, GraspCandidates, LyingCylinder, MeshShape
from rgss.trials.conditions import conditions_of
from rgss.trials.planning.goal_reasons import Obstacle
from rgss.trials.scene_check import SceneProblemKind, reach_problems
from rgss.trials.workcell import cell_of, grasp_searches_of
from tests.fixtures.shared_trials import record_without_bench

SIDE_M, HALF_M = 0.04, 0.04
HEXAGON = MeshShape(
    parts_m=(
        tuple(
            (SIDE_M * math.cos(turn * math.pi / 3), SIDE_M * math.sin(turn * math.pi / 3), z)
            for turn in range(6)
            for z in (-HALF_M, HALF_M)
        ),
    ),
    sha256="hexagon",
)
BRACKET = MeshShape(
    parts_m=tuple(
        tuple(itertools.product(*zip(low, high, strict=True)))
        for low, high in (
            ((-0.035, -0.035, -0.02), (0.035, -0.01, 0.02)),
            ((-0.035, -0.01, -0.02), (-0.01, 0.035, 0.02)),
        )
    ),
    sha256="bracket",
)
POLAR = 5.0 * SIDE_M**2 / 12.0
OBJECTS = {
    "box": (Box(size_m=(0.06, 0.05, 0.08)), {}),
    "lying cylinder": (LyingCylinder(radius_m=0.03, length_m=0.09), {"rolling_resistance_m": 5e-4}),
    "mesh": (HEXAGON, {"gyration_m2": (POLAR / 2 + HALF_M**2 / 3, POLAR / 2 + HALF_M**2 / 3, POLAR, 0.0, 0.0, 0.0)}),
    "low box": (Box(size_m=(0.06, 0.05, 0.024)), {}),
    "two parts": (
        BRACKET,
        {
            "gyration_m2": (7e-4, 7e-4, 1.2e-3, 2e-4, 0.0, 0.0),
            "centre_of_mass_across_m": (-0.009, -0.009),
        },
    ),
}
TRIED = [
    *(("box", 65), ("box", 5), ("lying cylinder", 65), ("mesh", 65), ("mesh", 5)),
    *(("low box", 65), ("low box", 5), ("two parts", 65)),
]
CANDIDATES = GraspCandidates(approaches=tuple(Approach), heights=3, yaws=8, samples=24)


@pytest.fixture(scope="module")
def with_object(spec_of):
    """Makes the nominal trial of a variant with another object."""

    def make(name, variant=65, candidates=CANDIDATES, **changes):
        spec = spec_of(variant)
        shape, stated = OBJECTS[name] if isinstance(name, str) else (name, {})
        scene = spec.scene
        x, y, z = scene.workpiece.pose.position_m
        foot = z - scene.workpiece.shape.half_height_m
        pose = replace(scene.workpiece.pose, position_m=(x, y, foot + shape.half_height_m))
        piece = replace(scene.workpiece, shape=shape, pose=pose, **{**stated, **changes})
        return replace(spec, scene=replace(scene, workpiece=piece, task=replace(scene.task, candidates=candidates)))

    return make


@pytest.mark.parametrize(("name", "variant"), TRIED)
def test_the_chosen_grasp_carries_the_object_at_every_fidelity(with_object, name, variant):
    spec = replace(with_object(name, variant), planning_limit_s=8.0)
    taken = cell_of(spec).scene.task.grasp
    for fidelity in Fidelity:
        record = record_without_bench(replace(spec, fidelity=fidelity))
        assert record.success, (fidelity, record.failed_phase, record.failure_detail)
        grasp = next(phase.metrics for phase in record.phases if phase.phase == "grasp")
        assert grasp["chosen_grasp_rank"] == taken.rejected + 1
        assert grasp["chosen_grasp_position_m"] == taken.tool_in_object.position_m
        if fidelity is Fidelity.CONTACT:
            # The fingers stop where the pads were computed to touch.
            travel = spec.gripper.geometry.largest_opening_m - taken.opening_m
            assert grasp["finger_travel_m"] == pytest.approx((travel,) * spec.gripper.geometry.fingers, abs=1e-3)
            assert record.metrics["held_distance_m"] < 1e-3


def test_candidates_are_chosen_on_the_perceived_pose(with_object):
    spec = with_object("box")
    shifted = replace(spec.scene.workpiece.pose, position_m=(0.68, *spec.scene.workpiece.pose.position_m[1:]))
    moved = replace(spec, scene=replace(spec.scene, workpiece=replace(spec.scene.workpiece, pose=shifted)))
    scene = cell_of(moved).scene
    assert (scene.grasp.inverse() @ shifted).position_m == pytest.approx(
        scene.task.grasp.tool_in_object.inverse().position_m
    )


def test_an_object_that_the_hand_cannot_close_on_is_a_finding(with_object):
    spec = with_object(Box(size_m=(0.2, 0.2, 0.1)))
    problems = reach_problems(spec.scene, spec.gripper.geometry, clearance_m=0.005, task=spec.task, friction=0.7)
    (problem,) = [one for one in problems if one.kind is SceneProblemKind.NO_GRASP]
    # Its height would fit from the side, where the table is in the way.
    assert "too wide: " in problem.detail
    assert problem.reason.obstacle is Obstacle.COLLISION


def test_a_shape_without_candidates_is_a_finding_with_the_reason(with_object):
    """Of a cone on its apex, no two surfaces face each other."""
    rim = [(0.03 * math.cos(turn), 0.03 * math.sin(turn), 0.045) for turn in np.linspace(0.0, math.tau, 25)[:-1]]
    spec = with_object(MeshShape(parts_m=((*rim, (0.0, 0.0, -0.045)),), sha256=""))
    problems = reach_problems(spec.scene, spec.gripper.geometry, clearance_m=0.005, task=spec.task, friction=0.7)
    (problem,) = [one for one in problems if one.kind is SceneProblemKind.NO_GRASP]
    assert problem.detail == "its shape has no two surfaces that face each other within the friction of the pads"


def test_an_object_that_does_not_enter_the_hand_is_given_with_both_sizes(with_object):
    spec = with_object(Box(size_m=(0.2, 0.21, 0.19)))
    (problem,) = reach_problems(spec.scene, spec.gripper.geometry, clearance_m=0.005, task=spec.task, friction=0.7)
    opens_mm = 2e3 * spec.gripper.geometry.largest_opening_m
    assert problem.detail.endswith(
        f"; 190 mm across at best, and the gripper opens to {opens_mm:.4g} mm, which leaves room for "
        f"{opens_mm - 4.0:.4g} mm at most"
    )
    assert problem.reason is None


def test_an_object_that_the_closed_hand_does_not_touch_is_a_finding(with_object):
    spec = with_object(Box(size_m=(0.003, 0.004, 0.006)))
    geometry = replace(spec.gripper.geometry, stroke_m=0.02)
    (problem,) = reach_problems(spec.scene, geometry, clearance_m=0.005, task=spec.task, friction=0.7)
    assert "too narrow: " in problem.detail
    closes_mm = 2e3 * (geometry.largest_opening_m - 0.02)
    assert problem.detail.endswith(f"; 6 mm across at best, and the gripper closes to {closes_mm:.4g} mm")


def test_the_best_grasp_that_no_arm_reaches_is_given_with_its_distance(with_object):
    spec = with_object("box")
    x, y, z = spec.scene.workpiece.pose.position_m
    away = replace(spec.scene.workpiece.pose, position_m=(x + 3.0, y, z))
    scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, pose=away))
    (problem,) = reach_problems(scene, spec.gripper.geometry, clearance_m=0.005, task=spec.task, friction=0.7)
    assert (problem.kind, problem.first) == (SceneProblemKind.NO_GRASP, spec.scene.workpiece.id)
    assert problem.waypoint == "grasp_approach"
    assert problem.reason.obstacle is Obstacle.OUT_OF_REACH
    assert problem.reason.distance_m > 3.0


def test_a_trial_without_a_grasp_says_why_no_candidate_can_be_carried_out(with_object):
    """And not only which waypoint the stated grasp, which the task does not use, would not serve."""
    record = record_without_bench(replace(with_object(Box(size_m=(0.2, 0.21, 0.19))), fidelity=Fidelity.KINEMATIC))
    assert record.failure is Failure.INVALID_GOAL
    detail = record.failure_detail
    assert re.fullmatch(
        r"no grasp candidate of \w+ can be carried out: .*too wide: \d+.*; 190 mm across at best, and the gripper "
        r"opens to \d+ mm, which leaves room for \d+ mm at most",
        detail,
    )

    spec = with_object("box")
    x, y, z = spec.scene.workpiece.pose.position_m
    away = replace(spec.scene.workpiece.pose, position_m=(x + 3.0, y, z))
    scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, pose=away))
    detail = record_without_bench(replace(spec, scene=scene, fidelity=Fidelity.KINEMATIC)).failure_detail
    assert re.fullmatch(
        r"no grasp candidate of \w+ can be carried out: .*reach: \d+; of the best one, no valid configuration for "
        r"grasp_approach: out of reach: 3\.\d\d m .*",
        detail,
    )


def test_of_a_plate_that_is_too_low_for_the_fingers_a_trial_says_so(with_object):
    plate = with_object(Box(size_m=(0.06, 0.05, 0.008)))
    record = record_without_bench(replace(plate, fidelity=Fidelity.KINEMATIC))
    assert record.failure_detail.startswith("no grasp candidate of ")
    assert "; from above, fingers that keep the clearance of " in record.failure_detail
    assert "of its height of 8 mm, and need 5 mm" in record.failure_detail


def test_a_grasp_that_no_arm_reaches_is_counted_by_its_filter(with_object):
    spec = with_object("box")
    x, y, z = spec.scene.workpiece.pose.position_m
    away = replace(spec.scene.workpiece.pose, position_m=(x + 3.0, y, z))
    scene = replace(spec.scene, workpiece=replace(spec.scene.workpiece, pose=away))
    (search,) = grasp_searches_of(scene, spec.gripper.geometry, friction=0.7, clearance_m=0.005, task=spec.task)
    assert search.taken is None
    assert sum(search.rejected.values()) == len(search.ranked.grasps)
    assert "reach: " in search.reasons


def test_a_stated_grasp_of_a_box_is_from_above_at_the_stated_turn(with_object):
    spec = with_object("box", candidates=None)
    record = record_without_bench(replace(spec, fidelity=Fidelity.CONTACT))
    assert record.success, record.failure_detail
    assert not any("chosen_grasp_rank" in phase.metrics for phase in record.phases)
    assert conditions_of(spec).scene.grasp.rotate((0.0, 0.0, 1.0)) == pytest.approx((0.0, 0.0, -1.0))
