"""Findings on an arm's description that can be used all the same."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from rgss.documents import read_document
from rgss.errors import DefinitionError
from rgss.findings import Finding, Severity
from rgss.kinematics import lasting_contacts
from rgss.scenes import JointKind, Robot
from rgss.studies.motion import calibrated_at
from rgss.studies.project import Project
from rgss.studies.robot_project.holding import weak_joints
from rgss.studies.robot_project.mesh_problems import LARGEST_LENGTH_M, mesh_problems
from rgss.studies.robot_project.reach import SAMPLES

_LARGEST_MASS_KG = 1000.0
_LARGEST_ANGLE_RAD = 30.0
_LEAST_MASS_KG_M = 0.3
_LIMITS = (("joints.torque", "effort", "effort"), ("joints.speed", "velocity", "velocity"))
_NOTES = frozenset({"robot.open-mesh", "robot.concave-mesh"})


def robot_findings(project: Project) -> tuple[Finding, ...]:
    """Findings on the descriptions of the arms of a project's designs, and on their calibrations."""
    scene = PurePosixPath(project.study.scene)
    own = scene.parent / read_document(project.folder / scene, label=str(scene)).data["robot"]["description"]
    found: dict[Finding, None] = {}
    for arm, with_arm in project.by_arm().items():
        robot, place = with_arm.scene.robot, PurePosixPath(arm) if arm else own
        data = read_document(project.folder / place, label=str(place)).data
        urdf = place.parent / data["description"]
        path = project.folder / urdf
        found |= dict.fromkeys(description_findings(robot, path, str(urdf), assumed=assumed_subjects(data)))
        found |= dict.fromkeys(weak_joint_findings(robot, path, str(urdf)))
        found |= dict.fromkeys(_misfit_findings(with_arm))
        found |= dict.fromkeys(unchecked_pairs(robot, path, str(urdf)))
    return tuple(found)


def _misfit_findings(project: Project) -> Iterator[Finding]:
    """Warnings of joints whose calibrated servo does not explain the recording."""
    study, calibration = project.study, project.scene.robot.calibration
    document = read_document(project.folder / study.label, label=study.label)
    space = read_document(project.folder / study.design_space, label=study.design_space)
    chosen = calibrated_at(study.motion, document, project.designs, space)
    if chosen is None or calibration is None:
        return
    where, place = chosen
    for joint in calibration.misfits:
        message = f"the servo of joint {joint!r} misses part of the motion that it was calibrated on"
        hint = "record slower speeds, so that no torque limit is met"
        yield where.finding("study.misfit", message, place, hint=hint, severity=Severity.WARNING)


def unchecked_pairs(robot: Robot, urdf: Path, label: str) -> tuple[Finding, ...]:
    """Notes on the pairs of links that touch in every configuration, and so are not checked against each other.

    None without the engines, which find them.

    Args:
        robot: The arm.
        urdf: Its URDF.
        label: The URDF's name in messages.
    """
    try:
        pairs = sorted(sorted(pair) for pair in lasting_contacts(robot))
    except (ImportError, DefinitionError):
        return ()
    lines = urdf.read_text(encoding="utf-8-sig").splitlines()
    return tuple(
        Finding(
            file=label,
            line=next((at for at, line in enumerate(lines, start=1) if "<link" in line and f'"{first}"' in line), 1),
            column=1,
            rule="robot.unchecked-pair",
            severity=Severity.INFO,
            message=f"{first} and {second} touch in every configuration, and are not checked against each other",
            hint="make the collision shape of one of them smaller if they should be",
        )
        for first, second in pairs
    )


def weak_joint_findings(robot: Robot, urdf: Path, label: str) -> tuple[Finding, ...]:
    """Warnings of joints that do not hold the arm itself in a sampled configuration; none without the engines.

    Args:
        robot: The arm.
        urdf: The file whose lines are named.
        label: The URDF's name in messages.
    """
    try:
        weak = weak_joints(robot)
    except (ImportError, DefinitionError):
        return ()
    lines = urdf.read_text(encoding="utf-8-sig").splitlines()
    return tuple(
        Finding(
            file=label,
            line=next(
                (at for at, line in enumerate(lines, start=1) if "<joint" in line and f'"{one.name}"' in line), 1
            ),
            column=1,
            rule="robot.weak-joint",
            severity=Severity.WARNING,
            message=f"joint {one.name} gives {one.effort:.3g} {one.unit}, "
            f"and needs {one.needed:.3g} {one.unit} to hold the arm itself in the worst of {SAMPLES} configurations",
            hint="correct the effort of the joint, or the masses of the links that it carries",
        )
        for one in weak
    )


def assumed_subjects(data: Mapping[str, Any]) -> frozenset[str]:
    """Subjects of a robot file's assumptions."""
    return frozenset(str(entry["about"]) for entry in data.get("assumptions", ()))


