"""What is placed: each object counts, and the robot may not move it again."""

from __future__ import annotations

import math
import re
from dataclasses import replace
from types import SimpleNamespace

import pytest
from scipy.spatial.transform import Rotation

from rgss.evidence import Failure, Fidelity
from rgss.scenes import Box, Cylinder, LyingCylinder, Pose
from rgss.scenes.uncertainty import Constant, Uncertainty, UncertainValue
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.tasks import load_task
from rgss.trials.object_checks import check_place
from tests.fixtures.shared_trials import record_without_bench
from tests.fixtures.shipped_project import REPOSITORY

pytestmark = pytest.mark.engine

OFF_M = 0.008
TASK = """
task: pushed
start: {to: grasp_approach}
steps:
  - move: {name: to_grasp, to: grasp, mode: straight}
  - grip: {name: grasp}
  - move: {name: lift, to: lift, mode: straight}
  - move: {name: raise, to: grasp_departure, mode: straight}
  - move: {name: transfer, to: place_approach}
  - move: {name: to_place, to: place, mode: straight}
  - release: {name: place}
"""
WAIT = "  - wait: {name: pause, duration: 100 ms}\n"
PUSH = """\
  - move: {name: slide, pose: {position: [0.27 m, 0.144 m, 18 mm], roll: 180 deg}, mode: straight}
  - move: {name: aside, pose: {position: [0.33 m, 0.144 m, 18 mm], roll: 180 deg}, mode: straight}
  - move: {name: up, pose: {position: [0.33 m, 0.144 m, 118 mm], roll: 180 deg}, mode: straight}
"""
LEAVE = "  - move: {name: leave, to: place_approach, mode: straight}\n"


def of_cubes(**perceived_m):
    """The nominal contact trial of the Lite6 in which the first cube is perceived beside where it stands."""
    project = load_project(REPOSITORY, "studies/lite6_cubes.yaml")
    (spec,) = trial_specs(project, variants=[project.designs.variant(46)], seeds=[1])
    values = tuple(
        UncertainValue(quantity=f"perception.{axis}", distribution=Constant(value=value))
        for axis, value in perceived_m.items()
    )
    return replace(spec, uncertainty=Uncertainty(values=values))


def pushed(tmp_path, steps):
    path = tmp_path / "pushed.yaml"
    path.write_text(TASK + steps, encoding="utf-8")
    spec = of_cubes(y=-OFF_M)
    settings = replace(spec.settings, planning=replace(spec.settings.planning, moves=()))
    return replace(spec, task=load_task(path).program, scene=replace(spec.scene, others=()), settings=settings)


def test_the_worst_placed_object_is_that_of_the_trial():
    record = record_without_bench(of_cubes(y=-OFF_M))
    assert record.success
    errors = {
        phase.phase: phase.metrics["place_error_m"] for phase in record.phases if "place_error_m" in phase.metrics
    }
    assert max(error for phase, error in errors.items() if phase.startswith("red_cube")) == pytest.approx(
        OFF_M, abs=1e-4
    )
    assert max(error for phase, error in errors.items() if not phase.startswith("red_cube")) < 1e-4
    assert record.metrics["place_error_m"] == pytest.approx(OFF_M, abs=1e-4)


@pytest.mark.parametrize("before", ["", WAIT, LEAVE, LEAVE + WAIT], ids=["at once", "waits", "leaves", "leaves, waits"])
def test_the_hand_may_not_push_what_it_has_placed(tmp_path, before):
    record = record_without_bench(pushed(tmp_path, before + PUSH))
    assert (record.success, record.failure) == (False, Failure.OBJECT_COLLISION)
    assert record.failed_phase in ("slide", "aside")
    assert "moved the placed object by" in record.failure_detail


def test_a_hand_that_leaves_and_waits_pushes_nothing(tmp_path):
    record = record_without_bench(pushed(tmp_path, LEAVE + WAIT))
    assert record.success
    assert record.phases[-1].metrics["workpiece_displacement_m"] == 0.0


