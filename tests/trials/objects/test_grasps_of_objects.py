"""Whole trials of several objects, each with a grasp of its own."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity
from rgss.scenes import (
    Box,
    Cylinder,
    NamedPlace,
    Pose,
    finger_pads,
)
from rgss.scenes.uncertainty import Constant, Uncertainty, UncertainValue
from rgss.tasks import load_task
from rgss.trials import cell_of
from rgss.trials.replay import NodeKind
from rgss.trials.replay.replayed_trial import run_replayed_trial
from rgss.trials.route import route_of
from rgss.trials.scene_check import SceneProblemKind, reach_problems
from rgss.trials.second_engine import mujoco_settings
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import gripper_of
from tests.trials.objects.two_objects import CANDIDATES, CARTON, TIN, on_top

BY_THE_BUFFER = """
task: by_the_buffer
steps:
  - move: {to: grasp_approach}
  - move: {to: grasp, mode: straight}
  - grip: {}
  - move: {to: lift, mode: straight}
  - move: {to: place_approach, place: buffer}
  - move: {name: down, to: place, place: buffer, mode: straight}
  - release: {name: set_down, place: buffer}
  - check: {name: stands, at: buffer, upright: true, held: false}
  - move: {name: back, to: grasp, mode: straight}
  - grip: {name: again}
  - move: {name: off, to: lift, mode: straight}
  - move: {name: over, to: place_approach}
  - move: {to: place, mode: straight}
  - release: {}
  - move: {name: retreat, to: place_approach, mode: straight}
