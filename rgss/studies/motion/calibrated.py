"""Findings about the calibrated control of the joints, which needs a calibration of the robot."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.designs import DesignSpace, written_values
from rgss.documents import Document
from rgss.findings import Finding
from rgss.scenes import Calibration, Robot
from rgss.studies.motion.section import MotionChoice, joint_name_findings
from rgss.trials import ControlMode, is_stable

_Location = tuple["str | int", ...]
_MODE = "control.mode"


def motion_findings(
    motion: MotionChoice,
    rate_hz: float,
    document: Document,
    designs: DesignSpace,
    space: Document,
    robots: Sequence[Robot],
) -> Iterator[Finding]:
    """Find joints that the robot does not have, and what keeps the calibrated control from being run.

    Args:
        motion: The study's timing and control.
        rate_hz: Physics steps a second, in which the control is stable.
        document: The study's file, for positions.
        designs: The design space, whose parameters may choose the control.
        space: Its file, for positions.
        robots: The arms of the designs with their calibrations.
    """
    yield from joint_name_findings(motion, document, robots)
    chosen = calibrated_at(motion, document, designs, space)
    if chosen is None:
        return
    for robot in robots:
        yield from _calibration_findings(motion, rate_hz, chosen, robot)


def _calibration_findings(
    motion: MotionChoice, rate_hz: float, chosen: tuple[Document, _Location], robot: Robot
) -> Iterator[Finding]:
    """What keeps the calibrated control of one robot from being run."""
    where, place = chosen
    calibration = robot.calibration
    if calibration is None:
        message = f"the control is calibrated, and the file of robot {robot.id!r} names no calibration"
        hint = "fit one by 'rgss identify --calibration', and name it under 'calibration' in the robot's file"
        yield where.finding("study.no-calibration", message, place, hint=hint)
        return
    known = dict(calibration.servos)
    for joint in (joint.name for joint in robot.joints):
        if joint not in known:
            message = f"the control is calibrated, and the calibration has no servo of joint {joint!r}"
            yield where.finding("study.no-calibration", message, place, hint="record that joint too")
        elif not _is_stable(calibration, joint, motion, rate_hz):
            message = f"the calibrated control of joint {joint!r} is unstable at {rate_hz:g} Hz"
            hint = "lower control.position_gain: its command arrives late"
            yield where.finding("study.unstable-control", message, place, hint=hint)


def calibrated_at(
    motion: MotionChoice, document: Document, designs: DesignSpace, space: Document
) -> tuple[Document, _Location] | None:
    """The file and the place that choose calibrated control; None if nothing does.

    Args:
        motion: The study's control.
        document: The study's file.
        designs: The design space, whose parameters may choose the control.
        space: Its file.
    """
    setting = {parameter.id for parameter in designs.parameters if parameter.sets == _MODE}
    for place, name, value in written_values(designs):
        if name in setting and value == ControlMode.CALIBRATED.value:
            return space, place
    if not setting and motion.controller.mode is ControlMode.CALIBRATED:
        return document, ("control", "mode")
    return None


def _is_stable(calibration: Calibration, joint: str, motion: MotionChoice, rate_hz: float) -> bool:
    controller = motion.controller
    own = (gains.position_gain_1_s for gains in controller.joints if gains.joint == joint)
    gain = next((value for value in own if value is not None), controller.position_gain_1_s)
    servo = dict(calibration.servos)[joint]
    return is_stable(servo, control=calibration.control, position_gain_1_s=gain, step_s=1.0 / rate_hz)