def description_findings(
    robot: Robot, urdf: Path, label: str, *, assumed: Collection[str] = (), lines_of: Path | None = None
) -> tuple[Finding, ...]:
    """Findings on a description that can be used: units, masses, inertias, limits, meshes.

    A limit that the URDF lacks is a note where the robot file states that its own value is an assumption.

    Args:
        robot: The arm.
        urdf: Its URDF.
        label: The URDF's name in messages.
        assumed: What the robot file's assumptions are about.
        lines_of: The file whose lines are named, if it is another one than the URDF.
    """
    text = urdf.read_text(encoding="utf-8-sig")
    root = ET.fromstring(text)  # noqa: S314 - entities and document types were refused on reading
    lines = (urdf if lines_of is None else lines_of).read_text(encoding="utf-8-sig").splitlines()
    found = []
    used = {link.get("name", "") for link in ET.fromstring(robot.urdf).findall("link")}  # noqa: S314 - as above
    for link in root.findall("link"):
        if link.get("name") not in used:
            root.remove(link)
    stated = tuple(_limits(root, robot, _subjects(assumed, kept=True)))
    lacking = (*_lengths(root), *_masses(root), *_limits(root, robot, _subjects(assumed, kept=False)))
    lacking += (*_ranges(root, robot), *_placeholder_masses(root, robot))
    for name, rule, message, hint in (*lacking, *stated, *mesh_problems(root, urdf)):
        at = next((number for number, line in enumerate(lines, start=1) if f'"{name}"' in line), 1)
        noted = rule in _NOTES or (name, rule, message, hint) in stated
        severity = Severity.INFO if noted else Severity.WARNING
        found.append(Finding(file=label, line=at, column=1, rule=rule, severity=severity, message=message, hint=hint))
    return tuple(dict.fromkeys(found))


def _lengths(root: ET.Element) -> Iterator[tuple[str, str, str, str]]:
    hint = "a URDF is in metres and radians"
    for part in (*root.findall("link"), *root.findall("joint")):
        name = part.get("name", "")
        for element in part.iter():
            for key in ("xyz", "size", "radius", "length"):
                if element.tag == "axis" or key not in element.attrib:
                    continue
                largest = max((abs(float(word)) for word in element.get(key, "").split()), default=0.0)
                if largest > LARGEST_LENGTH_M:
                    yield name, "robot.units", f"{name} has a length of {largest:g} m: are these millimetres?", hint


def _masses(root: ET.Element) -> Iterator[tuple[str, str, str, str]]:
    for link in root.findall("link"):
        name = link.get("name", "")
        mass, inertia = link.find("inertial/mass"), link.find("inertial/inertia")
        value = float(mass.get("value", "0")) if mass is not None else 0.0
        if value > _LARGEST_MASS_KG:
            yield name, "robot.units", f"{name} weighs {value:g} kg: are these grams?", "a URDF is in kilograms"
        if inertia is None or value == 0.0:
            continue
        xx, yy, zz, xy, xz, yz = (float(inertia.get(key, "0")) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
        moments = np.linalg.eigvalsh(np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])).tolist()
        if moments[0] < 0.0 or moments[0] + moments[1] < moments[2] * (1 - 1e-6):
            yield (
                name,
                "robot.inertia",
                f"{name} has moments of inertia that no body has",
                "no principal moment is negative, or greater than the sum of the two others",
            )


def _placeholder_masses(root: ET.Element, robot: Robot) -> Iterator[tuple[str, str, str, str]]:
    """A mass of all links together that no arm of this length has, such as 10 g for each."""
    joints = {joint.find("child").get("link", ""): joint for joint in root.findall("joint")}  # type: ignore[union-attr]
    length_m, link = 0.0, robot.flange
    moved = []
    while (joint := joints.get(link)) is not None:
        moved.append(link)
        origin, parent = joint.find("origin"), joint.find("parent")
        words = "0" if origin is None else origin.get("xyz", "0")
        length_m += math.hypot(*(float(word) for word in words.split()))
        link = "" if parent is None else parent.get("link", "")
    masses = {one.get("name", ""): one.find("inertial/mass") for one in root.findall("link")}
    found = {name: float(mass.get("value", "0")) for name in moved if (mass := masses.get(name)) is not None}
    mass_kg = math.fsum(found.values())
    if 0.0 < mass_kg < _LEAST_MASS_KG_M * length_m:
        weight = f"weigh {mass_kg:.3g} kg over a length of {length_m:.3g} m"
        message = f"the moving links of {robot.id} {weight}: are their masses placeholders?"
        hint = "state measured masses and inertias; efforts, energy and payload follow from them"
        yield list(found)[-1], "robot.placeholder-mass", message, hint


def _subjects(assumed: Collection[str], *, kept: bool) -> tuple[tuple[str, str], ...]:
    """The limits, as the URDF and messages name them, that the robot file assumes or does not."""
    return tuple((key, what) for about, key, what in _LIMITS if (about in assumed) is kept)


def _limits(
    root: ET.Element, robot: Robot, subjects: Collection[tuple[str, str]]
) -> Iterator[tuple[str, str, str, str]]:
    names = {joint.name for joint in robot.joints}
    for joint in root.findall("joint"):
        name, limit = joint.get("name", ""), joint.find("limit")
        if name not in names:
            continue
        for key, what in subjects:
            if limit is None or float(limit.get(key, "0")) <= 0.0:
                yield name, "robot.limit", f"joint {name} has no {what}", "the robot file's value is used alone"


def _ranges(root: ET.Element, robot: Robot) -> Iterator[tuple[str, str, str, str]]:
    kinds = {joint.name: joint.kind for joint in robot.joints}
    for joint in root.findall("joint"):
        name, limit = joint.get("name", ""), joint.find("limit")
        if name not in kinds or limit is None or joint.get("type") == "continuous":
            continue
        lower, upper = (float(limit.get(end, "0")) for end in ("lower", "upper"))
        if lower > upper:
            message = f"joint {name} has a range from {lower:g} to {upper:g}"
            yield name, "robot.limit", message, "exchange lower and upper; the robot file's range is used alone"
        elif kinds[name] is JointKind.REVOLUTE and max(abs(lower), abs(upper)) > _LARGEST_ANGLE_RAD:
            message = f"joint {name} has a range from {lower:g} to {upper:g} rad: are these degrees?"
            yield name, "robot.units", message, "a URDF is in metres and radians"
