"""The arm under computed torque: how closely it tracks, what it needs, and which joint gives way."""

from __future__ import annotations

import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity, PhaseOutcome
from rgss.kinematics import ArmDynamics, gripper_loads, workpiece_load
from rgss.physics import PhysicsSettings, TorqueArm
from rgss.tasks import default_task
from rgss.trials.executing import execute
from rgss.trials.planning import plan_task
from rgss.trials.plants.dynamic_plant import DynamicPlant
from rgss.trials.plants.joint_controller import JointController
from rgss.trials.record import assemble_record
from rgss.trials.reference import Reference, reference_of
from rgss.trials.timing import time_task
from rgss.trials.workcell import Workcell
from tests.fixtures.eight_states import Phase, step_of

pytestmark = pytest.mark.engine

MOVES = tuple(phase for phase in Phase if phase not in (Phase.GRASP, Phase.PLACE))
KNOWN = {
    "success",
    "phases_completed",
    "phases_total",
    "planning_time_s",
    "planning_checks",
    "path_length_m",
    "motion_time_s",
    "task_time_s",
    "attempt_time_s",
    "grasp_cycle_time_s",
    "peak_joint_speed_ratio",
    "fastest_joint",
    "peak_joint_utilisation",
    "governing_joint",
    "joint_work_j",
    "joint_net_work_j",
    "path_clearance_min_m",
    "manipulability_min_m3",
    "peak_tool_speed_m_s",
    "peak_tool_acceleration_m_s2",
    "tracking_error_m",
    "peak_joint_torque_ratio",
    "peak_joint_torque_n_m",
    "most_loaded_joint",
    "joint_saturated_s",
}


class Planned:
    """One trial's plan and timing, to be executed in several ways."""

    def __init__(self, spec):
        planning = spec.settings.planning
        self.spec = spec
        self.cell = Workcell(spec.scene, spec.gripper.geometry, clearance_m=planning.clearance_m, task=default_task())
        self.plan = plan_task(self.cell, spec.planner, seed=spec.seed, settings=planning)
        self.timing = time_task(self.cell, self.plan, tool_speed_m_s=spec.tool_speed_m_s, settings=planning)

    def with_(self, *, rate_hz=240.0, fidelity=Fidelity.DYNAMIC, torque_shares=None):
        """The trial at another rate or fidelity, or with weaker joints."""
        spec, robot = self.spec, self.spec.scene.robot
        shares = torque_shares or {}
        joints = tuple(
            replace(joint, torque_n_m=shares.get(joint.name, 1.0) * joint.torque_n_m) for joint in robot.joints
        )
        return replace(
            spec,
            fidelity=fidelity,
            scene=replace(spec.scene, robot=replace(robot, joints=joints)),
            settings=replace(spec.settings, physics=PhysicsSettings(rate_hz=rate_hz)),
        )

    def results(self, **changes):
        return execute(self.with_(**changes), self.cell, self.timing)

    def record(self, **changes):
        spec = self.with_(**changes)
        return assemble_record(spec, self.plan, self.timing.failures, execute(spec, self.cell, self.timing))


@pytest.fixture(scope="module")
def planned(spec_of):
    return Planned(spec_of(65))


@pytest.fixture(scope="module")
def dynamic(planned):
    return planned.record()


def still(configuration_rad, cell, steps):
    """A move that stays where it is."""
    positions = np.repeat(np.array(configuration_rad)[None, :], steps + 1, axis=0)
    return Reference(
        positions_rad=positions,
        velocities_rad_s=np.zeros((steps, 6)),
        tool_m=cell.arm.tool_position(positions),
        load_m_s2=np.full(steps, 9.81),
        arc_m=np.zeros((steps, 3)),
        peak_tool_speed_m_s=0.0,
        peak_tool_acceleration_m_s2=0.0,
    )


def plant_of(planned, machine, **options):
    spec = planned.spec
    settings = spec.settings
    return DynamicPlant(
        machine,
        planned.cell.arm,
        spec.scene,
        spec.gripper,
        settings.physics,
        settings.control,
        task=spec.task,
        **options,
    )


def machine_of(planned):
    spec = planned.spec
    return TorqueArm(spec.scene.robot, spec.gripper, spec.settings.physics, gravity_m_s2=spec.scene.gravity_m_s2)


@pytest.mark.parametrize("rate_hz", [240.0, 1000.0])
def test_the_tool_is_within_a_tenth_of_a_millimetre(planned, rate_hz):
    results = planned.results(rate_hz=rate_hz)
    assert [result.phase for result in results] == list(Phase)
    assert [result.failure for result in results] == [None] * 8
    errors = [result.metrics["tracking_error_m"] for result in results if result.phase in MOVES]
    assert 0.0 < max(errors) < 1e-4