"""


@pytest.mark.parametrize(("variant", "order"), [(65, "cup, tin"), (65, "tin, cup"), (5, "cup, tin")])
def test_each_object_is_carried_by_a_grasp_of_its_own(with_two, variant, order):
    """The oracle is the shape: where its faces are, and so where the fingers stop."""
    spec = with_two(variant, order)
    first = spec.scene.workpiece.id
    taken = cell_of(spec).scene.grasps
    assert list(taken) == [first, "tin"]
    assert taken["tin"].opening_m == pytest.approx(TIN.radius_m, abs=1e-6)
    if spec.gripper.geometry.fingers == 2:
        across = taken[first].tool_in_object.rotate((1.0, 0.0, 0.0))
        half_m = sum(abs(share) * edge / 2 for share, edge in zip(across, CARTON.size_m, strict=True))
        assert taken[first].opening_m == pytest.approx(half_m, abs=1e-6)
    for fidelity in Fidelity:
        record = record_without_bench(replace(spec, fidelity=fidelity))
        assert record.success, (fidelity, record.failed_phase, record.failure_detail)
        phases = {phase.phase: phase.metrics for phase in record.phases}
        for name, grasp in taken.items():
            gripped = phases[f"{name}.grip"]
            assert gripped["chosen_grasp_opening_m"] == grasp.opening_m
            assert gripped["chosen_grasp_position_m"] == grasp.tool_in_object.position_m
            if fidelity is Fidelity.CONTACT:
                travel = spec.gripper.geometry.largest_opening_m - grasp.opening_m
                assert gripped["finger_travel_m"] == pytest.approx((travel,) * spec.gripper.geometry.fingers, abs=1e-3)
                assert phases[f"{name}.release"]["place_error_m"] < 1e-3
                # Between the grip and the lift the object stands on its support, which is no collision.
                assert phases[f"{name}.wait"]["slip_m"] < 1e-4


def test_both_engines_carry_both_objects(with_two):
    spec = replace(with_two(), fidelity=Fidelity.CONTACT)
    other = replace(spec, settings=replace(spec.settings, physics=mujoco_settings()))
    first, second = record_without_bench(spec), record_without_bench(other)
    assert (first.failure_detail, second.failure_detail) == ("", "")
    for one, two in zip(first.phases, second.phases, strict=True):
        assert one.duration_s == pytest.approx(two.duration_s, abs=3 / 240), one.phase


@pytest.mark.parametrize("order", ["cup, tin", "tin, cup"])
def test_a_low_object_is_held_by_the_pads_as_a_tall_one_is(with_two, order):
    """The elements of the pads at the ends of the carton are beyond the ends of the low one."""
    low = Box(size_m=(0.05, 0.05, 0.055))
    spec = replace(with_two(order=order, tin=low), fidelity=Fidelity.CONTACT)
    (tin,) = spec.scene.others
    heavy = replace(tin.workpiece, mass_kg=0.5, centre_of_mass_across_m=(0.012, 0.0))
    spec = replace(spec, scene=replace(spec.scene, others=(replace(tin, workpiece=heavy),)))
    scene = cell_of(spec).scene
    elements = [len(pad.elements) for pad in finger_pads(scene, spec.gripper.geometry)]
    assert all(4 < count <= 8 for count in elements)
    record = record_without_bench(spec)
    assert record.success, (record.failed_phase, record.failure_detail)
    carried = {phase.phase: phase.metrics for phase in record.phases}["tin.move_to_place_approach"]
    # With the elements of the carton alone it slips by 0.5 mm.
    assert carried["slip_m"] < 3.5e-4


def test_objects_of_one_form_have_the_pads_of_one(with_two):
    spec = with_two(tin=CARTON)
    scene = cell_of(spec).scene
    alone = replace(scene, others=())
    same = scene.with_grasps({"tin": scene.task.grasp})
    assert finger_pads(same, spec.gripper.geometry) == finger_pads(alone, spec.gripper.geometry)


def test_the_route_has_the_grasp_of_each_object(with_two):
    spec = with_two()
    scene = cell_of(spec).scene
    legs = {leg.step.name: leg for leg in route_of(scene, spec.gripper.geometry, spec.task).legs}
    for one in scene.objects:
        leg = legs[f"{one.workpiece.id}.move_to_grasp"]
        stop = route_of(scene, spec.gripper.geometry, spec.task).stops[leg.goal]
        expected = one.workpiece.pose @ one.grasp.tool_in_object
        assert stop.pose.position_m == pytest.approx(expected.position_m, abs=1e-9)
        carried = legs[f"{one.workpiece.id}.move_to_place"].context
        assert carried.opening_m == one.grasp.opening_m
        assert isinstance(carried.carried, Pose)


@pytest.mark.parametrize("candidates", [CANDIDATES, None], ids=["chosen", "stated"])
def test_a_cup_takes_objects_of_different_heights(with_two, tmp_path, candidates):
    spec = with_two()
    task = replace(spec.scene.task, candidates=candidates)
    spec = replace(spec, scene=replace(spec.scene, task=task), gripper=gripper_of(tmp_path, "vacuum", CARTON))
    scene = cell_of(spec).scene
    geometry, step = spec.gripper.geometry, {leg.step.name: leg for leg in cell_of(spec).route.legs}
    for one in scene.objects:
        # The lip is as far above the top of each object: the flange stands as high above it.
        stop = cell_of(spec).route.stops[step[f"{one.workpiece.id}.move_to_grasp"].goal]
        flange_m = stop.pose.position_m[2] + geometry.grasp_depth_m
        top_m = one.workpiece.pose.position_m[2] + one.workpiece.shape.half_height_m
        lip_m = flange_m - geometry.base.height_m - geometry.cup.height_m
        assert 0.0 < lip_m - top_m < spec.gripper.suction.largest_gap_m
    for fidelity in (Fidelity.KINEMATIC, Fidelity.CONTACT):
        record = record_without_bench(replace(spec, fidelity=fidelity))
        assert record.success, (fidelity, record.failed_phase, record.failure_detail)
        chosen = ["chosen_grasp_rank" in phase.metrics for phase in record.phases]
        assert any(chosen) == (candidates is not None)


def test_the_replay_has_the_pull_of_a_cup_and_where_each_object_is_perceived(with_two, tmp_path):
    spec = with_two()
    task = replace(spec.scene.task, candidates=None)
    errors = [("perception.x", 2e-3), ("perception.tin.y", -1e-3)]
    values = tuple(UncertainValue(quantity=name, distribution=Constant(value=value)) for name, value in errors)
    scene = replace(spec.scene, task=task)
    replayed = run_replayed_trial(
        replace(
            spec,
            scene=scene,
            gripper=gripper_of(tmp_path, "vacuum", CARTON),
            uncertainty=Uncertainty(values=values),
            fidelity=Fidelity.CONTACT,
        )
    )

    assert replayed.record.success, replayed.record.failure_detail
    found = replayed.scene
    apart = {one.object: one.distance_m for one in found.perceived}
    assert apart == {
        one.workpiece.id: pytest.approx(abs(by)) for one, (_, by) in zip(scene.objects, errors, strict=True)
    }
    seen = [node.name for node in found.nodes if node.kind is NodeKind.PERCEIVED]
    assert seen == [one.workpiece.id for one in scene.objects]
    # Newton's second law: over a carry from rest to rest the mean vertical force is the weight.
    (pull,) = found.contacts
    for one in scene.objects:
        span = next(span for span in replayed.trace.spans if span.phase == f"{one.workpiece.id}.move_to_place_approach")
        within = (found.time_s > span.start_s) & (found.time_s <= span.end_s)
        upward = pull.forces_n[within, 2]
        assert float(np.mean(upward)) == pytest.approx(one.workpiece.mass_kg * scene.gravity_m_s2, rel=0.05)
        (node,) = (node for node in found.nodes if (node.kind, node.name) == (NodeKind.OBJECT, one.workpiece.id))
        above_m = pull.points_m[within, 2] - node.positions_m[within, 2]
        assert above_m == pytest.approx(one.workpiece.shape.half_height_m, abs=3e-3)


@pytest.mark.parametrize("fidelity", Fidelity)
def test_the_first_object_is_set_down_at_another_place_before_its_own(with_two, tmp_path, fidelity):
    spec = with_two()
    (tin,) = spec.scene.others
    path = tmp_path / "by_the_buffer.yaml"
    path.write_text(BY_THE_BUFFER, encoding="utf-8")
    buffer = NamedPlace(id="buffer", region=tin.place, support=tin.place_support)
    scene = replace(spec.scene, places=(buffer,))

    record = record_without_bench(replace(spec, scene=scene, task=load_task(path).program, fidelity=fidelity))

    assert record.success, (record.failed_phase, record.failure_detail)
    if fidelity is Fidelity.CONTACT:
        at = {phase.phase: phase.metrics["workpiece_position_m"][:2] for phase in record.phases}
        assert at["set_down"] == pytest.approx(buffer.region.centre_m[:2], abs=2e-3)
        assert at["retreat"] == pytest.approx(scene.place.centre_m[:2], abs=2e-3)


def test_an_object_that_has_no_grasp_is_named_and_the_other_keeps_its_own(with_two):
    wide = with_two(tin=Cylinder(radius_m=0.12, height_m=0.06), aside_m=-0.3)
    problems = reach_problems(wide.scene, wide.gripper.geometry, clearance_m=0.005, task=wide.task, friction=0.7)
    (problem,) = [one for one in problems if one.kind is SceneProblemKind.NO_GRASP]
    assert problem.first == "tin"
    assert "too wide" in problem.detail
    record = record_without_bench(replace(wide, fidelity=Fidelity.KINEMATIC))
    assert record.failure is Failure.INVALID_GOAL
    assert record.failure_detail.startswith("no grasp candidate of tin can be carried out: ")


def test_another_object_that_topples_is_not_said_to_be_touched(with_two):
    spec = with_two()
    (tin,) = spec.scene.others
    # Its centre of mass is beside its foot.
    leaning = replace(tin, workpiece=replace(tin.workpiece, centre_of_mass_across_m=(TIN.radius_m + 0.01, 0.0)))
    scene = replace(spec.scene, others=(leaning,), task=replace(spec.scene.task, candidates=None))
    record = record_without_bench(replace(spec, scene=scene, fidelity=Fidelity.CONTACT))
    assert record.failure is Failure.NOT_UPRIGHT
    assert record.failed_phase == f"{spec.scene.workpiece.id}.move_to_grasp_approach"
    assert record.failure_detail.startswith("tin toppled by itself: it is tilted by ")


@pytest.mark.parametrize("variant", [65, 5])
def test_an_object_is_stacked_on_one_that_was_carried_before(with_two, variant):
    """The oracle is the carton's place and height: there the tin has to stand, in every fidelity."""
    spec = with_two(variant)
    first = spec.scene.workpiece.id
    spec = replace(spec, scene=on_top(spec.scene, of=first))
    for fidelity in Fidelity:
        record = record_without_bench(replace(spec, fidelity=fidelity))
        assert record.success, (fidelity, record.failed_phase, record.failure_detail)
    released = {phase.phase: phase.metrics for phase in record.phases}["tin.release"]
    assert released["place_error_m"] < 1e-3
    x, y, z = spec.scene.place.centre_m
    height_m = CARTON.size_m[2] + TIN.half_height_m
    found = np.array(released["workpiece_position_m"]) - (x, y, z)
    assert found[2] == pytest.approx(height_m, abs=5e-4)
    assert np.hypot(*found[:2]) == pytest.approx(np.hypot(0.004, 0.002), abs=1e-3)


