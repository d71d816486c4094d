"""Links of a robot's URDF in topological order, each after its parent."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from rgss.errors import SimulationError
from rgss.scenes import Box, Cylinder, Pose, Shape, vertices_of

Vector3 = tuple[float, float, float]
Corners = tuple[Vector3, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Capsule:
    """Capsule centred in its frame, with its axis along z.

    Attributes:
        radius_m: Radius of cylinder and hemispheres.
        half_length_m: Half of the cylinder's length.
    """

    radius_m: float
    half_length_m: float


Solid = Shape | Capsule | float
"""A solid of the engine; a number is the radius (m) of a sphere."""

LinkShape = tuple["Solid | Corners", Pose]

_ROUND = frozenset({"cylinder", "sphere", "capsule"})


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotLink:
    """One link of an arm with its joint to the parent.

    Attributes:
        name: Its name.
        parent: Name of the parent link; empty for the base.
        pose: Transform of the link to its parent where the joint is at zero.
        joint: Name of the joint that moves it; empty if it is fixed.
        axis: The joint's axis in the link's frame.
        is_prismatic: True if the joint is prismatic, False if revolute.
        mass_kg: Its mass; 0 if the URDF has none.
        centre_m: Its centre of mass in its frame.
        inertia_kg_m2: Its inertia (3, 3) about the centre of mass, in the axes of its frame.
        shapes: Its collision shapes with the transform of each to its frame; points are the corners of a convex shape.
    """

    name: str
    parent: str
    pose: Pose
    joint: str = ""
    axis: Vector3 = (1.0, 0.0, 0.0)
    is_prismatic: bool = False
    mass_kg: float = 0.0
    centre_m: Vector3 = (0.0, 0.0, 0.0)
    inertia_kg_m2: NDArray[np.float64] = field(default_factory=lambda: np.zeros((3, 3)))
    shapes: tuple[LinkShape, ...] = ()


def read_links(urdf: str) -> tuple[RobotLink, ...]:
    """Links of a URDF that has been validated.

    Raises:
        SimulationError: A collision shape is not a box, cylinder, sphere, capsule or convex mesh.
    """
    root = ET.fromstring(urdf)  # noqa: S314 - entities and document types are refused on reading
    links = {link.get("name", ""): link for link in root.findall("link")}
    below: dict[str, list[ET.Element]] = {}
    for joint in root.findall("joint"):
        below.setdefault(_end(joint, "parent"), []).append(joint)
    carried = {_end(joint, "child") for joints in below.values() for joint in joints}
    waiting = [RobotLink(name=name, parent="", pose=Pose()) for name in links if name not in carried]
    found: list[RobotLink] = []
    while waiting:
        mount = waiting.pop(0)
        found.append(_with_inertia(mount, links[mount.name]))
        waiting += [_mounted(joint) for joint in below.get(mount.name, ())]
    return tuple(found)


def _mounted(joint: ET.Element) -> RobotLink:
    moves = joint.get("type") != "fixed"
    axis = joint.find("axis")
    return RobotLink(
        name=_end(joint, "child"),
        parent=_end(joint, "parent"),
        pose=_origin(joint),
        joint=joint.get("name", "") if moves else "",
        axis=(1.0, 0.0, 0.0) if axis is None else _triple(axis.get("xyz", "1 0 0")),
        is_prismatic=joint.get("type") == "prismatic",
    )


def _with_inertia(mount: RobotLink, link: ET.Element) -> RobotLink:
    mass_kg, centre_m, inertia = 0.0, (0.0, 0.0, 0.0), np.zeros((3, 3))
    inertial = link.find("inertial")
    if inertial is not None:
        mass_kg = float(_required(inertial, "mass").get("value", "0"))
        entries = _required(inertial, "inertia")
        xx, yy, zz, xy, xz, yz = (float(entries.get(key, "0")) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
        at = _origin(inertial)
        centre_m = at.position_m
        turn = np.array([at.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]).T
        inertia = turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
    return RobotLink(
        name=mount.name,
        parent=mount.parent,
        pose=mount.pose,
        joint=mount.joint,
        axis=mount.axis,
        is_prismatic=mount.is_prismatic,
        mass_kg=mass_kg,
        centre_m=centre_m,
        inertia_kg_m2=inertia,
        shapes=tuple((_shape(collision), _origin(collision)) for collision in link.findall("collision")),
    )


def _shape(collision: ET.Element) -> Solid | Corners:
    (form,) = _required(collision, "geometry")
    if form.tag == "box":
        return Box(size_m=_triple(form.get("size", "")))
    if form.tag == "convex":
        return vertices_of(form)
    if form.tag not in _ROUND:
        raise SimulationError(
            f"the second engine does not support the robot's collision shape <{form.tag}>",
            hint="use boxes, cylinders, spheres and capsules",
        )
    radius_m = float(form.get("radius", ""))
    if form.tag == "sphere":
        return radius_m
    length_m = float(form.get("length", ""))
    if form.tag == "capsule":
        return Capsule(radius_m=radius_m, half_length_m=length_m / 2)
    return Cylinder(radius_m=radius_m, height_m=length_m)


def _origin(element: ET.Element) -> Pose:
    origin = element.find("origin")
    if origin is None:
        return Pose()
    return Pose.from_roll_pitch_yaw(_triple(origin.get("xyz", "0 0 0")), _triple(origin.get("rpy", "0 0 0")))


def _end(joint: ET.Element, end: str) -> str:
    return _required(joint, end).get("link", "")


def _required(element: ET.Element, tag: str) -> ET.Element:
    found = element.find(tag)
    if found is None:
        raise LookupError(f"a <{element.tag}> of the robot has no <{tag}>")
    return found


def _triple(text: str) -> Vector3:
    x, y, z = (float(value) for value in text.split())
    return x, y, z