def test_a_record_has_no_value_that_this_fidelity_cannot_know(dynamic):
    assert (dynamic.success, dynamic.fidelity) == (True, Fidelity.DYNAMIC)
    assert {name for name, value in dynamic.metrics.items() if value is not None} == KNOWN
    assert {name for phase in dynamic.phases for name in phase.metrics} == {
        "tracking_error_m",
        "peak_tool_speed_m_s",
        "peak_tool_acceleration_m_s2",
        "peak_joint_torque_n_m",
        "peak_joint_torque_ratio",
        "most_loaded_joint",
        "joint_saturated_s",
        "peak_joint_speed_ratio",
        "fastest_joint",
        "peak_joint_utilisation",
        "governing_joint",
        "joint_work_j",
        "joint_net_work_j",
        "path_clearance_min_m",
        "manipulability_min_m3",
        "opening_s",
    }


def test_the_fidelities_agree_on_time_and_success(planned, dynamic):
    kinematic, contact = (planned.record(fidelity=f) for f in (Fidelity.KINEMATIC, Fidelity.CONTACT))
    assert (kinematic.success, dynamic.success, contact.success) == (True, True, True)
    times = [record.metrics["task_time_s"] for record in (kinematic, dynamic, contact)]
    assert max(times) / min(times) < 1.01
    for name in ("planning_time_s", "planning_checks", "path_length_m", "phases_completed"):
        assert kinematic.metrics[name] == dynamic.metrics[name] == contact.metrics[name]
    step_s = planned.spec.settings.physics.step_s
    for phases in zip(kinematic.phases, dynamic.phases, contact.phases, strict=True):
        if phases[0].phase in MOVES:
            assert max(p.duration_s for p in phases) - min(p.duration_s for p in phases) < 6 * step_s


def test_the_speed_of_the_tool_is_the_one_that_the_arm_had(planned, dynamic):
    peaks = [phase.metrics["peak_tool_speed_m_s"] for phase in dynamic.phases if phase.phase in MOVES]
    physics, gravity = planned.spec.settings.physics, planned.spec.scene.gravity_m_s2
    commanded = [
        reference_of(planned.timing.trajectories[phase], planned.cell.arm, step_s=physics.step_s, gravity_m_s2=gravity)
        for phase in MOVES
    ]
    assert peaks == pytest.approx([reference.peak_tool_speed_m_s for reference in commanded], rel=1e-3)
    assert max(peaks) <= 1.01 * planned.spec.tool_speed_m_s


def test_torques_are_within_their_limits_and_no_joint_saturates(planned, dynamic):
    limits = np.array([joint.torque_n_m for joint in planned.spec.scene.robot.joints])
    for phase in dynamic.phases:
        peaks = np.array(phase.metrics["peak_joint_torque_n_m"])
        assert np.all(peaks > 0.0)
        assert phase.metrics["peak_joint_torque_ratio"] == pytest.approx(float(np.max(peaks / limits)))
        assert phase.metrics["joint_saturated_s"] == (0.0,) * 6
    assert 0.0 < dynamic.metrics["peak_joint_torque_ratio"] < 1.0


@pytest.mark.parametrize("joint", ["shoulder_lift_joint", "elbow_joint"])
def test_a_joint_that_is_too_weak_is_named(planned, dynamic, joint):
    names = [one.name for one in planned.spec.scene.robot.joints]
    index = names.index(joint)
    limit = planned.spec.scene.robot.joints[index].torque_n_m
    needed = max(phase.metrics["peak_joint_torque_n_m"][index] for phase in dynamic.phases)
    record = planned.record(torque_shares={joint: 0.7 * needed / limit})
    assert (record.success, record.failure) == (False, Failure.TRACKING_ERROR)
    found = re.fullmatch(
        r"the tool was (\d+\.\d\d) mm from its target; at its torque limit: (.+)", record.failure_detail
    )
    assert found is not None
    assert float(found[1]) > 2.0
    assert found[2].split(", then ")[0] == joint
    failed = next(phase for phase in record.phases if phase.outcome is PhaseOutcome.FAILED)
    assert record.failed_phase is failed.phase
    assert failed.metrics["joint_saturated_s"][index] > 0.0
    assert failed.metrics["peak_joint_torque_n_m"][index] == pytest.approx(0.7 * needed)
    assert failed.metrics["peak_joint_torque_ratio"] == pytest.approx(1.0)
    assert failed.metrics["tracking_error_m"] == pytest.approx(float(found[1]) * 1e-3, abs=1e-5)
    outcomes = [phase.outcome for phase in record.phases]
    assert outcomes[outcomes.index(PhaseOutcome.FAILED) + 1 :] == [PhaseOutcome.NOT_RUN] * (
        7 - outcomes.index(PhaseOutcome.FAILED)
    )


