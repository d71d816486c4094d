"""The arm in a URDF: where it ends, which joints it has, and what hangs on its flange and is not of it."""

from __future__ import annotations

import difflib
import xml.etree.ElementTree as ET
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from rgss.errors import DefinitionError
from rgss.scenes import (
    MOST_JOINTS,
    DriverLimits,
    JointKind,
    chain_to,
    driven_of,
    driver_limits,
    end_of,
    follower_problems,
    kind_of,
)
from rgss.studies.robot_project.urdf.last_frame import last_frame, notes_of_frames
from rgss.studies.robot_project.urdf.reading import Note
from rgss.studies.robot_project.urdf.rods import NO_FINGER, grips, joints_in_a_row, rods_beside, without_rods

_LONGER_BY = 3
"""Joints by which the arm is longer than what else turns on one of its links; fingers of a hand differ by fewer."""

_MOST_NAMES = 3
"""Links that a hint names."""

_DEFAULT_RANGE = (-3.141592653589793, 3.141592653589793)


@dataclass(frozen=True, slots=True, kw_only=True)
class UrdfJoint:
    """A joint of the arm as the URDF has it.

    Attributes:
        name: Its name.
        kind: What its position is.
        lower: Lower end of its range, in rad or m; a continuous joint's is half a turn below zero.
        upper: Upper end.
        speed: Greatest speed in rad/s or m/s; 0 where the URDF has none.
        effort: Greatest torque in N·m, or force in N; 0 where the URDF has none.
        is_unbounded: Whether the range is missing for a joint that is not continuous, half a turn either way assumed.
        whole: Range of the URDF where `lower` and `upper` are those of a part of it; None where they are its own.
    """

    name: str
    kind: JointKind
    lower: float
    upper: float
    speed: float
    effort: float
    is_unbounded: bool = False
    whole: tuple[float, float] | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class UrdfArm:
    """The arm in a URDF.

    Attributes:
        name: The robot's name.
        flange: The link that carries the gripper.
        joints: The arm's joints, from the base to the flange.
        hands: Links on the flange that lead to movable joints, such as a hand: the gripper takes their place.
        rods: Links beside the arm that move with its joints alone, such as the rods of a parallelogram.
        notes: What was assumed about the URDF.
    """

    name: str
    flange: str
    joints: tuple[UrdfJoint, ...]
    hands: tuple[str, ...]
    rods: tuple[str, ...] = ()
    notes: tuple[Note, ...] = ()


def arm_of_urdf(root: ET.Element, *, flange: str | None = None) -> UrdfArm:
    """Find the arm in a URDF: from the base along the only way that leads to movable joints, or by far the longest.

    Args:
        root: The URDF.
        flange: The link that carries the gripper; found where None.

    Raises:
        DefinitionError: There is no arm, or it is not clear where it ends.
    """
    links = [link.get("name", "") for link in root.findall("link")]
    _check_tree(root, links)
    below: dict[str, list[ET.Element]] = {}
    for joint in root.findall("joint"):
        below.setdefault(end_of(joint, "parent"), []).append(joint)
    if flange is not None and flange not in links:
        raise DefinitionError(f"the URDF has no link {flange}", hint=_similar_links(flange, links))
    found = flange if flange is not None else _last_link(root, below)
    chain = chain_to(root, found)
    chained = chain.movable
    moving = driven_of(chained)
    if not 1 <= len(moving) <= MOST_JOINTS:
        raise DefinitionError(
            f"the arm has {len(moving)} movable joints from its base to {found}, and 1 to {MOST_JOINTS} are expected",
            hint="name the link that carries the gripper with --flange",
        )
    for joint in chained:
        if kind_of(joint) is None:
            raise DefinitionError(
                f"the joint {joint.get('name')} is {joint.get('type')}",
                hint="an arm's joints are revolute, continuous or prismatic",
            )
    by_name = {joint.get("name", ""): joint for joint in root.findall("joint")}
    followers = [joint.get("name", "") for joint in chained if joint not in moving]
    for problem, _, hint in follower_problems(chained, by_name, [joint.get("name", "") for joint in moving], ()):
        raise DefinitionError(f"the URDF {problem}", hint=hint)
    hands = [end_of(joint, "child") for joint in _ways(found, below)]
    return UrdfArm(
        name=root.get("name", "") or "arm",
        flange=found,
        joints=tuple(
            _within(_joint(joint), driver_limits(joint.get("name", ""), followers, by_name)) for joint in moving
        ),
        hands=tuple(hands),
        rods=tuple(rods_beside(chain.joints, below, hands)),
        notes=() if flange is not None else tuple(_notes_of_end(root, below, found, moving)),
    )


