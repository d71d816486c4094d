"""Reading of a URDF as others write it: xacros, old prefixes, names that are no identifiers, empty shapes."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

from rgss.counted import counted
from rgss.documents import open_regular
from rgss.errors import DefinitionError
from rgss.scenes import number_problems
from rgss.studies.robot_project.urdf.capsules import divide_capsules
from rgss.studies.robot_project.urdf.xacro import expanded, needs_expansion

_LARGEST_URDF_BYTES = 1024 * 1024
_KEPT = frozenset({"link", "joint", "material"})
_PREFIX = re.compile(r"</?([A-Za-z_][\w.-]*):")
_LARGEST_ROUNDING_RAD = 2e-3

NO_ARGUMENTS: Mapping[str, str] = MappingProxyType({})
"""Arguments of a xacro that has none, or the defaults of all."""
_SHAPES = {"box": ("size",), "cylinder": ("radius", "length"), "sphere": ("radius",)}


@dataclass(frozen=True, slots=True, kw_only=True)
class Note:
    """Something that was assumed about a URDF when a project was made round it.

    Attributes:
        about: What it is about, as an assumption of the robot file names it.
        rationale: What was assumed, and why.
    """

    about: str
    rationale: str


def read_arm_urdf(urdf: Path, xacro: Mapping[str, str] = NO_ARGUMENTS) -> tuple[ET.Element, list[Note]]:
    """Read a URDF for a new project: links, joints and materials, with names that are identifiers.

    Args:
        urdf: The URDF, or a xacro, which is expanded.
        xacro: Values of the arguments of a xacro.

    Returns:
        The URDF, and what was assumed about it.

    Raises:
        DefinitionError: It cannot be read or expanded.
    """
    root = _parsed(urdf, xacro)
    for child in list(root):
        if child.tag not in _KEPT:
            root.remove(child)
    if not root.get("name", "").strip():
        root.set("name", urdf.stem)
    notes = [*_rename(root), *_drop_empty_shapes(root)]
    if divided := tuple(dict.fromkeys(divide_capsules(root))):
        parts = "a cylinder with a sphere at each end"
        notes.append(Note(about="description", rationale=f"Capsules are written as {parts}, of {', '.join(divided)}."))
    _complete_limits(root)
    problems = [
        f"{urdf.name} {problem}"
        for problem, _, _ in number_problems(root)
        if "in <mass>" not in problem and "in <inertia>" not in problem
    ]
    if problems:
        more = f", and {counted(len(problems) - 1, 'more problem')}" if len(problems) > 1 else ""
        raise DefinitionError(f"{problems[0]}{more}", hint="correct the numbers of the URDF")
    return root, notes


def _parsed(urdf: Path, xacro: Mapping[str, str]) -> ET.Element:
    hint = "name a URDF, or a xacro"
    try:
        with open_regular(urdf) as file:
            content = file.read(_LARGEST_URDF_BYTES + 1)
        text = content.decode("utf-8-sig")
    except OSError as error:
        raise DefinitionError(f"{urdf} cannot be read: {error.strerror or error}", hint=hint) from error
    except UnicodeDecodeError as error:
        raise DefinitionError(f"{urdf} cannot be read: it is not UTF-8", hint=hint) from error
    if len(content) > _LARGEST_URDF_BYTES or "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise DefinitionError(f"{urdf} is larger than 1 MiB or declares a document type", hint=hint)
    root = _root_of(text, urdf, hint)
    if needs_expansion(root):
        name = root.get("name", "")
        name = urdf.name.partition(".")[0] if not name or "$" in name else name
        root = _root_of(expanded(urdf, name=name, arguments=xacro), urdf, hint)
    if root.tag == "robot" and root.find("link") is None and "<xacro:macro" in text:
        raise DefinitionError(
            f"{urdf} defines macros and has no link of its own", hint="name the xacro that calls them with the robot"
        )
    if root.tag != "robot" or root.find("link") is None:
        raise DefinitionError(f"{urdf} is not a URDF: it has no robot with links", hint=hint)
    return root


def _root_of(text: str, urdf: Path, hint: str) -> ET.Element:
    try:
        return ET.fromstring(_with_known_prefixes(text))  # noqa: S314 - entities and document types were refused
    except ET.ParseError as error:
        raise DefinitionError(f"{urdf} is not XML: {error}", hint=hint) from error


def _with_known_prefixes(text: str) -> str:
    """A text whose prefixes are all declared: older files use those of a simulator without it."""
    unknown = sorted({prefix for prefix in _PREFIX.findall(text) if f"xmlns:{prefix}" not in text})
    declared = "".join(f' xmlns:{prefix}="urn:{prefix}"' for prefix in unknown)
    return re.sub(r"<robot\b", lambda found: found[0] + declared, text, count=1)


def _rename(root: ET.Element) -> Iterator[Note]:
    """Give links and joints names that are identifiers, where theirs are not."""
    for kind in ("link", "joint"):
        parts = root.findall(kind)
        for part in parts:
            part.set("name", part.get("name", "").strip())
        new = _identifiers([part.get("name", "") for part in parts], kind)
        for part in parts:
            part.set("name", new.get(part.get("name", ""), part.get("name", "")))
        for joint in root.findall("joint"):
            for end in joint.findall("parent") + joint.findall("child") if kind == "link" else joint.findall("mimic"):
                key = "link" if kind == "link" else "joint"
                name = end.get(key, "").strip()
                end.set(key, new.get(name, name))
        if new:
            pairs = ", ".join(f"{name!r} is {identifier}" for name, identifier in new.items())
            yield Note(
                about="description",
                rationale=f"A name is a letter, then letters, digits and _ . -, so that of the {kind}s {pairs}.",
            )


def _identifiers(names: list[str], kind: str) -> dict[str, str]:
    """Identifiers for the names that are none."""
    taken = set(names)
    found: dict[str, str] = {}
    for name in names:
        if re.fullmatch(r"[A-Za-z][A-Za-z0-9_.-]{0,79}", name) or name in found:
            continue
        stem = re.sub(r"[^A-Za-z0-9_.-]+", "_", name).strip("_.-")[:60]
        stem = stem if stem[:1].isalpha() else f"{kind}_{stem}".rstrip("_")
        identifier, number = stem, 1
        while identifier in taken:
            number += 1
            identifier = f"{stem}_{number}"
        taken.add(identifier)
        found[name] = identifier
    return found


def _drop_empty_shapes(root: ET.Element) -> Iterator[Note]:
    """Remove shapes without an extent, which some exporters write for frames."""
    dropped = []
    for link in root.findall("link"):
        for kind in ("visual", "collision"):
            for shape in link.findall(kind):
                geometry = shape.find("geometry")
                if geometry is None or len(geometry) == 0 or _is_empty(geometry[0]):
                    link.remove(shape)
                    if kind == "collision":
                        dropped.append(link.get("name", ""))
    if dropped:
        names = ", ".join(dict.fromkeys(dropped))
        yield Note(about="description", rationale=f"Collision shapes of zero size are left out, of {names}.")


def _complete_limits(root: ET.Element) -> None:
    """Write a speed and an effort of zero, which are reported as lacking, where parsers require the attributes."""
    for joint in root.findall("joint"):
        limit = joint.find("limit")
        if joint.get("type") not in ("revolute", "prismatic"):
            continue
        limit = ET.SubElement(joint, "limit") if limit is None else limit
        for key in ("effort", "velocity"):
            limit.set(key, limit.get(key, "0"))


def _is_empty(shape: ET.Element) -> bool:
    sizes = " ".join(shape.get(key, "0") for key in _SHAPES.get(shape.tag, ())).split()
    try:
        return bool(sizes) and any(float(word) == 0.0 for word in sizes)
    except ValueError:
        return False


def snap_right_angles(root: ET.Element) -> Iterator[Note]:
    """Make rounded right angles of joint frames exact, such as 1.57 and 3.1416.

    An arm of few joints turns its tool exactly down only if its axes are exactly parallel or perpendicular.

    Args:
        root: The URDF; modified in place.
    """
    snapped = []
    for joint in root.findall("joint"):
        origin = joint.find("origin")
        words = [] if origin is None else origin.get("rpy", "").split()
        exact = [_right_angle(word) for word in words]
        if origin is not None and exact != words:
            origin.set("rpy", " ".join(exact))
            snapped.append(joint.get("name", ""))
    if snapped:
        names = ", ".join(snapped)
        yield Note(about="description", rationale=f"Rounded right angles are made exact, of the frames of {names}.")


def _right_angle(word: str) -> str:
    try:
        quarters = round(float(word) / (math.pi / 2))
    except (ValueError, OverflowError):
        return word
    exact = quarters * math.pi / 2
    return repr(exact) if quarters and 0.0 < abs(float(word) - exact) < _LARGEST_ROUNDING_RAD else word
