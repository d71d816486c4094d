"""Hints on failures name what to change and the file."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import pytest

from rgss.cli.failure_hints import failure_hint
from rgss.cli.verbs.run import _controller_of
from rgss.evidence import Failure
from rgss.scenes import Calibration, JointServo, ServoControl
from rgss.tasks import StepControl
from rgss.trials import ControlMode, JointController

PROJECT = SimpleNamespace(
    study=SimpleNamespace(label="studies/a.yaml", design_space="designs/b.yaml", scene="scenes/c.yaml"),
    scene=SimpleNamespace(task=SimpleNamespace(candidates=None, is_yaw_free=False)),
)


@pytest.mark.parametrize(
    ("failure", "detail", "parts"),
    [
        (Failure.PLANNING_LIMIT, "", ("planning.time_limit in designs/b.yaml", "apart in scenes/c.yaml")),
        (
            Failure.TRACKING_ERROR,
            "the tool was 4 mm from its target; at its torque limit: elbow",
            ("robot.tool_speed in designs/b.yaml", "torques there and the masses with rgss robot FILE"),
        ),
        (
            Failure.OBJECT_DROPPED,
            "box tilted by 54 deg in the gripper, more than the 45 deg of the task",
            ("which the grip margin does not contain", "centre of mass, in scenes/c.yaml", "force and gripper.finger"),
        ),
        (
            Failure.TRACKING_ERROR,
            "the tool was 2.1 mm from its target",
            ("physics.solver_iterations or physics.rate in studies/a.yaml", "control.tracking_limit in studies/a.yaml"),
        ),
    ],
)
def test_a_failure_has_a_hint_with_the_file(failure, detail, parts):
    hint = failure_hint(SimpleNamespace(failure=failure, failure_detail=detail), PROJECT, JointController())

    assert all(part in hint for part in parts)


@pytest.mark.parametrize(
    ("candidates", "is_yaw_free", "named"), [(None, False, True), (None, True, False), (("a",), False, False)]
)
def test_a_planner_out_of_time_may_have_a_path_to_another_yaw_where_it_is_stated(candidates, is_yaw_free, named):
    scene = SimpleNamespace(task=SimpleNamespace(candidates=candidates, is_yaw_free=is_yaw_free))
    failed = SimpleNamespace(failure=Failure.PLANNING_LIMIT, failure_detail="")
    hint = failure_hint(failed, SimpleNamespace(study=PROJECT.study, scene=scene), JointController())
    assert ("turn the hand ('grasp_yaw', 'place_yaw')" in hint) is named


def test_other_failures_have_none():
    assert (
        failure_hint(SimpleNamespace(failure=Failure.OBJECT_DROPPED, failure_detail=""), PROJECT, JointController())
        == ""
    )


LATE = "elbow was 0.0069 rad from its target 0.5 s after the move, at most 0.001 are allowed"
SERVO = JointServo(velocity_gain_hz=30.0, position_gain_hz2=200.0, coulomb_rad_s2=1.38)


def calibrated(servo, *, control):
    calibration = Calibration(robot="arm", control=control, servos=(("elbow", servo),))
    return JointController(mode=ControlMode.CALIBRATED, position_gain_1_s=5.0, calibration=calibration)


def late_hint(controller, detail=LATE):
    return failure_hint(SimpleNamespace(failure=Failure.TRACKING_ERROR, failure_detail=detail), PROJECT, controller)


def test_static_friction_of_calibrated_servos_is_named_with_the_error_that_it_leaves():
    assert "stiffer gains" in late_hint(JointController())
    # c / k_p under position control, c / (k_v k) under velocity control.
    assert late_hint(calibrated(SERVO, control=ServoControl.POSITION)) == (
        "state a larger control.position_tolerance in studies/a.yaml: by the calibration, static friction holds elbow "
        "up to 0.0069 rad from its target, and the servos' own gains are fixed"
    )
    assert late_hint(calibrated(SERVO, control=ServoControl.VELOCITY)) == (
        "state a larger control.position_tolerance in studies/a.yaml, or a larger control.position_gain: by the "
        "calibration, static friction holds elbow up to 0.0092 rad from its target, and the servos' own gains are fixed"
    )
    assert "0.0069 m from its" in late_hint(
        calibrated(SERVO, control=ServoControl.POSITION), LATE.replace("rad from", "m from")
    )


def test_calibrated_servos_without_friction_need_time():
    free = replace(SERVO, coulomb_rad_s2=0.0)

    assert late_hint(calibrated(free, control=ServoControl.POSITION)) == (
        "state a larger control.position_tolerance in studies/a.yaml, or a larger control.settling_limit; the servos' "
        "own gains are those of the calibration"
    )


def test_the_control_of_the_step_that_failed_counts():
    controller = calibrated(SERVO, control=ServoControl.POSITION)
    steps = (SimpleNamespace(name="a", control=None), SimpleNamespace(name="b", control=StepControl(mode="velocity")))
    spec = SimpleNamespace(settings=SimpleNamespace(controller=controller), task=SimpleNamespace(steps=steps))

    assert _controller_of(spec, "a") is controller
    assert "stiffer gains" in late_hint(_controller_of(spec, "b"))