@pytest.mark.parametrize(
    ("shape", "turned_deg", "found_deg"),
    [
        (Box(size_m=(0.05, 0.04, 0.09)), 17.0, 17.0),
        (Box(size_m=(0.05, 0.04, 0.09)), -170.0, 10.0),
        (Box(size_m=(0.05, 0.05, 0.09)), 80.0, 10.0),
        (Box(size_m=(0.05, 0.05, 0.09)), 355.0, 5.0),
        (LyingCylinder(radius_m=0.02, length_m=0.09), 172.0, 8.0),
        (Cylinder(radius_m=0.02, height_m=0.09), 33.0, 0.0),
    ],
)
@pytest.mark.parametrize("tilt_deg", [0.0, 4.0])
def test_the_turn_of_a_placed_object_is_up_to_its_symmetry(spec_of, shape, turned_deg, found_deg, tilt_deg):
    scene = spec_of().scene
    limits = replace(scene.place, largest_turn_rad=math.radians(9.0), largest_tilt_rad=math.radians(5.0))
    scene = replace(scene, workpiece=replace(scene.workpiece, shape=shape), place=limits)
    yaw_rad = scene.task.place_yaw_rad - scene.task.grasp_yaw_rad + math.radians(turned_deg)
    turned = Rotation.from_euler("x", tilt_deg, degrees=True) * Rotation.from_euler("z", yaw_rad)
    x, y, z = scene.place.centre_m
    stands = Pose(position_m=(x, y, z + shape.half_height_m), quaternion_xyzw=tuple(turned.as_quat().tolist()))
    metrics, violation = check_place(SimpleNamespace(scene=scene, workpiece_pose=lambda: stands))
    assert metrics["place_turn_rad"] == pytest.approx(math.radians(found_deg), abs=1e-9)
    if found_deg <= 9.0:
        assert violation is None
    else:
        told = f"the object is turned by {found_deg:.1f} deg from its orientation at the place, more than 9 deg"
        assert violation == (Failure.NOT_IN_PLACE_REGION, told)


def test_a_cup_leaves_an_object_turned_that_it_saw_turned():
    """Nothing turns it back as pads do; the place of the file says how much is allowed."""
    project = load_project(REPOSITORY, "studies/lite6_cubes.yaml")
    spec = next(one for one in trial_specs(project, seeds=[1]) if one.gripper.suction is not None)
    turned = UncertainValue(quantity="perception.yaw", distribution=Constant(value=math.radians(7.0)))
    spec = replace(spec, uncertainty=Uncertainty(values=(turned,)))
    record = record_without_bench(spec)
    assert record.success
    assert record.metrics["place_turn_rad"] == pytest.approx(math.radians(7.0), abs=2e-3)
    strict = replace(spec.scene.place, largest_turn_rad=math.radians(5.0))
    record = record_without_bench(replace(spec, scene=replace(spec.scene, place=strict)))
    assert (record.failure, record.success) == (Failure.NOT_IN_PLACE_REGION, False)
    assert re.fullmatch(
        r"red_cube is turned by [67]\.\d deg from its orientation at the place, more than 5 deg",
        record.failure_detail,
    )


@pytest.mark.parametrize("rate_hz", [240.0, 1000.0])
def test_the_motion_of_the_tool_is_that_of_the_joints_at_any_step(rate_hz):
    """Where the arm is at the start of a move, and not where it should be: the limit of the cell is 2 m/s^2."""
    spec = of_cubes()
    settings = replace(spec.settings, physics=replace(spec.settings.physics, rate_hz=rate_hz))
    record = record_without_bench(replace(spec, fidelity=Fidelity.DYNAMIC, settings=settings))
    assert record.success
    assert record.metrics["peak_tool_acceleration_m_s2"] < 3.0


def test_the_torques_of_a_check_are_those_of_the_arm():
    contact, dynamic = (
        record_without_bench(replace(of_cubes(), fidelity=each)) for each in (Fidelity.CONTACT, Fidelity.DYNAMIC)
    )
    for name in ("peak_joint_torque_ratio", "most_loaded_joint", "fastest_joint", "governing_joint", "joint_work_j"):
        assert contact.metrics[name] == dynamic.metrics[name], name
    checks = [phase for phase in dynamic.phases if phase.phase.endswith(".placed")]
    assert checks
    assert all(phase.duration_s > 0.0 for phase in checks)
