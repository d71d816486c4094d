"""Capsules of a URDF, which simulators know and URDF does not, as a cylinder with a sphere at each end."""

from __future__ import annotations

import copy
import xml.etree.ElementTree as ET
from collections.abc import Iterator

from rgss.scenes import Pose


def divide_capsules(root: ET.Element) -> Iterator[str]:
    """Replace the capsules of visual and collision shapes.

    The length of a capsule is that of its cylinder, as in Gazebo and PyBullet.

    Args:
        root: The URDF; modified in place. A capsule whose numbers are none is kept.

    Yields:
        The name of each link with one.
    """
    for link in root.findall("link"):
        found = [
            (shape, capsule)
            for kind in ("visual", "collision")
            for shape in link.findall(kind)
            if (capsule := shape.find("geometry/capsule")) is not None
        ]
        for shape, capsule in found:
            try:
                parts = _parts(shape, float(capsule.get("radius", "")), float(capsule.get("length", "")))
            except ValueError:
                continue
            at = list(link).index(shape)
            link.remove(shape)
            for part in parts:
                link.insert(at, part)
            yield link.get("name", "")


def _parts(shape: ET.Element, radius_m: float, length_m: float) -> tuple[ET.Element, ...]:
    origin = shape.find("origin")
    words = {} if origin is None else origin.attrib
    x, y, z = (float(word) for word in words.get("xyz", "0 0 0").split())
    roll, pitch, yaw = (float(word) for word in words.get("rpy", "0 0 0").split())
    pose = Pose.from_roll_pitch_yaw((x, y, z), (roll, pitch, yaw))
    size = {"radius": repr(radius_m)}
    parts = [_with_geometry(shape, pose.position_m, words.get("rpy", "0 0 0"), "cylinder", size, length_m)]
    for end_m in (-length_m / 2, length_m / 2):
        end = (pose @ Pose(position_m=(0.0, 0.0, end_m))).position_m
        parts.append(_with_geometry(shape, end, "0 0 0", "sphere", size))
    return tuple(parts)


def _with_geometry(
    shape: ET.Element,
    position_m: tuple[float, float, float],
    rpy: str,
    kind: str,
    size: dict[str, str],
    length_m: float | None = None,
) -> ET.Element:
    """A shape with another geometry at another place."""
    found = copy.deepcopy(shape)
    for old in (*found.findall("origin"), *found.findall("geometry")):
        found.remove(old)
    found.attrib.pop("name", None)
    ET.SubElement(found, "origin", {"xyz": " ".join(map(repr, position_m)), "rpy": rpy})
    ET.SubElement(
        ET.SubElement(found, "geometry"), kind, size if length_m is None else {**size, "length": repr(length_m)}
    )
    return found
