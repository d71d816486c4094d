"""Hints on the failures of a trial: what to change, and in which file."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.evidence import TrialRecord
    from rgss.scenes import Calibration
    from rgss.studies import Project
    from rgss.trials import JointController


def failure_hint(record: TrialRecord, project: Project, controller: JointController) -> str:
    """Remedy of a failure, with the files; empty for failures whose detail says it.

    Args:
        record: The record of a trial that failed.
        project: The project.
        controller: The controller of the joints in the move that failed.
    """
    from rgss.evidence import Failure
    from rgss.trials import ControlMode

    study = project.study
    if record.failure is Failure.PLANNING_LIMIT:
        task = project.scene.task
        is_yaw_stated = task.candidates is None and not task.is_yaw_free
        turned = "turn the hand ('grasp_yaw', 'place_yaw') or " if is_yaw_stated else ""
        return (
            f"give the planner more time (what sets planning.time_limit in {study.design_space}), try another planner "
            f"there, lower planning.clearance in {study.label}, or {turned}move bodies apart in {study.scene}"
        )
    if record.failure is Failure.OBJECT_DROPPED and " tilted by " in record.failure_detail:
        return (
            "the weight turns the object about the line between the pads, which the grip margin does not contain (rgss "
            f"check does: scene.grip-load); grip it nearer to its centre of mass, in {study.scene}, or with more force "
            f"or friction (what sets gripper.finger.force and gripper.finger.friction in {study.design_space})"
        )
    if record.failure is Failure.TRACKING_ERROR:
        if "torque limit" in record.failure_detail:
            return (
                f"lower the tool's speed (what sets robot.tool_speed in {study.design_space}) or the joints' "
                "accelerations in the robot's file; check the joints' torques there and the masses with rgss robot FILE"
            )
        if "after the move" in record.failure_detail:
            if controller.mode is ControlMode.CALIBRATED and controller.calibration is not None:
                return _settling_hint(controller, controller.calibration, record.failure_detail, study.label)
            return (
                f"state a larger control.position_tolerance or control.settling_limit in {study.label}, or stiffer "
                "gains there; an object heavier than the controller's model leaves such an error"
            )
        return (
            f"raise physics.solver_iterations or physics.rate in {study.label}, lower the tool's speed (what sets "
            f"robot.tool_speed in {study.design_space}), or state a larger control.tracking_limit in {study.label}"
        )
    return ""


def _settling_hint(controller: JointController, calibration: Calibration, detail: str, label: str) -> str:
    """Hint where a joint of calibrated servos, whose gains are fitted, ends a move outside the tolerance.

    A joint at rest under position control begins to move where k_p e exceeds its Coulomb friction c, one under velocity
    control where k_v k e does.
    """
    from rgss.scenes import ServoControl

    joint, hint = detail.split(" was ", 1)[0], f"state a larger control.position_tolerance in {label}"
    servo = dict(calibration.servos)[joint]
    stiffness, remedy = servo.position_gain_hz2, ""
    if calibration.control is ServoControl.VELOCITY:
        own = next((gains.position_gain_1_s for gains in controller.joints if gains.joint == joint), None)
        stiffness = servo.velocity_gain_hz * (controller.position_gain_1_s if own is None else own)
        remedy = ", or a larger control.position_gain"
    if servo.coulomb_rad_s2 == 0.0 or stiffness == 0.0:
        return f"{hint}{remedy}, or a larger control.settling_limit; the servos' own gains are those of the calibration"
    unit = "m" if " m from its target" in detail else "rad"
    return (
        f"{hint}{remedy}: by the calibration, static friction holds {joint} up to "
        f"{servo.coulomb_rad_s2 / stiffness:.2g} {unit} from its target, and the servos' own gains are fixed"
    )
