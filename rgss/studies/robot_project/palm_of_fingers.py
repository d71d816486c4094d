"""Palm for fingers that a URDF hangs on the last link of the arm itself."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from dataclasses import replace

from rgss.scenes import Pose, origin_of
from rgss.studies.robot_project.urdf import Note, UrdfArm

Triple = tuple[float, float, float]

_LEAST_FINGERS = 2
_MOMENTS = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
_MASS_KG, _MOMENT_KG_M2 = 1.0e-3, 1.0e-7


def with_palm(root: ET.Element, arm: UrdfArm) -> tuple[UrdfArm, tuple[Note, ...]]:
    """Put a link between the flange and its fingers, so that they are a hand which can be taken off.

    Args:
        root: The URDF; modified in place if the arm has such fingers.
        arm: The arm.

    Returns:
        The arm with that link as its only hand, and what was assumed; unchanged if a link that carries fingers is there
        already, or if fewer than two move on the flange.
    """
    on_flange = {
        child.get("link", ""): joint
        for joint in root.findall("joint")
        for parent, child in ((joint.find("parent"), joint.find("child")),)
        if parent is not None and child is not None and parent.get("link") == arm.flange
    }
    moving = [name for name in arm.hands if on_flange[name].get("type") != "fixed"]
    if len(moving) < _LEAST_FINGERS or len(moving) < len(arm.hands):
        return arm, ()
    palm = f"{arm.flange}_palm"
    poses = {name: origin_of(on_flange[name]) for name in moving}
    middle = Pose(position_m=_mean([pose.position_m for pose in poses.values()]))
    link = ET.SubElement(root, "link", {"name": palm})
    inertial = ET.SubElement(link, "inertial")
    ET.SubElement(inertial, "mass", {"value": repr(_MASS_KG)})
    moments = {key: repr(_MOMENT_KG_M2 if key in ("ixx", "iyy", "izz") else 0.0) for key in _MOMENTS}
    ET.SubElement(inertial, "inertia", moments)
    joint = ET.SubElement(root, "joint", {"name": f"{palm}_joint", "type": "fixed"})
    _place(joint, middle)
    ET.SubElement(joint, "parent", {"link": arm.flange})
    ET.SubElement(joint, "child", {"link": palm})
    for name in moving:
        parent = on_flange[name].find("parent")
        if parent is not None:
            parent.set("link", palm)
        _place(on_flange[name], poses[name].relative_to(middle))
    rationale = (
        f"The fingers move on {arm.flange}, a link of the arm: its mass and shape stay with the arm, and a palm of "
        f"{_MASS_KG * 1e3:g} g carries them."
    )
    return replace(arm, hands=(palm,)), (Note(about="description", rationale=rationale),)


def _mean(places_m: Sequence[Triple]) -> Triple:
    x, y, z = (math.fsum(place[axis] for place in places_m) / len(places_m) for axis in range(3))
    return x, y, z


def _place(joint: ET.Element, pose: Pose) -> None:
    origin = joint.find("origin")
    if origin is None:
        origin = ET.SubElement(joint, "origin")
    origin.set("xyz", " ".join(repr(value) for value in pose.position_m))
    origin.set("rpy", " ".join(repr(value) for value in pose.roll_pitch_yaw_rad()))
