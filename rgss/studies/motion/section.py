"""Timing of moves and control of the joints: the sections ``timing`` and ``control`` of a study."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from pydantic import Field

from rgss.documents import (
    Dimensionless,
    Document,
    DocumentModel,
    Metres,
    Radians,
    RadiansPerSecond,
    RadiansPerSecondSquared,
    Seconds,
    Text,
)
from rgss.findings import Finding, shown
from rgss.scenes import Robot
from rgss.trials import (
    ControlMode,
    ControlSettings,
    JointController,
    JointGains,
    TimingProfile,
    TimingSettings,
    least_stable_rate_hz,
)

_CONTROLLER = JointController()
_ANY_JOINT = ""


class TimingEntry(DocumentModel):
    """Timing of moves."""

    profile: Literal["time_optimal", "trapezoid", "joint_waypoints"] = "time_optimal"
    peak_speed: Dimensionless = 1.0
    peak_acceleration: Dimensionless = 1.0
    joint_speeds: dict[Text, RadiansPerSecond] = Field(default_factory=dict)
    joint_accelerations: dict[Text, RadiansPerSecondSquared] = Field(default_factory=dict)


class GainsEntry(DocumentModel):
    """Gains of one joint."""

    natural_frequency: RadiansPerSecond | None = None
    damping_ratio: Dimensionless | None = None
    position_gain: RadiansPerSecond | None = None
    velocity_gain: RadiansPerSecond | None = None


class ControlEntry(DocumentModel):
    """Control of the joints."""

    mode: Literal["position", "velocity", "computed_torque", "calibrated", "tool_tracking"] = "computed_torque"
    natural_frequency: RadiansPerSecond = _CONTROLLER.natural_frequency_rad_s
    damping_ratio: Dimensionless = _CONTROLLER.damping_ratio
    position_gain: RadiansPerSecond = _CONTROLLER.position_gain_1_s
    velocity_gain: RadiansPerSecond = _CONTROLLER.velocity_gain_1_s
    joints: dict[Text, GainsEntry] = Field(default_factory=dict)
    position_tolerance: Radians = _CONTROLLER.reached_rad
    settling_limit: Seconds = _CONTROLLER.settling_limit_s
    in_contact: bool = False
    tracking_limit: Metres = ControlSettings().largest_tracking_error_m


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionChoice:
    """Timing of moves and control of joints.

    Attributes:
        timing: Profile and limits of the timing.
        controller: Mode, gains and tolerance of the control of the joints.
        thresholds: Thresholds of the task program.
    """

    timing: TimingSettings = field(default_factory=TimingSettings)
    controller: JointController = field(default_factory=JointController)
    thresholds: ControlSettings = field(default_factory=ControlSettings)


def read_motion(
    timing: TimingEntry, control: ControlEntry, document: Document, findings: list[Finding], *, rate_hz: float
) -> MotionChoice:
    """Timing of moves and control of joints.

    Args:
        timing: The section ``timing``.
        control: The section ``control``.
        document: The file, for positions.
        findings: Collects the problems.
        rate_hz: Physics steps a second, in which the control is stable.
    """
    found = [*_timing_findings(timing, document), *_control_findings(control, document)]
    findings.extend(found)
    choice = MotionChoice(
        timing=TimingSettings(
            profile=TimingProfile(timing.profile),
            peak_speed=timing.peak_speed,
            peak_acceleration=timing.peak_acceleration,
            joint_speeds_rad_s=tuple(sorted(timing.joint_speeds.items())),
            joint_accelerations_rad_s2=tuple(sorted(timing.joint_accelerations.items())),
        ),
        controller=JointController(
            mode=ControlMode(control.mode),
            natural_frequency_rad_s=control.natural_frequency,
            damping_ratio=control.damping_ratio,
            position_gain_1_s=control.position_gain,
            velocity_gain_1_s=control.velocity_gain,
            joints=tuple(_gains_of(name, gains) for name, gains in sorted(control.joints.items())),
            reached_rad=control.position_tolerance,
            settling_limit_s=control.settling_limit,
            in_contact=control.in_contact,
        ),
        thresholds=replace(ControlSettings(), largest_tracking_error_m=control.tracking_limit),
    )
    if not found and rate_hz > 0.0 and choice.controller.mode is not ControlMode.CALIBRATED:
        findings.extend(_stability_findings(choice.controller, document, rate_hz))
    return choice


def joint_name_findings(study: MotionChoice, document: Document, robots: Sequence[Robot]) -> Iterator[Finding]:
    """Find joints that the study names and no robot has.

    Args:
        study: The study's timing and control.
        document: The study's file, for positions.
        robots: The arms of the designs.
    """
    known = list(dict.fromkeys(joint.name for robot in robots for joint in robot.joints))
    named = (
        *((("timing", "joint_speeds", name), name) for name, _ in study.timing.joint_speeds_rad_s),
        *((("timing", "joint_accelerations", name), name) for name, _ in study.timing.joint_accelerations_rad_s2),
        *((("control", "joints", gains.joint), gains.joint) for gains in study.controller.joints),
    )
    for place, name in named:
        if name not in known:
            message = f"{'the robot has no' if len(robots) == 1 else 'no robot has a'} joint {shown(name)}"
            yield document.finding("study.joint", message, place, hint=f"joints: {', '.join(known)}")


def _gains_of(joint: str, entry: GainsEntry) -> JointGains:
    return JointGains(
        joint=joint,
        natural_frequency_rad_s=entry.natural_frequency,
        damping_ratio=entry.damping_ratio,
        position_gain_1_s=entry.position_gain,
        velocity_gain_1_s=entry.velocity_gain,
    )


def _timing_findings(timing: TimingEntry, document: Document) -> Iterator[Finding]:
    for key, share in (("peak_speed", timing.peak_speed), ("peak_acceleration", timing.peak_acceleration)):
        if not 0.0 < share <= 1.0:
            message = f"{key} must be a share of the joints' limits above 0 and at most 1, got {share:g}"
            yield document.finding("study.share", message, ("timing", key), hint="give one such as 80 %")
    for key, values in (("joint_speeds", timing.joint_speeds), ("joint_accelerations", timing.joint_accelerations)):
        for name, value in values.items():
            if value <= 0.0:
                yield _not_positive(document, ("timing", key, name))


def _control_findings(control: ControlEntry, document: Document) -> Iterator[Finding]:
    for key in (
        "natural_frequency",
        "damping_ratio",
        "velocity_gain",
        "position_tolerance",
        "settling_limit",
        "tracking_limit",
    ):
        if getattr(control, key) <= 0.0:
            yield _not_positive(document, ("control", key))
    if control.position_gain < 0.0:
        yield _negative(document, ("control", "position_gain"))
    for name, gains in control.joints.items():
        for key in ("natural_frequency", "damping_ratio", "velocity_gain"):
            value = getattr(gains, key)
            if value is not None and value <= 0.0:
                yield _not_positive(document, ("control", "joints", name, key))
        if gains.position_gain is not None and gains.position_gain < 0.0:
            yield _negative(document, ("control", "joints", name, "position_gain"))


def _stability_findings(controller: JointController, document: Document, rate_hz: float) -> Iterator[Finding]:
    """Gains with which the error grows from step to step."""
    for name in (_ANY_JOINT, *(gains.joint for gains in controller.joints)):
        least_hz = least_stable_rate_hz(controller, [name])
        if rate_hz <= least_hz:
            place = ("control", "joints", name) if name else ("control",)
            message = f"the control is unstable at {rate_hz:g} Hz: its gains need more than {least_hz:.4g} Hz"
            yield document.finding("study.unstable-control", message, place, hint="lower the gains, or raise the rate")


def _not_positive(document: Document, place: tuple[str, ...]) -> Finding:
    return document.finding("study.not-positive", f"{place[-1]} must be greater than zero", place)


def _negative(document: Document, place: tuple[str, ...]) -> Finding:
    return document.finding("study.negative", f"{place[-1]} must not be negative", place)
