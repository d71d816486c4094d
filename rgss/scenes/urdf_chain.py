"""Serial arm within a URDF: the chain of joints from the base to the flange, with all other joints fixed."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.scenes.document import RobotDocument
from rgss.scenes.findings import Location
from rgss.scenes.joints import Follower, JointKind, driven_of, follower_problems
from rgss.scenes.urdf_structure import (
    MOMENTS,
    axis_of,
    carried_by,
    end_of,
    has_inertia,
    has_moments,
    normalise_axis,
    standing_links,
)

Problem = tuple[str, Location, str]

_KINDS: Mapping[str, JointKind] = {
    "revolute": JointKind.REVOLUTE,
    "continuous": JointKind.REVOLUTE,
    "prismatic": JointKind.PRISMATIC,
}
_NO_MASS_KG, _NO_MOMENT_KG_M2 = 1e-6, 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class UrdfChain:
    """Kinematic chain from the base of a URDF to a link.

    Attributes:
        joints: All joints, including fixed ones, from the base on.
        links: Their child links, in the same order.
    """

    joints: tuple[ET.Element, ...]
    links: tuple[str, ...]

    @property
    def movable(self) -> tuple[ET.Element, ...]:
        """Joints that are not fixed."""
        return tuple(joint for joint in self.joints if joint.get("type") != "fixed")


def chain_to(root: ET.Element, flange: str) -> UrdfChain:
    """Find the chain of joints from the base to a link."""
    above = {end_of(joint, "child"): joint for joint in root.findall("joint")}
    found: list[ET.Element] = []
    links: list[str] = []
    link = flange
    while link in above and link not in links:
        links.append(link)
        found.append(above[link])
        link = end_of(above[link], "parent")
    return UrdfChain(joints=tuple(reversed(found)), links=tuple(reversed(links)))


def kind_of(joint: ET.Element) -> JointKind | None:
    """Kind of a joint of an arm; None for unsupported joints, such as planar ones."""
    return _KINDS.get(joint.get("type", ""))


def chain_problems(root: ET.Element, entry: RobotDocument) -> Iterable[Problem]:
    """Problems of a URDF as the arm of a robot file: message, location in the robot file, hint."""
    links = {link.get("name", "") for link in root.findall("link")}
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    chain = chain_to(root, entry.flange)
    for index, name in enumerate(entry.without):
        if name not in links:
            yield f"has no link {name!r}", ("without", index), "name links of the URDF"
        elif name in chain.links or name not in {end_of(joint, "child") for joint in joints.values()}:
            yield (
                f"needs the link {name!r} to carry the flange",
                ("without", index),
                "list only links that do not belong to the arm",
            )
    for name in entry.frozen:
        if name not in joints:
            yield f"has no joint {name!r}", ("frozen", name), "name the joints as the URDF does"
    moving = unfrozen(chain, entry)
    driven = [joint.get("name", "") for joint in driven_of(moving)]
    wanted = [joint.name for joint in entry.joints]
    is_known = entry.flange in links and all(name in joints for name in wanted) and len({*wanted}) == len(wanted)
    if is_known and driven != wanted:
        following = "" if len(driven) == len(moving) else " besides those that follow them"
        yield (
            f"has from its base to {entry.flange!r} the movable joints {', '.join(driven) or 'none'}{following}",
            ("joints",),
            "list exactly these in this order, or list a joint that must not move under 'frozen'",
        )
    for joint in moving:
        name = joint.get("name", "")
        if kind_of(joint) is None:
            yield (
                f"has the {joint.get('type')} joint {name!r} in the arm",
                ("description",),
                "an arm's joints are revolute, continuous or prismatic",
            )
    yield from follower_problems(moving, joints, driven, tuple(entry.frozen))


def unfrozen(chain: UrdfChain, entry: RobotDocument) -> tuple[ET.Element, ...]:
    """Movable joints of an arm that the robot file does not freeze, with those that follow another one.

    Args:
        chain: The chain from the base to the flange.
        entry: The robot file's content.
    """
    return tuple(joint for joint in chain.movable if joint.get("name", "") not in entry.frozen)


def settle(root: ET.Element, entry: RobotDocument, followers: Sequence[Follower] = ()) -> bool:
    """Reduce a URDF to the arm: the movable joints of the robot file and their followers, all others fixed.

    Links excluded by the robot file are removed with their descendants. Joints off the chain are fixed at the position
    given in the file, at that of their mimic relation, or else as near to zero as their limits allow. A continuous
    joint gets the file's range, a continuous follower what follows from it. Axes become unit vectors. A link that is
    only a frame may lack an inertia.

    Args:
        root: The URDF, which has no problems; modified in place.
        entry: The robot file's content.
        followers: The mimic joints of the arm.

    Returns:
        True if anything was changed.
    """
    changed = _remove(root, entry.without)
    joints = {joint.get("name", ""): joint for joint in root.findall("joint")}
    ranges = {joint.name: tuple(end.value for end in joint.range) for joint in entry.joints}
    for one in followers:
        ranges[one.name] = tuple(sorted(one.multiplier * end + one.offset for end in list(ranges.values())[one.driver]))
    frozen = {name: position.value for name, position in entry.frozen.items()}
    for name, joint in joints.items():
        if joint.get("type") == "fixed":
            continue
        if name not in ranges:
            _fix(joint, _rest_position(joint, joints, frozen))
            changed = True
            continue
        changed = normalise_axis(joint) or changed
        if joint.get("type") == "continuous":
            joint.set("type", "revolute")
            limit = joint.find("limit")
            limit = ET.SubElement(joint, "limit", {"effort": "0", "velocity": "0"}) if limit is None else limit
            lower, upper = ranges[name]
            limit.attrib.update(lower=repr(lower), upper=repr(upper))
            changed = True
    return _complete_inertials(root) or changed


def loads_without_inertia(root: ET.Element) -> tuple[str, ...]:
    """Moving links without a mass or an inertia; pure frames need none."""
    return tuple(
        link.get("name", "")
        for link in root.findall("link")
        if not (has_inertia(link) and has_moments(link))
        and link.get("name") not in standing_links(root)
        and not _is_frame(root, link)
    )


def _remove(root: ET.Element, names: Iterable[str]) -> bool:
    gone = carried_by(root, names)
    for joint in root.findall("joint"):
        if end_of(joint, "child") in gone:
            root.remove(joint)
    for link in root.findall("link"):
        if link.get("name") in gone:
            root.remove(link)
    return bool(gone)


def _rest_position(joint: ET.Element, joints: Mapping[str, ET.Element], frozen: Mapping[str, float]) -> float:
    name = joint.get("name", "")
    if name in frozen:
        return frozen[name]
    mimic = joint.find("mimic")
    driver = joints.get(mimic.get("joint", "")) if mimic is not None else None
    if mimic is not None and driver is not None and driver is not joint:
        followed = _rest_position(driver, {key: one for key, one in joints.items() if key != name}, frozen)
        return float(mimic.get("multiplier", "1")) * followed + float(mimic.get("offset", "0"))
    limit = joint.find("limit")
    if limit is None or joint.get("type") == "continuous":
        return 0.0
    return min(max(0.0, float(limit.get("lower", "0"))), float(limit.get("upper", "0")))


def _fix(joint: ET.Element, position: float) -> None:
    kind = kind_of(joint)
    joint.set("type", "fixed")
    if position == 0.0 or kind is None:
        return
    direction = np.array(axis_of(joint))
    origin = joint.find("origin")
    origin = ET.SubElement(joint, "origin") if origin is None else origin
    at, turn = np.array(_triple(origin.get("xyz", "0 0 0"))), _rotation(_triple(origin.get("rpy", "0 0 0")))
    if kind is JointKind.PRISMATIC:
        at = at + turn @ direction * position
    else:
        turn = turn @ _about(direction, position)
    origin.set("xyz", " ".join(repr(float(value)) for value in at))
    origin.set("rpy", " ".join(repr(value) for value in _roll_pitch_yaw(turn)))


def _complete_inertials(root: ET.Element) -> bool:
    """Remove inertias without a mass from fixed links, and add a negligible one to pure frames."""
    changed, standing = False, standing_links(root)
    for link in root.findall("link"):
        if has_inertia(link):
            continue
        if link.get("name") not in {end_of(joint, "child") for joint in root.findall("joint")}:
            for inertial in link.findall("inertial"):
                link.remove(inertial)
                changed = True
        elif link.get("name") in standing or _is_frame(root, link):
            for inertial in link.findall("inertial"):
                link.remove(inertial)
            inertial = ET.SubElement(link, "inertial")
            ET.SubElement(inertial, "mass", {"value": repr(_NO_MASS_KG)})
            moments = {name: repr(_NO_MOMENT_KG_M2) if name in MOMENTS else "0" for name in MOMENTS}
            ET.SubElement(inertial, "inertia", {**moments, "ixy": "0", "ixz": "0", "iyz": "0"})
            changed = True
    return changed


def _is_frame(root: ET.Element, link: ET.Element) -> bool:
    """True if a link is only a frame: without a collision shape, and fixed to its parent."""
    mounts = [joint for joint in root.findall("joint") if end_of(joint, "child") == link.get("name")]
    return link.find("collision") is None and all(joint.get("type") == "fixed" for joint in mounts)


def _triple(text: str) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in text.split())
    return x, y, z


def _rotation(rpy: tuple[float, float, float]) -> NDArray[np.float64]:
    roll, pitch, yaw = rpy
    x, y, z = np.eye(3)
    return np.asarray(_about(z, yaw) @ _about(y, pitch) @ _about(x, roll))


def _about(axis: NDArray[np.float64], angle: float) -> NDArray[np.float64]:
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross)


def _roll_pitch_yaw(turn: NDArray[np.float64]) -> tuple[float, float, float]:
    pitch = math.atan2(-turn[2, 0], math.hypot(turn[0, 0], turn[1, 0]))
    if math.hypot(turn[0, 0], turn[1, 0]) < 1e-9:
        # Gimbal lock: roll and yaw rotate about the same axis.
        return math.atan2(-turn[1, 2], turn[1, 1]), pitch, 0.0
    return math.atan2(turn[2, 1], turn[2, 2]), pitch, math.atan2(turn[1, 0], turn[0, 0])
