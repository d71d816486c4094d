"""Assembly of arm and gripper into one URDF, the common input of all engines."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from functools import lru_cache

from rgss.scenes.grasps import PadLayout
from rgss.scenes.gripper import Gripper, GripperGeometry
from rgss.scenes.linkage import Linkage, Triple, motion_of
from rgss.scenes.linkage_assembly import add_linkage, linkage_link_names
from rgss.scenes.pose import Pose
from rgss.scenes.robot import Robot
from rgss.scenes.shapes import Box, Cylinder

GRIPPER_BASE_LINK = "gripper_base"
CUP_LINK = "suction_cup"

# Pose of a solid in its link, its roll, its kind and its sizes.
_Part = tuple[Pose, float, str, dict[str, str]]


def finger_link(finger: int) -> str:
    """Name of a finger's link from its index, which starts at 0."""
    return f"finger_{finger + 1}"


def finger_joint(finger: int) -> str:
    """Name of a finger's prismatic joint from its index; its position is 0 when open and increases on closing."""
    return f"finger_{finger + 1}_joint"


def link_names_of(linkage: Linkage) -> tuple[str, ...]:
    """Names of the links of a gripper's linkage in the URDF of the whole machine."""
    fingers = [finger_link(finger) for finger in range(len(linkage.pads))]
    return linkage_link_names(linkage, GRIPPER_BASE_LINK, fingers)


def linkage_hulls(linkage: Linkage, opening_m: float) -> Iterator[tuple[str, Pose, tuple[Triple, ...]]]:
    """Collision shapes of a linkage: name of the link, its transform to the flange, and corners in the link.

    Args:
        linkage: The mechanism.
        opening_m: Distance of its pads from its axis.
    """
    motion = motion_of(linkage)
    poses = linkage.link_poses(motion.driven_at(motion.largest_opening_m - opening_m))
    for name, link, pose in zip(link_names_of(linkage), linkage.links, poses, strict=True):
        for corners in link.hulls_m:
            yield name, pose, corners


