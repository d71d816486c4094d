"""Contact physics along the motion that the joints make under their control."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from rgss.evidence import Failure, Fidelity
from rgss.trials.controlled_motion import ControlledMotion
from rgss.trials.phase_result import PhaseResult
from rgss.trials.pieces.run import run_trial
from rgss.trials.plants import ControlMode, JointController
from tests.fixtures.shared_trials import record_without_bench

ARM = ("peak_joint_torque_ratio", "peak_joint_speed_ratio", "tracking_error_m")


def controlled(spec, fidelity=Fidelity.CONTACT, **controller):
    settings = replace(spec.settings, controller=JointController(in_contact=True, **controller))
    return replace(spec, fidelity=fidelity, settings=settings)


@pytest.mark.engine
@pytest.mark.parametrize("omega", [15.0, 40.0])
def test_what_the_arm_does_is_that_of_its_dynamics_and_the_object_is_carried(spec_of, omega):
    control = {"mode": ControlMode.POSITION, "natural_frequency_rad_s": omega}
    spec = spec_of()
    loose = replace(spec.settings.control, largest_tracking_error_m=0.1)
    spec = replace(spec, settings=replace(spec.settings, control=loose))
    contact = record_without_bench(controlled(spec, **control))
    dynamic = record_without_bench(controlled(spec, Fidelity.DYNAMIC, **control))

    assert contact.success
    assert contact.metrics["slip_m"] < 1e-3
    for ours, its in zip(contact.phases, dynamic.phases, strict=True):
        assert [ours.metrics.get(name) for name in ARM] == [its.metrics.get(name) for name in ARM]
        if ours.phase not in ("grasp", "place"):
            assert ours.duration_s == pytest.approx(its.duration_s, abs=1e-9)


@pytest.mark.engine
def test_an_arm_that_does_not_follow_fails_in_contact_too(spec_of):
    record = record_without_bench(controlled(spec_of(), mode=ControlMode.POSITION, natural_frequency_rad_s=5.0))

    assert (record.failure, record.failed_phase) == (Failure.TRACKING_ERROR, "move_to_grasp")
    # It is seen: contact physics runs the motion that failed too.
    (failed,) = (phase for phase in record.phases if phase.phase == "move_to_grasp")
    assert failed.metrics["workpiece_position_m"] is not None
    dynamic = record_without_bench(
        controlled(spec_of(), Fidelity.DYNAMIC, mode=ControlMode.POSITION, natural_frequency_rad_s=5.0)
    )
    assert record.failure_detail.startswith(dynamic.failure_detail)


@pytest.mark.engine
def test_without_it_contact_physics_has_its_own_servo(spec_of):
    spec = spec_of()
    soft = replace(spec, settings=replace(spec.settings, controller=JointController(mode=ControlMode.POSITION)))
    assert run_trial(soft) == run_trial(spec)  # with no piece in common


def result(phase, failure=None, **metrics):
    return PhaseResult(phase=phase, failure=failure, detail="why" if failure else "", duration_s=1.0, metrics=metrics)


def motion_of(*results):
    return ControlledMotion(references={}, results={one.phase: one for one in results})


def test_a_failure_in_contact_comes_before_one_of_the_arm_in_a_later_phase():
    motion = motion_of(result("a", tracking_error_m=2.0), result("b", Failure.TRACKING_ERROR))
    (joined,) = motion.joined((result("a", Failure.OBJECT_DROPPED, slip_m=1.0),))

    assert (joined.failure, dict(joined.metrics)) == (
        Failure.OBJECT_DROPPED,
        {"slip_m": 1.0, "tracking_error_m": 2.0},
    )


def test_what_happens_in_contact_where_the_arm_fails_is_told_as_a_consequence():
    motion = motion_of(result("a", Failure.TRACKING_ERROR))
    contact = replace(result("a", Failure.OBJECT_COLLISION), detail="finger_0 pressed the object")
    (joined,) = motion.joined((contact,))

    assert (joined.failure, joined.detail) == (Failure.TRACKING_ERROR, "why; in contact finger_0 pressed the object")


def test_a_failure_of_the_arm_ends_the_task_where_it_happens():
    motion = motion_of(result("a"), result("b", Failure.TRACKING_ERROR))
    first, last = motion.joined((result("a"),))

    assert (first.failure, last.phase, last.failure) == (None, "b", Failure.TRACKING_ERROR)


def test_a_failure_of_the_arm_in_a_phase_that_contact_completes_counts():
    motion = motion_of(result("a", Failure.NO_FIRM_GRASP))
    (joined,) = motion.joined((result("a"),))

    assert (joined.failure, joined.detail) == (Failure.NO_FIRM_GRASP, "why")


def test_a_task_that_completes_is_joined_phase_by_phase():
    motion = motion_of(result("a", tracking_error_m=1.0), result("b"))
    joined = motion.joined((result("a"), result("b", slip_m=1.0)))

    assert [dict(one.metrics) for one in joined] == [{"tracking_error_m": 1.0}, {"slip_m": 1.0}]
    assert np.all([one.failure is None for one in joined])
