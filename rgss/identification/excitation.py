"""Excitation as data: step and sine speeds of each joint, one joint at a time, at several poses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.counted import counted
from rgss.documents import Document, JointQuantity, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding
from rgss.identification.excitation_document import ExcitationDocument
from rgss.scenes import JointKind, Robot

Array = NDArray[np.float64]
_LEAST_PER_CYCLE = 20
_MOST_RATE_HZ = 10_000.0


@dataclass(frozen=True, slots=True, kw_only=True)
class Signal:
    """A commanded course of one joint.

    Attributes:
        name: Its name.
        velocities_rad_s: Commanded speed of each sample, shape (times,); in m/s for a joint that slides.
        positions_rad: Commanded position relative to the pose, shape (times,); in m for a joint that slides.
    """

    name: str
    velocities_rad_s: Array
    positions_rad: Array


def load_excitation(path: Path, robot: Robot) -> ExcitationDocument:
    """Read an excitation file and check it against a robot.

    Raises:
        DocumentError: The file is wrong, or exceeds the robot's limits; with every problem in it.
    """
    loaded = load_document(path, ExcitationDocument)
    findings = [*_number_findings(loaded.value, loaded.document)]
    if not findings:
        findings = [*_robot_findings(loaded.value, loaded.document, robot)]
    if findings:
        raise DocumentError(sorted(findings))
    return loaded.value


def signals(excitation: ExcitationDocument, kind: JointKind = JointKind.REVOLUTE) -> Iterator[Signal]:
    """The signals of an excitation for a kind of joint; each begins and ends with the time of rest.

    Args:
        excitation: The excitation.
        kind: Joints that turn have the signals in rad/s, joints that slide those in m/s.
    """
    slides = kind is JointKind.PRISMATIC
    unit = "m/s" if slides else "rad/s"
    if excitation.steps is not None:
        held = math.ceil(excitation.steps.hold * excitation.rate - 1e-9)
        for speed in _of_kind(excitation.steps.speeds, slides=slides):
            course = np.concatenate([np.full(held, speed), np.full(held, -speed)])
            yield _signal(excitation, f"step {speed:.6g} {unit}", course)
    if excitation.sines is not None:
        for amplitude in _of_kind(excitation.sines.amplitudes, slides=slides):
            for frequency in excitation.sines.frequencies:
                count = math.ceil(excitation.sines.cycles / frequency * excitation.rate - 1e-9)
                course = amplitude * np.sin(2 * np.pi * frequency * np.arange(count) / excitation.rate)
                yield _signal(excitation, f"sine {amplitude:.6g} {unit} {frequency:.6g} Hz", course)


def chosen_joints(excitation: ExcitationDocument, robot: Robot) -> tuple[str, ...]:
    """Names of the joints that are excited."""
    return excitation.joints or tuple(joint.name for joint in robot.joints)


def _of_kind(speeds: Sequence[JointQuantity], *, slides: bool) -> Iterator[float]:
    yield from (speed.value for speed in speeds if speed.is_linear == slides)


def _signal(excitation: ExcitationDocument, name: str, course: Array) -> Signal:
    rest = np.zeros(math.ceil(excitation.rest * excitation.rate - 1e-9))
    velocities = np.concatenate([rest, course, rest])
    positions = np.concatenate([[0.0], np.cumsum(velocities[:-1])]) / excitation.rate
    return Signal(name=name, velocities_rad_s=velocities, positions_rad=positions)


def _number_findings(entry: ExcitationDocument, document: Document) -> Iterator[Finding]:
    numbers: list[tuple[tuple[str | int, ...], float]] = [(("rate",), entry.rate), (("rest",), entry.rest)]
    if entry.steps is not None:
        numbers += [(("steps", "speeds", index), speed) for index, speed in enumerate(_values(entry.steps.speeds))]
        numbers.append((("steps", "hold"), entry.steps.hold))
    if entry.sines is not None:
        numbers += [
            (("sines", "amplitudes", index), each) for index, each in enumerate(_values(entry.sines.amplitudes))
        ]
        numbers += [(("sines", "frequencies", index), each) for index, each in enumerate(entry.sines.frequencies)]
    for place, value in numbers:
        if value <= 0.0:
            yield document.finding(
                "excitation.range",
                f"{place[-2] if len(place) > 2 else place[-1]} must be positive, got {value:g}",
                place,
            )
    if entry.rate > _MOST_RATE_HZ:
        yield document.finding("excitation.range", f"rate must be at most {_MOST_RATE_HZ:g} Hz", ("rate",))
    if entry.steps is None and entry.sines is None:
        yield document.finding("excitation.range", "the excitation has neither steps nor sines", ("excitation",))
    for index, each in enumerate(entry.sines.frequencies if entry.sines is not None else ()):
        if each * _LEAST_PER_CYCLE > entry.rate:
            problem = f"a sine of {each:g} Hz has fewer than {_LEAST_PER_CYCLE} samples a cycle"
            yield document.finding("excitation.range", problem, ("sines", "frequencies", index))
    for key in ("position", "velocity", "slide_position", "slide_velocity"):
        if getattr(entry.noise, key) < 0.0:
            yield document.finding("excitation.range", f"{key} must not be negative", ("noise", key))


def _values(quantities: Sequence[JointQuantity]) -> Iterator[float]:
    yield from (quantity.value for quantity in quantities)


def _robot_findings(entry: ExcitationDocument, document: Document, robot: Robot) -> Iterator[Finding]:
    names = [joint.name for joint in robot.joints]
    for index, name in enumerate(entry.joints or ()):
        if name not in names:
            hint = f"the robot has {', '.join(names)}"
            yield document.finding("excitation.joint", f"unknown joint {name!r}", ("joints", index), hint=hint)
    yield from _kind_findings(entry, document, robot)
    for pose, configuration in entry.poses.items():
        if len(configuration) != len(names):
            problem = (
                f"the pose has {counted(len(configuration), 'position')}, the robot {counted(len(names), 'joint')}"
            )
            yield document.finding("excitation.pose", problem, ("poses", pose))
            continue
        wrong = [
            index
            for index, (position, joint) in enumerate(zip(configuration, robot.joints, strict=True))
            if position.is_linear != (joint.kind is JointKind.PRISMATIC)
        ]
        for index in wrong:
            joint, needed = robot.joints[index], "deg" if configuration[index].is_linear else "mm"
            problem = f"joint {joint.name!r} is {joint.kind.value}, so its position is in {needed}"
            yield document.finding("excitation.unit", problem, ("poses", pose, index))
        if not wrong:
            yield from _limit_findings(entry, document, robot, pose)


def _kind_findings(entry: ExcitationDocument, document: Document, robot: Robot) -> Iterator[Finding]:
    """Findings about excited joints of a kind without a signal."""
    for joint in robot.joints:
        if joint.name in chosen_joints(entry, robot) and not any(signals(entry, joint.kind)):
            unit = "m/s" if joint.kind is JointKind.PRISMATIC else "rad/s"
            problem = f"there is no signal for joint {joint.name!r}, which is {joint.kind.value}"
            hint = f"add a speed in {unit}, or leave the joint out of joints"
            place = ("excitation",) if entry.joints is None else ("joints", entry.joints.index(joint.name))
            yield document.finding("excitation.signal", problem, place, hint=hint)


def _limit_findings(entry: ExcitationDocument, document: Document, robot: Robot, pose: str) -> Iterator[Finding]:
    positions = _values(entry.poses[pose])
    at: Mapping[str, float] = dict(zip([each.name for each in robot.joints], positions, strict=True))
    chosen: Sequence[str] = chosen_joints(entry, robot)
    for joint in (each for each in robot.joints if each.name in chosen):
        scale, unit = (1e3, "mm") if joint.kind is JointKind.PRISMATIC else (math.degrees(1.0), "deg")
        for course in signals(entry, joint.kind):
            reached = at[joint.name] + course.positions_rad
            if reached.min() < joint.lower_rad or reached.max() > joint.upper_rad:
                span = f"from {scale * reached.min():.4g} to {scale * reached.max():.4g} {unit}"
                problem = f"{course.name} moves joint {joint.name!r} {span}, beyond its range"
            elif np.abs(course.velocities_rad_s).max() > joint.speed_rad_s:
                problem = f"{course.name} exceeds the speed limit of joint {joint.name!r}"
            else:
                continue
            yield document.finding("excitation.limit", problem, ("poses", pose))
            break
