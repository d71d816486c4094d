"""Mimic joints within the arm of a URDF, and the limits that they impose on their drivers."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from rgss.scenes.joints.follower import Follower
from rgss.scenes.joints.joint import Joint
from rgss.scenes.joints.joint_kind import JointKind
from rgss.scenes.joints.mimic import Problem, driver_of, follows, mimic_problems


@dataclass(frozen=True, slots=True, kw_only=True)
class DriverLimits:
    """Limits of a driven joint that keep its followers within those of the URDF, infinite where there are none.

    Attributes:
        lower: Lower end of its range in rad or m.
        upper: Upper end.
        speed: Greatest speed in rad/s or m/s.
    """

    lower: float = -math.inf
    upper: float = math.inf
    speed: float = math.inf

    def joint(self, joint: Joint) -> Joint:
        """The driven joint within these limits; its range may be empty."""
        lower, upper = max(joint.lower_rad, self.lower), min(joint.upper_rad, self.upper)
        return replace(joint, lower_rad=lower, upper_rad=upper, speed_rad_s=min(joint.speed_rad_s, self.speed))


def driven_of(moving: Iterable[ET.Element]) -> tuple[ET.Element, ...]:
    """Those of the movable joints of a chain that follow no other one."""
    return tuple(one for one in moving if one.find("mimic") is None)


def follower_problems(
    moving: Iterable[ET.Element], joints: Mapping[str, ET.Element], driven: Sequence[str], frozen: Collection[str]
) -> Iterable[Problem]:
    """Problems of the mimic joints of an arm: message, location in the robot file, hint.

    Args:
        moving: The movable joints from the base to the flange that are not frozen.
        joints: All joints of the URDF by name.
        driven: Names of those joints that follow no other one.
        frozen: Names of the frozen joints.
    """
    names = [joint.get("name", "") for joint in moving if joint.find("mimic") is not None]
    problems = list(mimic_problems(_with_followed(names, joints), joints))
    if problems:
        yield from problems
        return
    for name in names:
        driver = driver_of(name, joints)
        if driver not in driven and driver not in frozen:
            yield (
                f"lets the joint {name!r} of the arm follow {driver!r}, which is not between its base and its flange",
                ("description",),
                f"list {name!r} under 'frozen', or let it follow {' or '.join(driven) or 'a joint of the arm'}",
            )


def followers_of(
    moving: Iterable[ET.Element],
    joints: Mapping[str, ET.Element],
    driven: Sequence[str],
    kinds: Mapping[str, JointKind],
) -> tuple[Follower, ...]:
    """The mimic joints of an arm whose driver moves, from the base to the flange.

    Args:
        moving: The movable joints from the base to the flange that are not frozen.
        joints: All joints of the URDF by name, without problems.
        driven: Names of the joints of the arm.
        kinds: Kind of each joint.
    """
    found = []
    for joint in moving:
        name = joint.get("name", "")
        if joint.find("mimic") is None or (driver := driver_of(name, joints)) not in driven:
            continue
        multiplier, offset = follows(name, joints)
        effort = _limit(joint, "effort")
        found.append(
            Follower(
                name=name,
                driver=driven.index(driver),
                multiplier=multiplier,
                offset=offset,
                effort=effort if effort > 0.0 else math.inf,
                kind=kinds[name],
            )
        )
    return tuple(found)


def driver_limits(driver: str, followers: Iterable[str], joints: Mapping[str, ET.Element]) -> DriverLimits:
    """Limits of a driven joint that keep its followers within theirs.

    Args:
        driver: The driven joint.
        followers: Names of joints with ``<mimic>``; those of other drivers are left out.
        joints: All joints of the URDF by name.
    """
    found = DriverLimits()
    for name in followers:
        if driver_of(name, joints) != driver:
            continue
        multiplier, offset = follows(name, joints)
        lower, upper = _limit(joints[name], "lower"), _limit(joints[name], "upper")
        if joints[name].get("type") != "continuous" and lower < upper:
            ends = sorted((end - offset) / multiplier for end in (lower, upper))
            found = replace(found, lower=max(found.lower, ends[0]), upper=min(found.upper, ends[1]))
        speed = _limit(joints[name], "velocity")
        if speed > 0.0:
            found = replace(found, speed=min(found.speed, speed / abs(multiplier)))
    return found


def _with_followed(names: Sequence[str], joints: Mapping[str, ET.Element]) -> list[str]:
    """Some joints, and those that they follow."""
    found = list(names)
    for name in found:
        mimic = joints[name].find("mimic")
        followed = "" if mimic is None else mimic.get("joint", "")
        if followed in joints and followed not in found:
            found.append(followed)
    return found


def _limit(joint: ET.Element, key: str) -> float:
    limit = joint.find("limit")
    return 0.0 if limit is None else float(limit.get(key, "0"))
