"""The frame of the last link that carries a gripper, and notes on a choice among several."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterator, Mapping, Sequence

from rgss.scenes import end_of, origin_of
from rgss.studies.robot_project.urdf.reading import Note

_SEEING = ("camera", "optical", "depth", "lidar", "laser", "imu_")
"""Words of frames of sensors, at which no gripper is mounted."""

_ENDING = ("flange", "tool", "tcp", "effector", "eef", "ee_link")
"""Words of the frame that carries a gripper, where the last link has several."""


def last_frame(root: ET.Element, below: Mapping[str, list[ET.Element]], link: str) -> str:
    """The last frame on a link, of several the one that is named for what carries a gripper; none of a sensor.

    Args:
        root: The URDF.
        below: Joints of each link.
        link: A link on which nothing moves.
    """
    while frames := _frames(root, below, link):
        named = [end_of(joint, "child") for joint in frames if _is_named(end_of(joint, "child"), _ENDING)]
        link = named[0] if named else end_of(frames[0], "child")
    return link


def notes_of_frames(root: ET.Element, below: Mapping[str, list[ET.Element]], end: str) -> Iterator[Note]:
    """A note where the frame at which the arm ends is one of several that differ, and none has the name of a flange.

    Args:
        root: The URDF.
        below: Joints of each link.
        end: The link at which the arm ends.
    """
    parent = next((link for link, ways in below.items() if any(end_of(way, "child") == end for way in ways)), "")
    frames = _frames(root, below, parent)
    names = [end_of(joint, "child") for joint in frames]
    if end not in names or any(_is_named(name, _ENDING) for name in names):
        return
    if all(origin_of(joint) == origin_of(frames[0]) for joint in frames):
        return
    others = " or ".join(f"--flange {name}" for name in names if name != end)
    rationale = (
        f"The gripper is mounted at {end}, the first of {len(names)} frames on {parent} of which none is named for a "
        f"flange or a tool: with {others} it is mounted at another."
    )
    yield Note(about="flange", rationale=rationale)


def _frames(root: ET.Element, below: Mapping[str, list[ET.Element]], link: str) -> list[ET.Element]:
    """Joints of the frames on a link, without those of sensors."""
    return [
        joint
        for joint in below.get(link, ())
        if not _has_shape(root, end_of(joint, "child")) and not _is_named(end_of(joint, "child"), _SEEING)
    ]


def _is_named(link: str, words: Sequence[str]) -> bool:
    return any(word in link.casefold() for word in words)


def _has_shape(root: ET.Element, name: str) -> bool:
    return any(
        link.get("name") == name and (link.find("collision") is not None or link.find("visual") is not None)
        for link in root.findall("link")
    )
