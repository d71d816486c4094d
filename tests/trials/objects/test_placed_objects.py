"""What is placed: each object counts, and the robot may not move it again."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rgss.evidence import Failure, Fidelity
from rgss.scenes.uncertainty import Constant, Uncertainty, UncertainValue
from rgss.studies.expansion import trial_specs
from rgss.studies.project import load_project
from rgss.tasks import load_task
from rgss.trials.pieces.run import run_trial
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
    record = run_trial(of_cubes(y=-OFF_M))
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
    record = run_trial(pushed(tmp_path, before + PUSH))
    assert (record.success, record.failure) == (False, Failure.OBJECT_COLLISION)
    assert record.failed_phase in ("slide", "aside")
    assert "moved the placed object by" in record.failure_detail


def test_a_hand_that_leaves_and_waits_pushes_nothing(tmp_path):
    record = run_trial(pushed(tmp_path, LEAVE + WAIT))
    assert record.success
    assert record.phases[-1].metrics["workpiece_displacement_m"] == 0.0


@pytest.mark.parametrize("rate_hz", [240.0, 1000.0])
def test_the_motion_of_the_tool_is_that_of_the_joints_at_any_step(rate_hz):
    """Where the arm is at the start of a move, and not where it should be: the limit of the cell is 2 m/s^2."""
    spec = of_cubes()
    settings = replace(spec.settings, physics=replace(spec.settings.physics, rate_hz=rate_hz))
    record = run_trial(replace(spec, fidelity=Fidelity.DYNAMIC, settings=settings))
    assert record.success
    assert record.metrics["peak_tool_acceleration_m_s2"] < 3.0


def test_the_torques_of_a_check_are_those_of_the_arm():
    contact, dynamic = (run_trial(replace(of_cubes(), fidelity=each)) for each in (Fidelity.CONTACT, Fidelity.DYNAMIC))
    for name in ("peak_joint_torque_ratio", "most_loaded_joint", "fastest_joint", "governing_joint", "joint_work_j"):
        assert contact.metrics[name] == dynamic.metrics[name], name
    checks = [phase for phase in dynamic.phases if phase.phase.endswith(".placed")]
    assert checks
    assert all(phase.duration_s > 0.0 for phase in checks)
