"""Branches of a URDF that follow the arm's own joints, such as the rods of a parallelogram."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Collection, Iterator, Mapping, Sequence

from rgss.scenes import end_of

NO_FINGER = 2
"""Joints in a row from which a branch may be a part of the arm."""

_SPATIAL = 3
"""Joints that bring a hand to a point in space."""

_GRIPPING = ("gripper", "jaw", "finger", "claw")


def without_rods(
    ways: Sequence[ET.Element], below: Mapping[str, list[ET.Element]], joints: Collection[str]
) -> list[ET.Element]:
    """The ways on which something else moves than what follows the arm's joints; all where there is none.

    Joints of the arm are those before the link, and those on a way with two joints in a row, unless it is named for
    what grips: fingers may follow one that has two joints. Beyond three joints a branch that follows each joint of the
    longest one, in their order, is a finger beside a finger: no rod follows the wrist of an arm.

    Args:
        ways: Joints of one link that move, or lead to one that does.
        below: Joints of each link.
        joints: Names of the joints from the base to the link.
    """
    kept = [way for way in ways if not _is_rod(way, below, joints)]
    longest = max(kept, key=lambda way: joints_in_a_row(way, below), default=None)
    if longest is None or joints_in_a_row(longest, below) < NO_FINGER or any(map(grips, _movable(longest, below))):
        return kept or list(ways)
    arm = [*joints, *_movable(longest, below)]
    is_hand = _driven_before(joints, below) >= _SPATIAL
    rods = [way for way in kept if way is not longest and _is_rod(way, below, arm)]
    return [way for way in kept if way not in rods or (is_hand and _mirrors(way, longest, below))]


def _driven_before(joints: Collection[str], below: Mapping[str, list[ET.Element]]) -> int:
    """Number of the driven joints among some."""
    each = (joint for ways in below.values() for joint in ways if joint.get("name") in joints)
    return sum(joint.get("type") != "fixed" and joint.find("mimic") is None for joint in each)


def _mirrors(way: ET.Element, longest: ET.Element, below: Mapping[str, list[ET.Element]]) -> bool:
    """Whether the joints of a branch follow those of another one by one."""
    mimics = [one.find("mimic") for one in _movable(way, below).values()]
    return [None if mimic is None else mimic.get("joint") for mimic in mimics] == list(_movable(longest, below))


def grips(name: str) -> bool:
    """Whether a joint is named for what grips."""
    return any(word in name.casefold() for word in _GRIPPING)


def joints_in_a_row(joint: ET.Element, below: Mapping[str, list[ET.Element]]) -> int:
    """Most movable joints that follow each other from a joint on, itself among them; followers do not count."""
    moves = joint.get("type") != "fixed" and joint.find("mimic") is None
    return moves + max((joints_in_a_row(one, below) for one in below.get(end_of(joint, "child"), ())), default=0)


def rods_beside(
    chain: Sequence[ET.Element], below: Mapping[str, list[ET.Element]], hands: Collection[str]
) -> Iterator[str]:
    """Links beside an arm that move with its joints alone, with all that they carry.

    Args:
        chain: Joints from the base to the flange, fixed ones among them.
        below: Joints of each link.
        hands: Links whose place the gripper takes.
    """
    moving = [joint.get("name", "") for joint in chain if joint.get("type") != "fixed"]
    for one in chain:
        for joint in below[end_of(one, "parent")]:
            if joint not in chain and end_of(joint, "child") not in hands and _is_rod(joint, below, moving):
                yield end_of(joint, "child")


def _is_rod(joint: ET.Element, below: Mapping[str, list[ET.Element]], joints: Collection[str]) -> bool:
    """Whether all that moves from a joint on follows the given joints."""
    mimics = {name: one.find("mimic") for name, one in _movable(joint, below).items()}
    return bool(mimics) and all(mimic is not None and mimic.get("joint") in joints for mimic in mimics.values())


def _movable(joint: ET.Element, below: Mapping[str, list[ET.Element]]) -> dict[str, ET.Element]:
    """The movable joints from one on, by name."""
    found = {} if joint.get("type") == "fixed" else {joint.get("name", ""): joint}
    for one in below.get(end_of(joint, "child"), ()):
        found |= _movable(one, below)
    return found