def _similar_links(name: str, links: Sequence[str]) -> str:
    """Hint with the links whose names are nearest to an unknown one; with the last ones where none is near."""
    cased = {link.casefold(): link for link in links}
    near = difflib.get_close_matches(name.casefold(), list(cased), n=_MOST_NAMES)
    if near:
        return f"did you mean {' or '.join(cased[link] for link in near)}?"
    return f"its last links are {', '.join(links[-_MOST_NAMES:])}"


def _notes_of_end(
    root: ET.Element, below: Mapping[str, list[ET.Element]], found: str, moving: Sequence[ET.Element]
) -> Iterator[Note]:
    """Notes on the choice of the link at which the arm ends."""
    yield from _notes_of_jaw(moving)
    yield from _notes_of_division(found, below)
    yield from notes_of_frames(root, below, found)


def _notes_of_division(flange: str, below: Mapping[str, list[ET.Element]]) -> Iterator[Note]:
    """Branches of different lengths at the end of the arm may be a hand, or the rest of the arm and a camera."""
    link = flange
    while len(ways := _ways(link, below)) == 1:
        link = end_of(ways[0], "child")
    lengths = sorted((joints_in_a_row(joint, below) for joint in ways), reverse=True)
    if not ways or lengths[0] < NO_FINGER or lengths[0] == lengths[1]:
        return
    last = end_of(max(ways, key=lambda joint: joints_in_a_row(joint, below)), "child")
    while below.get(last):
        last = end_of(max(below[last], key=lambda joint: joints_in_a_row(joint, below)), "child")
    rationale = (
        f"The URDF divides at {link}, into branches of {' and '.join(map(str, lengths))} joints in a row, which count"
        f" as a hand: the arm ends before them. With --flange {last} it goes on along the longest."
    )
    yield Note(about="flange", rationale=rationale)


def _notes_of_jaw(moving: Sequence[ET.Element]) -> Iterator[Note]:
    """A last joint that is named for what grips may be that of a jaw."""
    if len(moving) == 1:
        return
    last = moving[-1]
    name = last.get("name", "")
    if grips(name):
        rationale = (
            f"The joint {name} counts as the arm's last, although by its name it may drive a jaw: with "
            f"--flange {end_of(last, 'parent')} the arm ends before it."
        )
        yield Note(about="flange", rationale=rationale)


def _check_tree(root: ET.Element, links: list[str]) -> None:
    """Check that one link carries all others."""
    joints = root.findall("joint")
    for joint in joints:
        for end in ("parent", "child"):
            if end_of(joint, end) not in links:
                raise DefinitionError(
                    f"the joint {joint.get('name')} has the {end} link {end_of(joint, end)!r}, which the URDF has not",
                    hint="is the URDF a part of another one? Name one with all links",
                )
    for kind, names in (("joints", [joint.get("name", "") for joint in joints]), ("links", links)):
        twice = next((name for name, count in Counter(names).items() if count > 1), None)
        if twice is not None:
            raise DefinitionError(f"the URDF has two {kind} of the name {twice!r}", hint="give each a name of its own")
    carried = Counter(end_of(joint, "child") for joint in joints)
    bases = [name for name in links if name not in carried]
    link, parents = max(carried.items(), key=lambda item: item[1], default=("", 0))
    if parents > 1:
        carrying = ", ".join(joint.get("name", "") for joint in joints if end_of(joint, "child") == link)
        raise DefinitionError(
            f"the URDF has a link that {parents} joints carry: {link}, by {carrying}",
            hint="arms are serial: each link has one joint. A parallelogram is described by one of its chains, with "
            "<mimic>; a delta or another parallel robot is not simulated",
        )
    if len(bases) != 1:
        found = f"{len(bases)} links that nothing carries: {', '.join(bases[:4])}" if bases else "a loop of links"
        raise DefinitionError(f"the URDF has {found}", hint="join all links to one base, each by one joint")


