"""Links and joints of a gripper's linkage in the assembled URDF."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Sequence

from rgss.scenes.convex_shapes import convex_element
from rgss.scenes.grasps import PadLayout
from rgss.scenes.gripper import Gripper
from rgss.scenes.joints import JointKind
from rgss.scenes.linkage import Linkage, LinkageLink, LinkagePad, Triple
from rgss.scenes.pose import Pose

_MARGIN_M = 1.0e-3
_MARGIN_SHARE = 0.25
_SAME_M = 1.0e-6
# A frame without a mass; engines would assume a default.
_NO_MASS_KG, _NO_MOMENT_KG_M2 = 1e-6, 1e-9
_KINDS = {None: "fixed", JointKind.REVOLUTE: "continuous", JointKind.PRISMATIC: "prismatic"}


def linkage_link_names(linkage: Linkage, palm: str, fingers: Sequence[str]) -> tuple[str, ...]:
    """Unique names of the links of a linkage on an arm, which may have links of the same names.

    Args:
        linkage: The mechanism.
        palm: Name of the link on the flange.
        fingers: Names of the links with the pads.
    """
    special = {pad.link: name for pad, name in zip(linkage.pads, fingers, strict=True)}
    special[0] = palm
    return tuple(special.get(index, f"gripper_{link.name}") for index, link in enumerate(linkage.links))


def linkage_masses_kg(gripper: Gripper, linkage: Linkage) -> tuple[float, ...]:
    """Mass of each link: that of the URDF, scaled to the design's masses of palm and fingers."""
    palm = set(linkage.palm_links)
    moved = gripper.geometry.fingers * gripper.finger_mass_kg / linkage.moved_mass_kg
    still = gripper.base_mass_kg / linkage.palm_mass_kg
    return tuple(link.mass_kg * (still if index in palm else moved) for index, link in enumerate(linkage.links))


def add_linkage(
    root: ET.Element,
    gripper: Gripper,
    linkage: Linkage,
    *,
    flange: str,
    names: Sequence[str],
    pads: Sequence[PadLayout],
) -> None:
    """Add the links and joints of a gripper's linkage to a URDF.

    Mimic joints have no limits of their own; a contact engine couples them.

    Args:
        root: The URDF of the arm; modified in place.
        gripper: The gripper of the design.
        linkage: Its mechanism.
        flange: The parent link of the palm.
        names: Names of the links.
        pads: Contact elements of the pad of each finger; empty for flat pads.
    """
    layouts = {pad.link: (pad, layout) for pad, layout in zip(linkage.pads, pads, strict=True)} if pads else {}
    faces = _faces(linkage, pads) if pads else {}
    masses_kg = linkage_masses_kg(gripper, linkage)
    for index, link in enumerate(linkage.links):
        _add_link(root, link, names[index], masses_kg[index], faces.get(index))
        if index in layouts:
            _add_elements(root[-1], *layouts[index])
        kind = _KINDS[link.kind]
        driven = index == linkage.driven
        if driven and link.kind is JointKind.REVOLUTE:
            kind = "revolute"
        joint = ET.SubElement(root, "joint", {"name": f"{names[index]}_joint", "type": kind})
        _add_origin(joint, link.origin)
        ET.SubElement(joint, "parent", {"link": flange if link.parent < 0 else names[link.parent]})
        ET.SubElement(joint, "child", {"link": names[index]})
        if link.kind is None:
            continue
        ET.SubElement(joint, "axis", {"xyz": _numbers(link.axis)})
        # A range of length zero means no limits.
        lower, upper = sorted((linkage.opened, linkage.closed)) if driven else (0.0, -1.0)
        limits = {"lower": lower, "upper": upper, "velocity": linkage.speed, "effort": linkage.effort}
        ET.SubElement(joint, "limit", {key: repr(float(value)) for key, value in limits.items()})


def _faces(linkage: Linkage, pads: Sequence[PadLayout]) -> dict[int, tuple[Pose, float]]:
    """For each link of a finger the frame of its pad's face in it, and the distance that it stays behind the face."""
    poses = linkage.link_poses(linkage.opened)
    faces: dict[int, tuple[Pose, float]] = {}
    for pad, layout, parts in zip(linkage.pads, pads, linkage.finger_parts, strict=True):
        behind_m = layout.proud_m + min(_MARGIN_M, _MARGIN_SHARE * pad.size_m[0])
        for index in parts:
            frame = pad.frame if index == pad.link else poses[index].inverse() @ poses[pad.link] @ pad.frame
            faces[index] = frame, behind_m
    return faces


def _add_link(root: ET.Element, link: LinkageLink, name: str, mass_kg: float, face: tuple[Pose, float] | None) -> None:
    element = ET.SubElement(root, "link", {"name": name})
    inertial = ET.SubElement(element, "inertial")
    _add_origin(inertial, link.inertial)
    ET.SubElement(inertial, "mass", {"value": repr(mass_kg or _NO_MASS_KG)})
    scale = mass_kg / link.mass_kg if link.mass_kg else 0.0
    keys = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    moments = [value * scale for value in link.inertia_kg_m2]
    if not mass_kg:
        moments = [_NO_MOMENT_KG_M2] * 3 + [0.0] * 3
    ET.SubElement(inertial, "inertia", {key: repr(value) for key, value in zip(keys, moments, strict=True)})
    for hull in link.hulls_m:
        for tag in ("collision", "visual"):
            corners = hull if face is None or tag == "visual" else tuple(_behind(*face, corner) for corner in hull)
            if corners != hull and not any(corner in hull for corner in corners):
                # Nothing but a plane would remain of a layer of the pad.
                continue
            geometry = ET.SubElement(ET.SubElement(element, tag), "geometry")
            geometry.append(convex_element(corners))


def _behind(face: Pose, behind_m: float, corner: Triple) -> Triple:
    """Corner of a finger, moved behind the contact elements of its pad if it would touch before them.

    What lies before the pad's face, such as a hook above it, stays.
    """
    (px, py, pz), (x, y, z) = face.position_m, corner
    dx, dy, dz = face.inverse_rotate((x - px, y - py, z - pz))
    if dx >= behind_m or dx < -_SAME_M:
        return corner
    mx, my, mz = face.rotate((behind_m, dy, dz))
    return px + mx, py + my, pz + mz


def _add_elements(element: ET.Element, pad: LinkagePad, layout: PadLayout) -> None:
    for one in layout.elements:
        collision = ET.SubElement(element, "collision")
        place, roll = (layout.radius_m, one.across_m, one.height_m), math.pi / 2 if one.is_across else 0.0
        _add_origin(collision, pad.frame @ Pose.from_roll_pitch_yaw(place, (roll, 0.0, 0.0)))
        sizes = {"radius": repr(layout.radius_m)}
        if one.length_m > 0.0:
            sizes["length"] = repr(one.length_m)
        shape = "capsule" if len(sizes) > 1 else "sphere"
        ET.SubElement(ET.SubElement(collision, "geometry"), shape, sizes)


def _add_origin(element: ET.Element, pose: Pose) -> None:
    ET.SubElement(element, "origin", {"xyz": _numbers(pose.position_m), "rpy": _numbers(pose.roll_pitch_yaw_rad())})


def _numbers(values: Sequence[float]) -> str:
    return " ".join(repr(float(value)) for value in values)