@lru_cache(maxsize=16)
def assembled_urdf(
    robot: Robot, gripper: Gripper, *, pads: tuple[PadLayout, ...] = (), has_drives: bool = False
) -> str:
    """URDF of the arm with the gripper on its flange.

    The base is a solid cylinder and each finger a solid box of the design's masses; each finger slides along its
    azimuth from open (0) to closed (the stroke).

    Args:
        robot: The arm, with a validated URDF.
        gripper: The gripper of the design.
        pads: Contact elements of the pad of each finger, flat by default; the visual shape is always flat.
        has_drives: True to add the reflected inertia of its drive to each finger and subtract it from the base's mass.
    """
    root = ET.fromstring(robot.urdf)  # noqa: S314 - entities and document types are refused on reading
    geometry = gripper.geometry
    if geometry.linkage is not None:
        names = link_names_of(geometry.linkage)
        add_linkage(root, gripper, geometry.linkage, flange=robot.flange, names=names, pads=pads)
        return ET.tostring(root, encoding="unicode")
    radius, height = geometry.base.radius_m, geometry.base.height_m
    drive_kg = gripper.drive.inertia_kg if has_drives else 0.0
    base_kg = gripper.base_mass_kg - geometry.fingers * drive_kg - gripper.cup_mass_kg
    across = base_kg * (3 * radius**2 + height**2) / 12
    _add_link(
        root,
        name=GRIPPER_BASE_LINK,
        mass_kg=base_kg,
        inertia=(across, across, base_kg * radius**2 / 2),
        seen=(geometry.base_pose, 0.0, "cylinder", {"radius": _number(radius), "length": _number(height)}),
    )
    _add_joint(root, name="gripper_joint", kind="fixed", parent=robot.flange, child=GRIPPER_BASE_LINK, origin=Pose())
    if geometry.cup is not None:
        _add_cup(root, geometry, geometry.cup, gripper.cup_mass_kg)
    x, y, z = geometry.finger.size_m
    mass = gripper.finger_mass_kg
    for finger, azimuth in enumerate(geometry.azimuths_rad):
        solid = (mass * (y**2 + z**2) / 12, mass * (x**2 + z**2) / 12, mass * (x**2 + y**2) / 12)
        centre, inertia = _with_drive(solid, mass, drive_kg, geometry) if drive_kg else (Pose(), solid)
        _add_link(
            root,
            name=finger_link(finger),
            mass_kg=mass + drive_kg,
            inertia=inertia,
            centre=centre,
            seen=_box(0.0, x, y, z),
            touched=_padded(geometry.finger, pads[finger]) if pads else (),
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


def _add_cup(root: ET.Element, geometry: GripperGeometry, cup: Cylinder, mass_kg: float) -> None:
    """Add a suction cup below the base, with a share of the base's mass."""
    radius, height = cup.radius_m, cup.height_m
    across = mass_kg * (3 * radius**2 + height**2) / 12
    _add_link(
        root,
        name=CUP_LINK,
        mass_kg=mass_kg,
        inertia=(across, across, mass_kg * radius**2 / 2),
        seen=(Pose(), 0.0, "cylinder", {"radius": _number(radius), "length": _number(height)}),
    )
    _add_joint(
        root,
        name="suction_cup_joint",
        kind="fixed",
        parent=GRIPPER_BASE_LINK,
        child=CUP_LINK,
        origin=geometry.cup_pose,
    )


def _with_drive(
    solid: tuple[float, float, float], finger_kg: float, drive_kg: float, geometry: GripperGeometry
) -> tuple[Pose, tuple[float, float, float]]:
    """Centre of mass and central moments of an open finger with a point mass for its drive.

    The point mass is in the middle of the base, from which its mass is subtracted. The distance along z is considered;
    the products of inertia due to the distance along x are neglected.
    """
    pose = geometry.finger_pose(0, geometry.largest_opening_m)
    depth_m = geometry.base.height_m / 2 - pose.position_m[2]
    inward_m = -(geometry.largest_opening_m + geometry.finger.size_m[0] / 2)
    share = drive_kg / (finger_kg + drive_kg)
    reduced_kg = finger_kg * share
    xx, yy, zz = solid
    moments = (
        xx + reduced_kg * depth_m**2,
        yy + reduced_kg * (depth_m**2 + inward_m**2),
        zz + reduced_kg * inward_m**2,
    )
    return Pose(position_m=(share * inward_m, 0.0, share * depth_m)), moments


def _box(along_m: float, x: float, y: float, z: float) -> _Part:
    return Pose(position_m=(along_m, 0.0, 0.0)), 0.0, "box", {"size": f"{_number(x)} {_number(y)} {_number(z)}"}


def _padded(finger: Box, pad: PadLayout) -> tuple[_Part, ...]:
    x, y, z = finger.size_m
    parts = [_box(pad.proud_m / 2, x - pad.proud_m, y, z)]
    for element in pad.elements:
        at = Pose(position_m=(pad.radius_m - x / 2, element.across_m, element.height_m))
        sizes = {"radius": _number(pad.radius_m)}
        if element.length_m > 0.0:
            sizes["length"] = _number(element.length_m)
        parts.append((at, math.pi / 2 if element.is_across else 0.0, "capsule" if len(sizes) > 1 else "sphere", sizes))
    return tuple(parts)


def _add_link(
    root: ET.Element,
    *,
    name: str,
    mass_kg: float,
    inertia: tuple[float, float, float],
    seen: _Part,
    touched: Sequence[_Part] = (),
    centre: Pose | None = None,
) -> None:
    """Add a link; collision shape and centre of mass default to those of the visual shape."""
    link = ET.SubElement(root, "link", {"name": name})
    inertial = ET.SubElement(link, "inertial")
    _add_origin(inertial, centre or seen[0], 0.0, 0.0)
    ET.SubElement(inertial, "mass", {"value": _number(mass_kg)})
    xx, yy, zz = (_number(value) for value in inertia)
    ET.SubElement(inertial, "inertia", {"ixx": xx, "iyy": yy, "izz": zz, "ixy": "0", "ixz": "0", "iyz": "0"})
    for element, parts in (("collision", touched or (seen,)), ("visual", (seen,))):
        for pose, roll, shape, sizes in parts:
            part = ET.SubElement(link, element)
            _add_origin(part, pose, roll, 0.0)
            ET.SubElement(ET.SubElement(part, "geometry"), shape, sizes)


def _add_joint(
    root: ET.Element, *, name: str, kind: str, parent: str, child: str, origin: Pose, yaw_rad: float = 0.0
) -> ET.Element:
    joint = ET.SubElement(root, "joint", {"name": name, "type": kind})
    _add_origin(joint, origin, 0.0, yaw_rad)
    ET.SubElement(joint, "parent", {"link": parent})
    ET.SubElement(joint, "child", {"link": child})
    return joint


def _add_origin(element: ET.Element, pose: Pose, roll_rad: float, yaw_rad: float) -> None:
    xyz = " ".join(_number(value) for value in pose.position_m)
    yaw = _number(math.remainder(yaw_rad, math.tau))
    ET.SubElement(element, "origin", {"xyz": xyz, "rpy": f"{_number(roll_rad)} 0 {yaw}"})


def _number(value: float) -> str:
    return repr(float(value))