def test_an_object_is_put_on_one_that_stays_where_it_was_perceived(with_two):
    """The carton stands 6 mm beside where the files say, as the robot sees: the tin comes on it, not on its place."""
    spec = with_two(order="tin")
    first = spec.scene.workpiece.id
    shifted = Uncertainty(values=(UncertainValue(quantity="workpiece.x", distribution=Constant(value=0.006)),))
    spec = replace(spec, scene=on_top(spec.scene, of=first), uncertainty=shifted, fidelity=Fidelity.CONTACT)
    record = record_without_bench(spec)
    assert record.success, (record.failed_phase, record.failure_detail)
    released = {phase.phase: phase.metrics for phase in record.phases}["tin.release"]
    x, y, _ = spec.scene.workpiece.pose.position_m
    assert released["workpiece_position_m"][:2] == pytest.approx((x + 0.006 + 0.004, y - 0.002), abs=1e-3)


def test_a_stack_is_taken_down_from_the_top(with_two):
    spec = with_two(order="tin, cup")
    scene = spec.scene
    (tin,) = scene.others
    top = scene.workpiece.pose.raised(CARTON.size_m[2] / 2 + TIN.half_height_m)
    stacked = replace(tin, support=scene.workpiece.id, workpiece=replace(tin.workpiece, pose=top))
    spec = replace(spec, scene=replace(scene, others=(stacked,)))
    for fidelity in Fidelity:
        record = record_without_bench(replace(spec, fidelity=fidelity))
        assert record.success, (fidelity, record.failed_phase, record.failure_detail)
    below = with_two(order="cup, tin")
    below = replace(below, scene=replace(below.scene, others=(stacked,)), fidelity=Fidelity.CONTACT)
    assert not record_without_bench(below).success
