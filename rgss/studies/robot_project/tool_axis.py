"""The axis of a link along which a gripper points away from the arm."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.scenes import Pose, chain_to, link_solid, origin_of
from rgss.studies.robot_project.urdf import Note, UrdfArm, find_named_file

Array = NDArray[np.float64]

TOOL_AXES = {
    "z": "0 0 0",
    "-z": "3.141592653589793 0 0",
    "x": "0 1.5707963267948966 0",
    "-x": "0 -1.5707963267948966 0",
    "y": "-1.5707963267948966 0 0",
    "-y": "1.5707963267948966 0 0",
}
"""Axes of a link, and the roll, pitch and yaw of a frame whose z axis points along each."""

_ALONG = 0.9
_LEAST_OFFSET_M = 0.002


def likely_tool_axes(root: ET.Element, arm: UrdfArm, urdf: Path) -> tuple[str, ...]:
    """Axes of the flange along which a gripper may point, the most likely first.

    That towards a hand that the URDF has there; z where it is parallel to the last joint's axis, as conventions have
    it; that from the last joint to the flange; the last joint's axis, away from its link; then the others.
    """
    return tuple(dict.fromkeys(_likely(root, arm, urdf)))


def add_tool_frame(root: ET.Element, arm: UrdfArm, axis: str) -> tuple[str, list[Note]]:
    """Add a frame to a flange whose z axis points along one of its axes, where a hand of the URDF is mounted.

    Args:
        root: The URDF; it is changed unless the flange itself serves.
        arm: The arm in it.
        axis: The axis, one of `TOOL_AXES`.

    Returns:
        The link to which a gripper is mounted, and what was assumed.

    Raises:
        DefinitionError: There is no such axis.
    """
    if axis not in TOOL_AXES:
        raise DefinitionError(f"a link has no axis {axis!r}", hint=f"its axes are {', '.join(TOOL_AXES)}")
    flange = arm.flange
    direction = (-1.0 if axis.startswith("-") else 1.0) * np.eye(3)["xyz".index(axis[-1])]
    away_m = float(direction @ _hand_offset(root, arm))
    if axis == "z" and away_m < _LEAST_OFFSET_M:
        return flange, []
    at = direction * max(away_m, 0.0)
    notes = []
    if axis != "z":
        rationale = f"The gripper points along the {axis} axis of {flange}, away from the arm."
        notes.append(Note(about="flange", rationale=rationale))
    if away_m >= _LEAST_OFFSET_M:
        rationale = f"The gripper is mounted where the hand is, {1e3 * away_m:.0f} mm from {flange}."
        notes.append(Note(about="flange", rationale=rationale))
    names = {link.get("name", "") for link in root.findall("link")}
    name = f"{flange}_mount"
    while name in names:
        name += "_"
    ET.SubElement(root, "link", {"name": name})
    joint = ET.SubElement(root, "joint", {"name": f"{name}_joint", "type": "fixed"})
    ET.SubElement(joint, "origin", {"xyz": " ".join(f"{value:.6g}" for value in at), "rpy": TOOL_AXES[axis]})
    ET.SubElement(joint, "parent", {"link": flange})
    ET.SubElement(joint, "child", {"link": name})
    return name, notes


def _likely(root: ET.Element, arm: UrdfArm, urdf: Path) -> Iterator[str]:
    chain = chain_to(root, arm.flange)
    last = max(index for index, joint in enumerate(chain.joints) if joint.get("type") != "fixed")
    flange = Pose()
    for joint in chain.joints[last + 1 :]:
        flange = flange @ origin_of(joint)
    element = chain.joints[last].find("axis")
    axis = np.array([float(word) for word in ("1 0 0" if element is None else element.get("xyz", "1 0 0")).split()])
    turned = _seen_from(flange, axis)
    along = _named_axis(turned)
    hand = _hand_offset(root, arm)
    if np.linalg.norm(hand) > _LEAST_OFFSET_M and (found := _named_axis(hand)) is not None:
        yield found
    if along is not None and along.lstrip("-") == "z":
        yield from ("z", "-z")
    reach = np.array(flange.position_m)
    if np.linalg.norm(reach) > _LEAST_OFFSET_M:
        found = _named_axis(_seen_from(flange, reach))
        if found is not None:
            yield found
    if along is not None:
        outward = turned @ _seen_from(flange, _centre(root, chain.links[last], urdf))
        opposite = along[1:] if along.startswith("-") else f"-{along}"
        yield from (along, opposite) if outward >= 0.0 else (opposite, along)
    yield from TOOL_AXES


def _hand_offset(root: ET.Element, arm: UrdfArm) -> Array:
    """Mean of where the parts of a hand are joined to the flange; zero without a hand."""
    offsets = [
        np.array(origin_of(joint).position_m)
        for joint in root.findall("joint")
        for parent, child in ((joint.find("parent"), joint.find("child")),)
        if parent is not None and child is not None
        if parent.get("link") == arm.flange and child.get("link") in arm.hands
    ]
    found: Array = np.mean(offsets, axis=0) if offsets else np.zeros(3)
    return found


def _centre(root: ET.Element, name: str, urdf: Path) -> Array:
    link = next(one for one in root.findall("link") if one.get("name") == name)
    solid = link_solid(link, lambda file: find_named_file(file, urdf))
    return np.zeros(3) if solid is None else solid.centre_m


def _seen_from(frame: Pose, direction: Array) -> Array:
    """A direction in the axes of a frame."""
    axes = np.array([frame.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))])
    found: Array = axes @ direction
    return found


def _named_axis(direction: Array) -> str | None:
    """The axis along which a direction points; None where it is oblique."""
    length = float(np.linalg.norm(direction))
    index = int(np.argmax(np.abs(direction)))
    if length == 0.0 or abs(float(direction[index])) < _ALONG * length:
        return None
    return ("" if direction[index] > 0.0 else "-") + "xyz"[index]
