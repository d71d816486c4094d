"""Fingers that a URDF drives alike: one follows the other, since a gripper has one driven joint."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

from rgss.scenes import carried_by
from rgss.studies.robot_project.urdf import Note

_FINGERS = 2


def let_one_finger_follow(urdf: Path, palm: str | None) -> tuple[Note, ...]:
    """Let the second of two driven joints follow the first if their ranges are equal or mirrored.

    Args:
        urdf: The URDF; it is changed.
        palm: The link at the flange; all joints are those of the gripper if None.

    Returns:
        What was assumed.
    """
    root = ET.parse(urdf).getroot()  # noqa: S314 - written by this package
    links = None if palm is None else carried_by(root, [palm])
    driven = [
        joint
        for joint in root.findall("joint")
        if joint.get("type") != "fixed"
        and joint.find("mimic") is None
        and (links is None or ((parent := joint.find("parent")) is not None and parent.get("link") in links))
    ]
    if len(driven) != _FINGERS or driven[0].get("type") != driven[1].get("type"):
        return ()
    (low, high), other = (_range_of(joint) for joint in driven)
    if low == high or other not in ((low, high), (-high, -low)):
        return ()
    leader, follower = (joint.get("name", "") for joint in driven)
    ET.SubElement(driven[1], "mimic", {"joint": leader, "multiplier": "1" if other == (low, high) else "-1"})
    urdf.write_text(ET.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
    rationale = f"The URDF drives {leader} and {follower} alike; {follower} follows {leader} here."
    return (Note(about="description", rationale=rationale),)


def _range_of(joint: ET.Element) -> tuple[float, float]:
    limit = joint.find("limit")
    values = {} if limit is None else limit.attrib
    return float(values.get("lower", "0")), float(values.get("upper", "0"))
