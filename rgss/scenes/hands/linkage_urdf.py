"""Mechanism of a gripper within a URDF: the palm with its descendants, the driven joint and its mimic joints."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping

from rgss.scenes.convex_shapes import CONVEX, origin_of, vertices_of
from rgss.scenes.findings import Location
from rgss.scenes.hands.linkage_document import LinkageGripperDocument
from rgss.scenes.joints import follows, is_number, mimic_problems
from rgss.scenes.linkage import LinkageLink, Triple
from rgss.scenes.pose import Pose
from rgss.scenes.urdf_chain import kind_of
from rgss.scenes.urdf_structure import axis_of, end_of

Problem = tuple[str, Location, str]

_SIDES = 32
_RINGS = 8
_MOMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")


def palm_of(root: ET.Element, entry: LinkageGripperDocument) -> str:
    """Link at the flange: the named one, else the base of the URDF."""
    if entry.palm is not None:
        return entry.palm
    carried = {end_of(joint, "child") for joint in root.findall("joint")}
    return next((link.get("name", "") for link in root.findall("link") if link.get("name") not in carried), "")


def prune(root: ET.Element, palm: str) -> None:
    """Reduce a URDF to the palm and its descendants.

    Args:
        root: The URDF, which has the palm; modified in place.
        palm: The link.
    """
    kept = {palm}
    joints = root.findall("joint")
    while True:
        more = {end_of(joint, "child") for joint in joints if end_of(joint, "parent") in kept} - kept
        if not more:
            break
        kept |= more
    for joint in joints:
        if end_of(joint, "parent") not in kept:
            root.remove(joint)
    for link in root.findall("link"):
        if link.get("name") not in kept:
            root.remove(link)


def driven_joints(root: ET.Element) -> tuple[str, ...]:
    """Movable joints of a gripper without ``<mimic>``.

    Args:
        root: The gripper's part of a URDF.
    """
    return tuple(
        joint.get("name", "")
        for joint in root.findall("joint")
        if joint.get("type") != "fixed" and joint.find("mimic") is None
    )


def mechanism_problems(root: ET.Element, entry: LinkageGripperDocument) -> Iterable[Problem]:
    """Problems of a URDF as the mechanism of a gripper: message, location in the gripper file, hint.

    Args:
        root: The gripper's part of a URDF.
        entry: The gripper file.
    """
    links = {link.get("name", ""): link for link in root.findall("link")}
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    for index, name in enumerate(entry.pads):
        if name not in links:
            yield f"has no link {name!r} below the palm", ("pads", index), f"links: {', '.join(links)}"
    if entry.pads[0] == entry.pads[1]:
        yield f"has the link {entry.pads[0]!r} for both pads", ("pads",), "name the links of two fingers"
    carried = {palm_of(root, entry)}
    for joint in root.findall("joint"):
        child = end_of(joint, "child")
        if child not in links:
            problem = f"lets the joint {joint.get('name')!r} carry {child!r}, which is not one of its links"
            yield problem, ("description",), ""
        elif child in carried:
            hint = "a link has one joint; let joints follow with <mimic> instead of closing a loop"
            yield (
                f"has several joints that carry the link {child!r}, or one that carries the palm",
                ("description",),
                hint,
            )
        carried.add(child)
    for joint in joints.values():
        if joint.get("type") != "fixed" and kind_of(joint) is None:
            hint = "joints of a gripper are revolute, continuous or prismatic"
            yield f"has the {joint.get('type')} joint {joint.get('name')!r}", ("description",), hint
    driven = driven_joints(root)
    if len(driven) != 1:
        listed = f" ({', '.join(driven)})" if driven else ""
        hint = "let all others follow one with <mimic>, or state its sizes (kind: parallel); 'palm' leaves an arm out"
        yield f"has {len(driven)} driven joints{listed}, a gripper has one", ("description",), hint
    yield from mimic_problems(joints, joints)
    for name in driven:
        yield from _limit_problems(joints[name])
    yield from _mass_problems(links, joints, palm_of(root, entry))


def links_of(root: ET.Element, palm: str, mount: Pose) -> tuple[LinkageLink, ...]:
    """Links of a gripper in topological order.

    Args:
        root: The gripper's part of a URDF, without problems; collision meshes are convex shapes.
        palm: The link at the flange.
        mount: Transform of the palm to the flange.
    """
    elements = {link.get("name", ""): link for link in root.findall("link")}
    joints = root.findall("joint")
    by_name = {joint.get("name", ""): joint for joint in joints}
    found = [_link(elements[palm], None, -1, mount, by_name)]
    names = [palm]
    for at, name in enumerate(names):
        for joint in joints:
            if end_of(joint, "parent") == name:
                child = end_of(joint, "child")
                names.append(child)
                found.append(_link(elements[child], joint, at, origin_of(joint), by_name))
    return tuple(found)


def _mass_problems(links: Mapping[str, ET.Element], joints: Mapping[str, ET.Element], palm: str) -> Iterable[Problem]:
    """Rigid parts without a mass: links on fixed joints are one part with the link that carries them.

    A moving part without a shape that carries nothing stands for the command alone, and needs none.
    """
    fixed_to = {
        end_of(joint, "child"): end_of(joint, "parent") for joint in joints.values() if joint.get("type") == "fixed"
    }
    parts: dict[str, list[ET.Element]] = {}
    for name, link in links.items():
        first, seen = name, {name}
        while first != palm and fixed_to.get(first, "") in links and fixed_to[first] not in seen:
            first = fixed_to[first]
            seen.add(first)
        parts.setdefault(first, []).append(link)
    carriers = {end_of(joint, "parent") for joint in joints.values() if joint.get("type") != "fixed"}
    for first, part in parts.items():
        acts = first == palm or any(link.find("collision") is not None or link.get("name") in carriers for link in part)
        if acts and not any(_has_inertia(link) for link in part):
            hint = "give it an <inertial> with a mass above 0 and its moments"
            yield f"has no mass or no inertia for link {first!r}", ("description",), hint


def _limit_problems(joint: ET.Element) -> Iterable[Problem]:
    name, limit = joint.get("name", ""), joint.find("limit")
    values = {key: "" if limit is None else limit.get(key, "") for key in ("lower", "upper", "effort", "velocity")}
    values["lower"] = values["lower"] or "0"
    if not all(is_number(value) for value in values.values()):
        hint = 'write <limit lower="…" upper="…" effort="…" velocity="…"/>'
        yield f"does not limit the driven joint {name!r}", ("description",), hint
        return
    if float(values["lower"]) >= float(values["upper"]):
        yield f"leaves the driven joint {name!r} no travel", ("description",), "make upper greater than lower"
    for key in ("effort", "velocity"):
        if float(values[key]) <= 0.0:
            yield f"gives the driven joint {name!r} no {key}", ("description",), "make it greater than zero"


def _link(
    link: ET.Element, joint: ET.Element | None, parent: int, origin: Pose, joints: Mapping[str, ET.Element]
) -> LinkageLink:
    kind = None if joint is None else kind_of(joint)
    multiplier, offset = (0.0, 0.0) if joint is None or kind is None else follows(joint.get("name", ""), joints)
    has_inertia = _has_inertia(link)
    inertial = link.find("inertial")
    inertia = None if inertial is None else inertial.find("inertia")
    mass = None if inertial is None else inertial.find("mass")
    moments = [float(inertia.get(key, "0")) for key in _MOMENTS] if inertia is not None and has_inertia else [0.0] * 6
    xx, yy, zz, xy, xz, yz = moments
    return LinkageLink(
        name=link.get("name", ""),
        parent=parent,
        origin=origin,
        kind=kind,
        axis=(1.0, 0.0, 0.0) if joint is None else axis_of(joint),
        multiplier=multiplier,
        offset=offset,
        mass_kg=float(mass.get("value", "0")) if mass is not None and has_inertia else 0.0,
        inertial=Pose() if inertial is None else origin_of(inertial),
        inertia_kg_m2=(xx, yy, zz, xy, xz, yz),
        hulls_m=tuple(hull for shape in link.findall("collision") for hull in _hulls(shape)),
    )


def _hulls(shape: ET.Element) -> Iterable[tuple[Triple, ...]]:
    """Corners of a collision shape in the link's frame; a round shape is circumscribed by a polyhedron."""
    pose, geometry = origin_of(shape), shape.find("geometry")
    for solid in () if geometry is None else geometry:
        corners: Iterable[Triple] = ()
        if solid.tag == CONVEX:
            corners = vertices_of(solid)
        elif solid.tag == "box":
            x, y, z = (float(value) / 2 for value in solid.get("size", "").split())
            corners = [(i * x, j * y, k * z) for i in (-1, 1) for j in (-1, 1) for k in (-1, 1)]
        elif solid.tag == "cylinder":
            radius, half = float(solid.get("radius", "")), float(solid.get("length", "")) / 2
            corners = [(x, y, z) for x, y in _ring(radius) for z in (-half, half)]
        elif solid.tag == "sphere":
            corners = list(_ball(float(solid.get("radius", ""))))
        yield tuple(_moved(pose, corner) for corner in corners)


def _ring(radius: float) -> Iterable[tuple[float, float]]:
    outer = radius / math.cos(math.pi / _SIDES)
    for side in range(_SIDES):
        angle = math.tau * side / _SIDES
        yield outer * math.cos(angle), outer * math.sin(angle)


def _ball(radius: float) -> Iterable[Triple]:
    outer = radius / math.cos(math.pi / (2 * _RINGS))
    yield 0.0, 0.0, outer
    yield 0.0, 0.0, -outer
    for ring in range(1, _RINGS):
        angle = math.pi * ring / _RINGS
        for x, y in _ring(outer * math.sin(angle)):
            yield x, y, outer * math.cos(angle)


def _moved(pose: Pose, point: Triple) -> Triple:
    (x, y, z), (dx, dy, dz) = pose.position_m, pose.rotate(point)
    return x + dx, y + dy, z + dz


def _has_inertia(link: ET.Element) -> bool:
    mass = link.find("inertial/mass")
    text = "" if mass is None else mass.get("value", "")
    return is_number(text) and float(text) > 0.0 and link.find("inertial/inertia") is not None
