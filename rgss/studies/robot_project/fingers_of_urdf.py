"""Driven joints of a gripper in its URDF: of two that are driven alike one follows; a lacking drive is assumed."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from pathlib import Path

from rgss.scenes import carried_by
from rgss.studies.robot_project.urdf import Note

_FINGERS = 2
# A pad of a crank of 50 mm then has about the speed and the force of one that slides.
_ASSUMED = {
    True: (("velocity", "speed", "0.05 m/s"), ("effort", "force", "40 N")),
    False: (("velocity", "speed", "1 rad/s"), ("effort", "force", "2 N*m")),
}


def complete_fingers(urdf: Path, palm: str | None) -> tuple[Note, ...]:
    """Let one of two fingers that are driven alike follow the other, and complete the drive where the URDF has none.

    Args:
        urdf: The URDF; it is changed.
        palm: The link at the flange; all joints are those of the gripper if None.

    Returns:
        What was assumed.
    """
    root = ET.parse(urdf).getroot()  # noqa: S314 - written by this package
    notes = [*_let_one_finger_follow(_driven(root, palm))]
    notes += _assume_drive(_driven(root, palm))
    if notes:
        urdf.write_text(ET.tostring(root, encoding="unicode") + "\n", encoding="utf-8")
    return tuple(notes)


def _let_one_finger_follow(driven: Sequence[ET.Element]) -> Iterator[Note]:
    """Let the second of two driven joints follow the first if their ranges are equal or mirrored.

    The first then has the effort of both motors, which is what both pads together press with.
    """
    if len(driven) != _FINGERS or driven[0].get("type") != driven[1].get("type"):
        return
    (low, high), other = (_range_of(joint) for joint in driven)
    if low == high or other not in ((low, high), (-high, -low)):
        return
    leader, follower = (joint.get("name", "") for joint in driven)
    ET.SubElement(driven[1], "mimic", {"joint": leader, "multiplier": "1" if other == (low, high) else "-1"})
    rationale = f"The URDF drives {leader} and {follower} alike; {follower} follows {leader} here"
    limits = [limit for joint in driven if (limit := joint.find("limit")) is not None]
    efforts = [float(limit.get("effort", "0")) for limit in limits]
    if len(efforts) == _FINGERS and min(efforts) > 0.0:
        limits[0].set("effort", f"{sum(efforts):.12g}")
        unit = "N" if driven[0].get("type") == "prismatic" else "N*m"
        rationale += f", with the effort of both, {sum(efforts):.6g} {unit}"
    rationale += "."
    yield Note(about="description", rationale=rationale)


def _assume_drive(driven: Sequence[ET.Element]) -> Iterator[Note]:
    """Complete the speed and the effort of a single driven joint."""
    for joint in driven if len(driven) == 1 else ():
        limit, slides = joint.find("limit"), joint.get("type") == "prismatic"
        for key, about, value in _ASSUMED[slides]:
            if limit is not None and float(limit.get(key, "0")) <= 0.0:
                limit.set(key, value.partition(" ")[0])
                name = "speed" if key == "velocity" else "effort"
                yield Note(about=about, rationale=f"The URDF has no {name} of {joint.get('name')}: {value}.")


def _driven(root: ET.Element, palm: str | None) -> list[ET.Element]:
    """Movable joints of a gripper that follow no other."""
    links = None if palm is None else carried_by(root, [palm])
    return [
        joint
        for joint in root.findall("joint")
        if joint.get("type") != "fixed"
        and joint.find("mimic") is None
        and (links is None or ((parent := joint.find("parent")) is not None and parent.get("link") in links))
    ]


def _range_of(joint: ET.Element) -> tuple[float, float]:
    limit = joint.find("limit")
    values = {} if limit is None else limit.attrib
    return float(values.get("lower", "0")), float(values.get("upper", "0"))
