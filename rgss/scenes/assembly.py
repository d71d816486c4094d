"""One URDF for arm and gripper, so that every engine is given the same machine."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET

from rgss.scenes.gripper import Gripper
from rgss.scenes.pose import Pose
from rgss.scenes.robot import Robot

GRIPPER_BASE_LINK = "gripper_base"


def finger_link(finger: int) -> str:
    """Name of a finger's link, its index from 0."""
    return f"finger_{finger + 1}"


def finger_joint(finger: int) -> str:
    """Name of a finger's prismatic joint, its index from 0; it is zero when open and grows on closing."""
    return f"finger_{finger + 1}_joint"


def assembled_urdf(robot: Robot, gripper: Gripper) -> str:
    """The arm's URDF with the gripper on its flange.

    The base is a solid cylinder and each finger a solid box of the design's masses; each finger
    slides along its azimuth from open (0) to closed (the stroke).

    Args:
        robot: The arm; its URDF was checked when it was read.
        gripper: The gripper as the design has it.
    """
    root = ET.fromstring(robot.urdf)  # noqa: S314 - entities and document types are refused on reading
    geometry = gripper.geometry
    radius, height = geometry.base.radius_m, geometry.base.height_m
    across = gripper.base_mass_kg * (3 * radius**2 + height**2) / 12
    _add_link(
        root,
        name=GRIPPER_BASE_LINK,
        mass_kg=gripper.base_mass_kg,
        inertia=(across, across, gripper.base_mass_kg * radius**2 / 2),
        centre=geometry.base_pose,
        shape=("cylinder", {"radius": _number(radius), "length": _number(height)}),
    )
    _add_joint(root, name="gripper_joint", kind="fixed", parent=robot.flange, child=GRIPPER_BASE_LINK, origin=Pose())
    x, y, z = geometry.finger.size_m
    mass = gripper.finger_mass_kg
    for finger, azimuth in enumerate(geometry.azimuths_rad):
        _add_link(
            root,
            name=finger_link(finger),
            mass_kg=mass,
            inertia=(mass * (y**2 + z**2) / 12, mass * (x**2 + z**2) / 12, mass * (x**2 + y**2) / 12),
            centre=Pose(),
            shape=("box", {"size": f"{_number(x)} {_number(y)} {_number(z)}"}),
        )
        joint = _add_joint(
            root,
            name=finger_joint(finger),
            kind="prismatic",
            parent=GRIPPER_BASE_LINK,
            child=finger_link(finger),
            origin=geometry.finger_pose(finger, geometry.largest_opening_m),
            yaw_rad=azimuth,
        )
        ET.SubElement(joint, "axis", {"xyz": "-1 0 0"})
        ET.SubElement(
            joint,
            "limit",
            {
                "lower": "0",
                "upper": _number(geometry.stroke_m),
                "velocity": _number(gripper.finger_velocity_m_s),
                "effort": _number(gripper.finger_force_n),
            },
        )
    return ET.tostring(root, encoding="unicode")


def _add_link(
    root: ET.Element,
    *,
    name: str,
    mass_kg: float,
    inertia: tuple[float, float, float],
    centre: Pose,
    shape: tuple[str, dict[str, str]],
) -> None:
    link = ET.SubElement(root, "link", {"name": name})
    inertial = ET.SubElement(link, "inertial")
    _add_origin(inertial, centre, 0.0)
    ET.SubElement(inertial, "mass", {"value": _number(mass_kg)})
    xx, yy, zz = (_number(value) for value in inertia)
    ET.SubElement(inertial, "inertia", {"ixx": xx, "iyy": yy, "izz": zz, "ixy": "0", "ixz": "0", "iyz": "0"})
    for element in ("collision", "visual"):
        part = ET.SubElement(link, element)
        _add_origin(part, centre, 0.0)
        ET.SubElement(ET.SubElement(part, "geometry"), shape[0], shape[1])


def _add_joint(
    root: ET.Element, *, name: str, kind: str, parent: str, child: str, origin: Pose, yaw_rad: float = 0.0
) -> ET.Element:
    joint = ET.SubElement(root, "joint", {"name": name, "type": kind})
    _add_origin(joint, origin, yaw_rad)
    ET.SubElement(joint, "parent", {"link": parent})
    ET.SubElement(joint, "child", {"link": child})
    return joint


def _add_origin(element: ET.Element, pose: Pose, yaw_rad: float) -> None:
    xyz = " ".join(_number(value) for value in pose.position_m)
    ET.SubElement(element, "origin", {"xyz": xyz, "rpy": f"0 0 {_number(math.remainder(yaw_rad, math.tau))}"})


def _number(value: float) -> str:
    return repr(float(value))
