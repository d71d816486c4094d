"""Structure of a URDF: links that joints connect, that move together, that do not move, and that have an inertia.

Separate from the reading of robot files: trials depend on it.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable

MOMENTS = ("ixx", "iyy", "izz")

_DEFAULT_AXIS = "1 0 0"
_LARGEST_AXIS_ERROR = 1e-9


def end_of(joint: ET.Element, end: str) -> str:
    """Name of a link that a joint connects; empty if the joint does not state it.

    Args:
        joint: The joint's element.
        end: `parent` or `child`.
    """
    found = joint.find(end)
    return "" if found is None else found.get("link", "")


def axis_of(joint: ET.Element) -> tuple[float, float, float]:
    """Unit vector of a joint's axis in the joint's frame; x if the joint states none, null for a null axis.

    Args:
        joint: The joint's element; the axis of a fixed joint may be null.
    """
    element = joint.find("axis")
    stated = _DEFAULT_AXIS if element is None else element.get("xyz", _DEFAULT_AXIS)
    x, y, z = (float(word) for word in stated.split())
    length = math.hypot(x, y, z) or 1.0
    return x / length, y / length, z / length


def normalise_axis(joint: ET.Element) -> bool:
    """Scale a joint's axis to length 1, which some engines require and others do by themselves.

    Args:
        joint: The joint's element, whose axis is not null; modified in place.

    Returns:
        True if the axis was changed; its text is kept if it is a unit vector within 1e-9.
    """
    element = joint.find("axis")
    if element is None or "xyz" not in element.attrib:
        return False
    length = math.hypot(*(float(word) for word in element.get("xyz", "").split()))
    if abs(length - 1.0) <= _LARGEST_AXIS_ERROR:
        return False
    element.set("xyz", " ".join(repr(value) for value in axis_of(joint)))
    return True


def carried_by(root: ET.Element, names: Iterable[str]) -> set[str]:
    """Links with all their descendants."""
    found = set(names)
    joints = root.findall("joint")
    while more := {end_of(joint, "child") for joint in joints if end_of(joint, "parent") in found} - found:
        found |= more
    return found


def standing_links(root: ET.Element) -> set[str]:
    """Links of a URDF that do not move: the base and all links fixed to it."""
    joints = root.findall("joint")
    carried = {end_of(joint, "child") for joint in joints}
    standing = {link.get("name", "") for link in root.findall("link")} - carried
    fixed = [(end_of(joint, "parent"), end_of(joint, "child")) for joint in joints if joint.get("type") == "fixed"]
    while more := {child for parent, child in fixed if parent in standing} - standing:
        standing |= more
    return standing


def has_inertia(link: ET.Element) -> bool:
    """True if a link states a mass above zero and an inertia."""
    mass = link.find("inertial/mass")
    return mass is not None and not _is_zero(mass.get("value", "0")) and link.find("inertial/inertia") is not None


def has_moments(link: ET.Element) -> bool:
    """True if a link states a moment of inertia that is not zero."""
    inertia = link.find("inertial/inertia")
    return inertia is not None and not all(_is_zero(inertia.get(name, "0")) for name in MOMENTS)


def _is_zero(text: str) -> bool:
    """True if a text is a number that is zero; other texts are reported elsewhere."""
    try:
        return float(text or "0") == 0.0
    except ValueError:
        return False
