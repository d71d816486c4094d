"""Whole trials of a suction cup that chooses its place on the object."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Failure, Fidelity
from rgss.scenes import Approach, Box, GraspCandidates, LyingCylinder, MeshShape, corners_of
from rgss.trials.workcell import cell_of, grasp_searches_of
from tests.fixtures.shared_trials import record_without_bench
from tests.trials.hands.gripper_files import gripper_of

BOX = Box(size_m=(0.06, 0.05, 0.08))
GYRATION = ((0.05**2 + 0.08**2) / 12, (0.06**2 + 0.08**2) / 12, (0.06**2 + 0.05**2) / 12, 0.0, 0.0, 0.0)
# A block with a ridge across one half of its top, so that the middle of the top is an edge.
RIDGED = MeshShape(
    parts_m=(
        tuple((x, y, z - 0.0075) for x, y, z in corners_of(Box(size_m=(0.08, 0.05, 0.05)))[0]),
        tuple((x - 0.025, y, z + 0.0225) for x, y, z in corners_of(Box(size_m=(0.03, 0.05, 0.02)))[0]),
    ),
    sha256="ridged",
)
OBJECTS = {
    "box": (BOX, {}),
    "box, centre of mass aside": (BOX, {"centre_of_mass_across_m": (0.012, 0.0)}),
    "mesh": (MeshShape(parts_m=corners_of(BOX), sha256="box"), {"gyration_m2": GYRATION}),
}
CANDIDATES = GraspCandidates(approaches=tuple(Approach), yaws=8)


@pytest.fixture(scope="module")
def with_cup(spec_of, tmp_path_factory):
    """Makes the nominal trial of a cup with an object."""

    def make(shape, candidates=CANDIDATES, mass_kg=0.15, **changes):
        spec = spec_of(65)
        scene = spec.scene
        x, y, z = scene.workpiece.pose.position_m
        foot = z - scene.workpiece.shape.half_height_m
        pose = replace(scene.workpiece.pose, position_m=(x, y, foot + shape.half_height_m))
        piece = replace(scene.workpiece, shape=shape, pose=pose, mass_kg=mass_kg, **changes)
        return replace(
            spec,
            scene=replace(scene, workpiece=piece, task=replace(scene.task, candidates=candidates)),
            gripper=gripper_of(tmp_path_factory.mktemp("cup"), "vacuum", shape),
            planning_limit_s=8.0,
        )

    return make


@pytest.mark.parametrize("name", OBJECTS)
def test_the_chosen_point_carries_the_object_at_every_fidelity(with_cup, name):
    shape, changes = OBJECTS[name]
    spec = with_cup(shape, **changes)
    taken = cell_of(spec).scene.task.grasp
    for fidelity in Fidelity:
        record = record_without_bench(replace(spec, fidelity=fidelity))
        assert record.success, (fidelity, record.failed_phase, record.failure_detail)
        grasp = next(phase.metrics for phase in record.phases if phase.phase == "grasp")
        assert grasp["chosen_grasp_rank"] == taken.rejected + 1
        assert grasp["chosen_grasp_weight_1"] == taken.quality_1
        assert grasp["chosen_grasp_room_m"] == taken.suction.room_m
        assert "chosen_grasp_smw_1" not in grasp


def test_a_cup_from_the_side_carries_a_light_object_and_is_bent_off_a_heavy_one(with_cup):
    tall, side = Box(size_m=(0.05, 0.05, 0.24)), GraspCandidates(approaches=(Approach.SIDE,), yaws=8)
    spec = with_cup(tall, side, mass_kg=0.1)
    taken = cell_of(spec).scene.task.grasp
    assert taken.suction.position_m[2] == pytest.approx(0.0, abs=1e-6)
    # 25 mm to the centre of mass bend the cup of 10 mm radius.
    assert taken.quality_1 == pytest.approx(0.4)
    light = record_without_bench(replace(spec, fidelity=Fidelity.CONTACT))
    phases = {phase.phase: phase for phase in light.phases}
    assert phases["place"].metrics["place_error_m"] < 1e-4
    assert phases["move_to_place"].metrics["slip_m"] < 1e-4
    lift = phases["lift"].metrics
    # The margin at rest, less what the acceleration and, at 240 Hz, the jump of the load take.
    bent_n = 0.1 * (9.81 + lift["commanded_tool_acceleration_m_s2"]) / taken.quality_1
    assert 0.85 < lift["grip_margin_min"] / (13.5 / bent_n) < 1.01
    # 13.5 N of vacuum bear 0.55 kg at rest.
    heavy = record_without_bench(replace(with_cup(tall, side, mass_kg=0.6), fidelity=Fidelity.CONTACT))
    assert heavy.failure is Failure.OBJECT_DROPPED
    assert "lifts the lip of the cup off the object" in heavy.failure_detail


def test_a_lying_cylinder_that_no_arm_reaches_from_the_side_says_so(with_cup):
    spec = with_cup(LyingCylinder(radius_m=0.03, length_m=0.06), rolling_resistance_m=5e-4)
    friction = spec.gripper.grip_coefficient(1.0)
    (search,) = grasp_searches_of(
        spec.scene, spec.gripper.geometry, friction=friction, clearance_m=0.005, task=spec.task
    )
    assert search.taken is None
    assert {grasp.suction.normal for grasp in search.ranked.grasps} == {(1.0, 0.0, 0.0), (-1.0, 0.0, 0.0)}
    assert sum(search.rejected.values()) == len(search.ranked.grasps) == 16


def test_the_cup_goes_over_the_centre_of_mass(with_cup):
    shape, changes = OBJECTS["box, centre of mass aside"]
    taken = cell_of(with_cup(shape, **changes)).scene.task.grasp
    assert taken.suction.position_m == pytest.approx((0.012, 0.0, 0.04), abs=1e-6)
    assert taken.quality_1 == pytest.approx(1.0)


def test_a_shape_without_a_face_for_the_lip_has_no_candidate_and_fails_at_the_first_move(with_cup):
    spec = with_cup(Box(size_m=(0.015, 0.015, 0.015)))
    (search,) = grasp_searches_of(spec.scene, spec.gripper.geometry, friction=0.5, clearance_m=0.005, task=spec.task)
    assert search.reasons == "no flat face under the whole lip: 1"
    record = record_without_bench(replace(spec, fidelity=Fidelity.KINEMATIC))
    assert (record.failed_phase, record.failure) == ("move_to_grasp", Failure.INVALID_GOAL)
    assert record.failure_detail.endswith("can be carried out: no flat face under the whole lip: 1")


def test_a_cup_beside_a_ridge_seals_where_the_middle_of_the_object_has_none(with_cup):
    inertia = {"gyration_m2": (5e-4, 8e-4, 8e-4, 0.0, 0.0, 0.0)}
    spec = with_cup(RIDGED, GraspCandidates(approaches=(Approach.ABOVE,), yaws=8), **inertia)
    taken = cell_of(spec).scene.task.grasp
    record = record_without_bench(replace(spec, fidelity=Fidelity.CONTACT))
    assert taken.suction.normal == pytest.approx((0.0, 0.0, 1.0))
    # The ridge ends at -10 mm, the lip has a radius of 10 mm, and keeps 2 mm from the ridge.
    assert 0.002 <= taken.suction.position_m[0] <= 0.005
    assert taken.suction.position_m[2] == pytest.approx(0.0175)
    assert record.success, (record.failed_phase, record.failure_detail)
