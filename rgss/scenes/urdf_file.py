"""Reader and validator of a robot's URDF, independent of any engine."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from rgss.documents import Document
from rgss.findings import Finding, shown
from rgss.scenes.document import RobotDocument
from rgss.scenes.findings import Location
from rgss.scenes.joints import DriverLimits, Follower, JointKind, driver_limits, followers_of
from rgss.scenes.looks import looks_of
from rgss.scenes.robot import LinkLook, RobotFile
from rgss.scenes.urdf_chain import chain_problems, chain_to, kind_of, loads_without_inertia, settle, unfrozen
from rgss.scenes.urdf_meshes import embed_collision_meshes, files_of, without_meshes
from rgss.scenes.urdf_structure import carried_by

_LARGEST_BYTES = 1024 * 1024
_DEEPEST_NESTING = 40

_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]{1,3})?")
_INERTIA = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")

# Count of numbers of each attribute, by element. The engines read invalid numbers as zero.
_NUMBERS: Mapping[str, Mapping[str, int]] = {
    "origin": {"xyz": 3, "rpy": 3},
    "axis": {"xyz": 3},
    "limit": {"lower": 1, "upper": 1, "effort": 1, "velocity": 1},
    "mass": {"value": 1},
    "inertia": dict.fromkeys(_INERTIA, 1),
    "box": {"size": 3},
    "cylinder": {"radius": 1, "length": 1},
    "sphere": {"radius": 1},
    "mesh": {"scale": 3},
}
_COMPLETE = frozenset({"mass", "inertia", "box", "cylinder", "sphere"})
_SHAPES = frozenset({"box", "cylinder", "sphere", "mesh"})
_AXES = 3
_TURNING = frozenset({"revolute", "continuous", "prismatic"})
_POSITIVE = frozenset({"mass", "box", "cylinder", "sphere"})


@dataclass(frozen=True, slots=True, kw_only=True)
class ReadUrdf:
    """URDF with its validation result.

    Attributes:
        text: Its text in the form passed to engines; valid only without findings.
        files: The meshes and textures that it references.
        looks: Its visual meshes.
        kinds: Kind of each joint by name; None if it is unsupported in an arm.
        followers: The mimic joints of the arm.
        limits: Limits of each joint of the arm with followers that keep these within theirs, by its name.
        findings: Every problem found.
    """

    text: str = ""
    files: tuple[RobotFile, ...] = ()
    looks: tuple[LinkLook, ...] = ()
    kinds: Mapping[str, JointKind | None] = field(default_factory=dict)
    followers: tuple[Follower, ...] = ()
    limits: Mapping[str, DriverLimits] = field(default_factory=dict)
    findings: tuple[Finding, ...] = ()


def read_urdf(path: Path, document: Document, entry: RobotDocument, *, project: Path) -> ReadUrdf:
    """Read a URDF and compare it with its robot file.

    Args:
        path: The URDF, which exists.
        document: The robot file, for positions.
        entry: The robot file's content.
        project: The folder that must contain all referenced files.
    """
    try:
        text, root = parse_urdf(path)
    except UrdfError as error:
        message = f"{shown(entry.description)} {error.problem}"
        return ReadUrdf(findings=(document.finding("scene.urdf", message, ("description",), hint=error.hint),))
    label = (Path(document.label).parent / entry.description).as_posix()
    named = files_of(text, path, project=project, label=label)
    findings = [
        document.finding("scene.urdf", f"{shown(entry.description)} {problem}", location, hint=hint)
        for problem, location, hint in _problems(root, entry)
    ]
    if findings or named.findings:
        return ReadUrdf(findings=(*findings, *named.findings))
    looks = looks_of(root, named.paths)
    kinds = {joint.get("name", ""): kind_of(joint) for joint in root.findall("joint")}
    followers, limits = _followers(root, entry, kinds)
    changed = settle(root, entry, followers)
    if any(collision.find("geometry/mesh") is not None for collision in root.iter("collision")):
        changed = True
        findings += [
            document.finding("scene.mesh", problem, ("description",), hint=hint)
            for problem, hint in embed_collision_meshes(root, named, entry.collision)
        ]
    settled = ET.tostring(root, encoding="unicode") if changed else text
    return ReadUrdf(
        text=without_meshes(settled),
        files=named.files,
        looks=looks,
        kinds=kinds,
        followers=followers,
        limits=limits,
        findings=tuple(findings),
    )


def _followers(
    root: ET.Element, entry: RobotDocument, kinds: Mapping[str, JointKind | None]
) -> tuple[tuple[Follower, ...], dict[str, DriverLimits]]:
    """The mimic joints of the arm, and the limits that they impose on their drivers."""
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    names = [joint.name for joint in entry.joints]
    moving = unfrozen(chain_to(root, entry.flange), entry)
    found = followers_of(moving, joints, names, {name: kind for name, kind in kinds.items() if kind is not None})
    drivers = dict.fromkeys(names[one.driver] for one in found)
    return found, {name: driver_limits(name, [one.name for one in found], joints) for name in drivers}


class UrdfError(Exception):
    """A URDF cannot be used; the message follows its name."""

    def __init__(self, problem: str, hint: str = "") -> None:
        super().__init__(problem)
        self.problem = problem
        self.hint = hint


def parse_urdf(path: Path) -> tuple[str, ET.Element]:
    """Text of a URDF and its elements.

    Args:
        path: The URDF, which exists.

    Raises:
        UrdfError: It cannot be read, or is not a URDF.
    """
    text = _read_text(path)
    return text, _parsed(text)


def _read_text(path: Path) -> str:
    try:
        with path.open("rb") as file:
            content = file.read(_LARGEST_BYTES + 1)
    except OSError as error:
        raise UrdfError(f"cannot be read: {error.strerror}") from None
    if len(content) > _LARGEST_BYTES:
        raise UrdfError("is larger than 1 MiB", "a robot of primitive shapes needs a few KiB")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise UrdfError("is not UTF-8", "save the file as UTF-8") from None


def _parsed(text: str) -> ET.Element:
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise UrdfError("declares a document type or an entity", "remove the declaration")
    try:
        root = ET.fromstring(text)  # noqa: S314 - entities and document types are refused above
    except ET.ParseError as error:
        raise UrdfError(f"is not XML: {error}") from None
    if root.tag != "robot":
        raise UrdfError(f"has the root element {shown(root.tag)}", "a URDF's root element is 'robot'")
    level = [root]
    for _ in range(_DEEPEST_NESTING):
        level = [child for element in level for child in element]
    if level:
        raise UrdfError(f"is nested more than {_DEEPEST_NESTING} deep", "a URDF nests a handful of elements")
    return root


def _problems(root: ET.Element, entry: RobotDocument) -> Iterable[tuple[str, Location, str]]:
    # Only children: elsewhere, as in a transmission, elements of the same tag refer to joints.
    links = {link.get("name", ""): link for link in root.findall("link")}
    joints = {joint.get("name", "") for joint in root.findall("joint")}
    if entry.flange not in links:
        yield f"has no link {entry.flange!r}", ("flange",), "name the link that carries the gripper"
    for index, joint in enumerate(entry.joints):
        if joint.name not in joints:
            yield f"has no joint {joint.name!r}", ("joints", index, "name"), "name the joints as the URDF does"
    yield from chain_problems(root, entry)
    gone = carried_by(root, entry.without)
    for name in (one for one in loads_without_inertia(root) if one not in gone):
        # One engine would silently assume 1 kg, another 0.
        hint = "give it an <inertial> with both; a frame that is fixed and has no collision shape needs none"
        yield f"has no mass or no inertia for link {shown(name)}", ("description",), hint
    yield from number_problems(root)
    for link in (one for name, one in links.items() if name not in gone):
        for shape in link.findall("collision/geometry/*"):
            if shape.tag not in _SHAPES:
                # Planning would silently do without it.
                hint = "write box, cylinder, sphere or mesh; a capsule is a cylinder with a sphere at each end"
                yield (
                    f"has a collision shape {shown(shape.tag)} for link {shown(link.get('name', ''))}",
                    ("description",),
                    hint,
                )


def number_problems(root: ET.Element) -> Iterable[tuple[str, Location, str]]:
    """Attributes that are not the required numbers: message, location in the referring file, hint."""
    for part in (*root.findall("link"), *root.findall("joint")):
        axis = part.find("axis")
        if part.get("type") in _TURNING and axis is not None and _is_null(axis.get("xyz", "")):
            yield (
                f"has an axis without a direction for {shown(part.get('name', ''))}",
                ("description",),
                "write a direction, such as 0 0 1",
            )
        for element in part.iter():
            for attribute, count in _NUMBERS.get(element.tag, {}).items():
                text = element.get(attribute)
                if text is None and element.tag not in _COMPLETE:
                    continue
                if element.tag == "mass" and _is_zero(text):
                    # A missing mass that is required is reported elsewhere; a base or a frame may lack it.
                    continue
                positive = element.tag in _POSITIVE
                if text is None or not _are_numbers(text, count, positive=positive):
                    found = f"no {attribute}" if text is None else f"{attribute}={shown(text)}"
                    wanted = "a number" if count == 1 else f"{count} numbers"
                    yield (
                        f"has {found} in <{element.tag}> of {shown(part.get('name', ''))}",
                        ("description",),
                        f"write {wanted}{' greater than zero' if positive else ''}",
                    )


def _is_null(text: str) -> bool:
    words = text.split()
    return len(words) == _AXES and all(_is_zero(word) for word in words)


def _is_zero(text: str | None) -> bool:
    return text is not None and bool(_NUMBER.fullmatch(text.strip())) and float(text) == 0.0


def _are_numbers(text: str, count: int, *, positive: bool) -> bool:
    words = text.split()
    return len(words) == count and all(
        _NUMBER.fullmatch(word) and math.isfinite(float(word)) and (float(word) > 0 or not positive) for word in words
    )