def _last_link(root: ET.Element, below: Mapping[str, list[ET.Element]]) -> str:
    carried = {end_of(joint, "child") for joint in root.findall("joint")}
    link = next(link.get("name", "") for link in root.findall("link") if link.get("name") not in carried)
    rigid = [link]
    moved = False
    passed: list[str] = []
    while True:
        ways = without_rods(_ways(link, below), below, passed)
        way = ways[0] if len(ways) == 1 else _longest(ways, below) if moved else None
        if way is not None:
            link = end_of(way, "child")
            passed.append(way.get("name", ""))
            moved = moved or way.get("type") != "fixed"
            rigid = [*rigid, link] if way.get("type") == "fixed" else [link]
            continue
        if ways and not moved:
            names = ", ".join(end_of(joint, "child") for joint in ways)
            raise DefinitionError(
                f"the URDF divides at {link} into {names}, before any joint moves",
                hint="name the link that carries the gripper with --flange",
            )
        break
    if ways:
        # A hand: the arm ends at the last frame before it, or where it is mounted.
        shaped = {one.get("name", "") for one in root.findall("link") if one.find("collision") is not None}
        return next((name for name in reversed(rigid) if name not in shaped), rigid[0])
    return last_frame(root, below, link)


def _ways(link: str, below: Mapping[str, list[ET.Element]]) -> list[ET.Element]:
    """Joints of a link that move, or lead to one that does."""
    return [
        joint
        for joint in below.get(link, ())
        if joint.get("type") != "fixed" or _leads_to_movable(end_of(joint, "child"), below)
    ]


def _longest(ways: list[ET.Element], below: Mapping[str, list[ET.Element]]) -> ET.Element | None:
    """The way on which the arm goes on, beside a head or a camera that turns; None where a hand divides."""
    ways = sorted(ways, key=lambda joint: -joints_in_a_row(joint, below))
    lengths = [joints_in_a_row(joint, below) for joint in ways]
    return ways[0] if len(ways) > 1 and lengths[0] >= lengths[1] + _LONGER_BY else None


def _leads_to_movable(link: str, below: Mapping[str, list[ET.Element]]) -> bool:
    return any(
        joint.get("type") != "fixed" or _leads_to_movable(end_of(joint, "child"), below)
        for joint in below.get(link, ())
    )


def _joint(joint: ET.Element) -> UrdfJoint:
    limit = joint.find("limit")
    values = {} if limit is None else {key: float(value) for key, value in limit.attrib.items()}
    kind = kind_of(joint) or JointKind.REVOLUTE
    bounded = joint.get("type") != "continuous" and values.get("lower", 0.0) < values.get("upper", 0.0)
    lower, upper = (values["lower"], values["upper"]) if bounded else _DEFAULT_RANGE
    if not bounded and kind is JointKind.PRISMATIC:
        raise DefinitionError(
            f"the sliding joint {joint.get('name')} has no range", hint="give its lower and upper limit in the URDF"
        )
    return UrdfJoint(
        is_unbounded=not bounded and joint.get("type") != "continuous",
        name=joint.get("name", ""),
        kind=kind,
        lower=lower,
        upper=upper,
        speed=values.get("velocity", 0.0),
        effort=values.get("effort", 0.0),
    )


def _within(joint: UrdfJoint, limits: DriverLimits) -> UrdfJoint:
    """A joint with the limits that keep its followers within theirs."""
    lower, upper = max(joint.lower, limits.lower), min(joint.upper, limits.upper)
    if lower >= upper:
        raise DefinitionError(
            f"no position of the joint {joint.name} has what follows it within its range",
            hint="correct the limits of the URDF, or multiplier and offset of <mimic>",
        )
    speed = min(joint.speed, limits.speed) if joint.speed > 0.0 else joint.speed
    return replace(joint, lower=lower, upper=upper, speed=speed)
