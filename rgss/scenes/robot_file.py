"""Reader of robot files and their URDFs."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from rgss.documents import Document, load_document
from rgss.errors import DocumentError
from rgss.findings import Finding, shown
from rgss.scenes.document import RobotDocument
from rgss.scenes.findings import Location, named_file_findings, not_positive, too_slow
from rgss.scenes.frames import ROBOT, NamedFrame, frames_of
from rgss.scenes.joint_units import home_findings, unit_findings
from rgss.scenes.joints import DriverLimits, Joint, JointKind
from rgss.scenes.pose import Pose
from rgss.scenes.robot import Robot
from rgss.scenes.servos import Calibration, load_calibration
from rgss.scenes.urdf_file import ReadUrdf, read_urdf


def load_robot(path: Path, *, base: Pose, label: str | None = None, project: Path | None = None) -> Robot:
    """Read a robot file and the URDF that it names.

    Args:
        path: The robot file.
        base: Transform of the arm's base frame to the world.
        label: The file's name in messages.
        project: The folder that must contain all referenced files; that of the robot file by default.

    Raises:
        DocumentError: The file or its URDF is invalid; with every problem in it.
    """
    loaded = load_document(path, RobotDocument, label=label)
    entry, document = loaded.value, loaded.document
    findings = [*_empty_ranges(entry, document), *_repeated_joints(entry, document)]
    findings.extend(
        not_positive(
            document,
            (
                (("joints", index, key), value)
                for index, joint in enumerate(entry.joints)
                for key, value in (
                    ("speed", joint.speed.value),
                    ("acceleration", joint.acceleration.value),
                    ("torque", joint.torque.value),
                )
            ),
        )
    )
    findings.extend(
        not_positive(document, [(("payload",), entry.payload), (("tool_acceleration",), entry.tool_acceleration)])
    )
    if entry.tool_speed is not None:
        speed: list[tuple[Location, float]] = [(("tool_speed",), entry.tool_speed)]
        findings.extend((*not_positive(document, speed), *too_slow(document, speed)))
    findings.extend(home_findings(entry, document))
    top = path.parent if project is None else project
    problems = list(named_file_findings(document, entry.description, ("description",), folder=path.parent, project=top))
    urdf = ReadUrdf() if problems else read_urdf(path.parent / entry.description, document, entry, project=top)
    findings.extend((*problems, *urdf.findings))
    if not problems and not urdf.findings:
        findings.extend(unit_findings(entry, document, urdf.kinds))
        findings.extend(_follower_findings(entry, document, urdf))
    base_frame = {ROBOT: NamedFrame(id=ROBOT, pose=Pose())}
    frames = frames_of(entry.frames, base_frame, document, findings, default=ROBOT)
    calibration = _calibration(entry, document, findings, folder=path.parent, project=top)
    if findings:
        raise DocumentError(sorted(findings))
    return Robot(
        id=entry.robot,
        urdf=urdf.text,
        flange=entry.flange,
        joints=_joints(entry, urdf),
        base=base,
        payload_kg=entry.payload,
        tool_acceleration_m_s2=entry.tool_acceleration,
        home_rad=tuple(position.value for position in entry.home),
        files=urdf.files,
        looks=urdf.looks,
        tool_speed_m_s=entry.tool_speed,
        calibration=calibration,
        followers=urdf.followers,
        frames=frames,
    )


def _joints(entry: RobotDocument, urdf: ReadUrdf) -> tuple[Joint, ...]:
    """The driven joints, with ranges and speeds that keep followers within theirs."""
    return tuple(
        urdf.limits.get(joint.name, DriverLimits()).joint(
            Joint(
                name=joint.name,
                lower_rad=joint.range[0].value,
                upper_rad=joint.range[1].value,
                speed_rad_s=joint.speed.value,
                acceleration_rad_s2=joint.acceleration.value,
                torque_n_m=joint.torque.value,
                kind=urdf.kinds[joint.name] or JointKind.REVOLUTE,
            )
        )
        for joint in entry.joints
    )


def _follower_findings(entry: RobotDocument, document: Document, urdf: ReadUrdf) -> Iterator[Finding]:
    """A finding for each joint whose range or home takes a follower out of its own range."""
    for index, joint in enumerate(entry.joints):
        limits = urdf.limits.get(joint.name)
        if limits is None or joint.range[0].value >= joint.range[1].value:
            continue
        names = ", ".join(repr(one.name) for one in urdf.followers if one.driver == index)
        lower, upper = max(joint.range[0].value, limits.lower), min(joint.range[1].value, limits.upper)
        ends = " to ".join(
            f"{end * 1e3:.6g} mm" if joint.range[0].is_linear else f"{math.degrees(end):.6g} deg"
            for end in (limits.lower, limits.upper)
        )
        if lower >= upper:
            message = f"no position of joint {joint.name!r} has what follows it, {names}, within its range"
            hint = f"give it a range from {ends}"
            yield document.finding("scene.range", message, ("joints", index, "range"), hint=hint)
        elif index < len(entry.home) and not lower <= entry.home[index].value <= upper:
            message = f"home of joint {joint.name!r} has what follows it, {names}, outside its range"
            hint = f"give a position from {ends}"
            yield document.finding("scene.home", message, ("home", index), hint=hint)


def _calibration(
    entry: RobotDocument, document: Document, findings: list[Finding], *, folder: Path, project: Path
) -> Calibration | None:
    """Calibration of a robot file; None if it names none, or an invalid one, for which findings are added."""
    name = entry.calibration
    if name is None:
        return None
    problems = list(named_file_findings(document, name, ("calibration",), folder=folder, project=project))
    findings.extend(problems)
    if problems:
        return None
    try:
        calibration = load_calibration(folder / name, label=os.path.relpath(folder / name, project))
    except DocumentError as error:
        findings.extend(error.findings)
        return None
    if calibration.robot != entry.robot:
        message = f"the calibration is of robot {shown(calibration.robot)}, not of {shown(entry.robot)}"
        hint = "its servos are those of the recorded robot; if that is this one, write its id under 'calibration' there"
        findings.append(document.finding("scene.calibration", message, ("calibration",), hint=hint))
    known = [joint.name for joint in entry.joints]
    for joint, _ in calibration.servos:
        if joint not in known:
            message = f"the calibration has a servo of {shown(joint)}, which is not a joint of the robot"
            hint = f"joints: {', '.join(known)}"
            findings.append(document.finding("scene.calibration", message, ("calibration",), hint=hint))
    return calibration


def _empty_ranges(entry: RobotDocument, document: Document) -> Iterable[Finding]:
    for index, joint in enumerate(entry.joints):
        if joint.range[0].value >= joint.range[1].value:
            message = f"joint {joint.name!r} has an empty range"
            yield document.finding("scene.range", message, ("joints", index, "range"))


def _repeated_joints(entry: RobotDocument, document: Document) -> Iterable[Finding]:
    """A finding for each duplicate joint."""
    seen: set[str] = set()
    for index, joint in enumerate(entry.joints):
        if joint.name in seen:
            yield document.finding(
                "scene.duplicate-id",
                f"joint {joint.name!r} is listed twice",
                ("joints", index, "name"),
                hint="name each joint of the arm once, from the base to the flange",
            )
        seen.add(joint.name)