def test_a_tracking_error_without_saturation_names_no_joint(planned):
    spec = planned.with_()
    strict = replace(spec.settings.control, largest_tracking_error_m=1e-9)
    spec = replace(spec, settings=replace(spec.settings, control=strict))
    *_, last = execute(spec, planned.cell, planned.timing)
    assert (last.phase, last.failure) == (Phase.MOVE_TO_GRASP, Failure.TRACKING_ERROR)
    assert last.detail == "the tool was 0.00 mm from its target"


def test_an_end_that_is_not_reached_is_a_failure_after_half_a_second(planned):
    # The loop is so slow that the end is still out of reach when the wait is over.
    at = np.array(planned.spec.scene.robot.home_rad)
    jump = replace(still(at, planned.cell, 1), positions_rad=np.array([at, at + 0.05]))
    with machine_of(planned) as machine:
        plant = plant_of(planned, machine, controller=JointController(natural_frequency_rad_s=1.0))
        plant.start(at)
        result = plant.move(step_of(Phase.LIFT), jump)
    assert result.failure is Failure.TRACKING_ERROR
    assert result.duration_s == pytest.approx(0.5 + 1 / 240)


def test_the_object_weighs_on_the_joints_from_the_grasp_to_the_release(planned):
    spec, cell = planned.spec, planned.cell
    at = planned.timing.trajectories[Phase.LIFT].positions(np.zeros(1))[0]
    wait = still(at, cell, 24)
    with machine_of(planned) as machine:
        plant = plant_of(planned, machine)
        plant.start(at)
        before = plant.move(step_of(Phase.LIFT), wait)
        grasp = plant.grip(step_of(Phase.GRASP))
        carrying = plant.move(step_of(Phase.LIFT), wait)
        place = plant.release(step_of(Phase.PLACE))
        after = plant.move(step_of(Phase.LIFT), wait)
    rest, closed, opened = np.zeros(6), spec.scene.workpiece.shape.radius_m, spec.gripper.geometry.largest_opening_m
    held = workpiece_load(spec.scene.workpiece, spec.gripper.geometry.grasp_centre)

    def needed(*loads):
        model = ArmDynamics(spec.scene.robot, loads, gravity_m_s2=spec.scene.gravity_m_s2)
        return np.abs(model.torques(at, rest, rest))

    empty = needed(*gripper_loads(spec.gripper, opened))
    loaded = needed(*gripper_loads(spec.gripper, closed), held)
    assert np.max(np.abs(loaded - empty)) > 1.0

    def peaks(result):
        return np.array(result.metrics["peak_joint_torque_n_m"])

    for result in (before, grasp, place, after):
        assert peaks(result) == pytest.approx(empty, abs=0.05)
    assert peaks(carrying) == pytest.approx(loaded, abs=0.05)
    assert [result.failure for result in (before, carrying, after)] == [None] * 3


def test_the_hand_takes_the_time_of_the_fingers_travel(planned, dynamic):
    control, gripper = planned.spec.settings.control, planned.spec.gripper
    travel_s = (gripper.geometry.largest_opening_m - planned.spec.scene.workpiece.shape.radius_m) / 0.04
    grasp, place = (next(p for p in dynamic.phases if p.phase == phase) for phase in (Phase.GRASP, Phase.PLACE))
    assert grasp.duration_s == pytest.approx(travel_s + control.firm_grasp_s, abs=1 / 240 + 1e-9)
    assert place.metrics["opening_s"] == pytest.approx(travel_s)
    assert place.duration_s == pytest.approx(travel_s, abs=1 / 240 + 1e-9)


def test_results_at_both_rates_agree(planned, dynamic):
    fine = planned.record(rate_hz=1000.0)
    assert fine.success
    assert fine.metrics["task_time_s"] == pytest.approx(dynamic.metrics["task_time_s"], rel=0.01)
    for name in ("peak_tool_speed_m_s", "peak_joint_torque_ratio"):
        assert fine.metrics[name] == pytest.approx(dynamic.metrics[name], rel=0.02)


def test_the_same_trial_gives_the_same_bits(planned, dynamic):
    assert planned.record() == dynamic


def test_a_checkpoint_is_passed_before_every_step(planned):
    passed = []
    with machine_of(planned) as machine:
        plant = plant_of(planned, machine, checkpoint=lambda: passed.append(machine.state()))
        at = planned.spec.scene.robot.home_rad
        plant.start(at)
        plant.move(step_of(Phase.LIFT), still(at, planned.cell, 10))
    assert len(passed) == 10
    assert all(first[0] == pytest.approx(second[0], abs=1e-4) for first, second in pairwise(passed))
