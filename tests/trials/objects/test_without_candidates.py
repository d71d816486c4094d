"""Trials of objects that no candidate of the allowed approaches can grasp, though the stated grasp would."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Failure, Fidelity
from rgss.scenes import Approach, Box, GraspCandidates
from rgss.tasks import load_task
from rgss.trials.grasp_choice import grasp_search
from rgss.trials.pieces.run import Pieces
from rgss.trials.scene_check import SceneProblemKind, reach_problems

# A parallel gripper has no pair of faces of a box that an oblique approach can close on.
OBLIQUE = GraspCandidates(approaches=(Approach.OBLIQUE,), yaws=4)
DIRECT = """
task: direct
start: {to: grasp_approach}
steps:
  - move: {to: grasp, mode: straight}
  - grip: {}
  - move: {to: lift, mode: straight}
  - move: {to: place_approach, mode: straight}
  - move: {to: place, mode: straight}
  - release: {}
"""


@pytest.fixture
def oblique(with_two):
    """The carton alone or with the tin, in an order of the two."""

    def make(order):
        spec = with_two(order=order)
        scene = replace(spec.scene, task=replace(spec.scene.task, candidates=OBLIQUE))
        return replace(spec, scene=scene if "tin" in order else replace(scene, others=()))

    return make


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", Fidelity)
def test_a_planned_task_ends_at_the_first_move_of_the_object(oblique, fidelity):
    record = Pieces().record(replace(oblique("cup"), fidelity=fidelity))
    assert record.failure is Failure.INVALID_GOAL
    assert record.failed_phase == record.phases[0].phase
    assert record.failure_detail.startswith("no grasp candidate of cup can be carried out: ")


@pytest.mark.engine
@pytest.mark.parametrize("fidelity", Fidelity)
def test_so_does_a_task_of_straight_moves(oblique, fidelity, tmp_path):
    path = tmp_path / "direct.yaml"
    path.write_text(DIRECT, encoding="utf-8")
    record = Pieces().record(replace(oblique("cup"), task=load_task(path).program, fidelity=fidelity))
    assert (record.failed_phase, record.failure) == ("move_to_grasp", Failure.UNREACHABLE_WAYPOINT)
    assert record.failure_detail.startswith("no grasp candidate of cup can be carried out: ")


@pytest.mark.engine
def test_an_object_with_a_grasp_is_carried_before_one_without(with_two):
    """The tin is too wide for the hand: the task ends where it comes to it."""
    wide = Box(size_m=(0.2, 0.21, 0.06))
    record = Pieces().record(replace(with_two(order="cup, tin", tin=wide, aside_m=-0.3), fidelity=Fidelity.KINEMATIC))
    assert record.failed_phase == "tin.move_to_grasp_approach"
    assert record.failure_detail.startswith("no grasp candidate of tin can be carried out: ")
    assert record.metrics["phases_completed"] == 10


@pytest.mark.engine
def test_an_object_on_which_no_hand_closes_is_not_grasped_by_a_rejected_candidate(with_two, monkeypatch):
    """A link of the hand meets the object before the pads do, for every candidate."""
    monkeypatch.setattr(grasp_search, "_is_met", lambda *_: True)
    spec = with_two(order="cup", mass_kg=0.123)
    spec = replace(spec, scene=replace(spec.scene, others=()), fidelity=Fidelity.KINEMATIC)
    record = Pieces().record(spec)
    assert record.failure is Failure.INVALID_GOAL
    assert "; of the best one" not in record.failure_detail
    assert "a link of the hand while it closes: " in record.failure_detail
    geometry = spec.gripper.geometry
    (problem,) = reach_problems(spec.scene, geometry, clearance_m=0.0051, task=spec.task, friction=0.7)
    assert (problem.kind, problem.waypoint) == (SceneProblemKind.NO_GRASP, None)
