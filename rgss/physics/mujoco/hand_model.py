"""Hand of a MuJoCo model: sliding fingers with motors, a suction cup, or the couplings of a linkage."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from rgss.physics.mujoco.finger_drive import SATURATING_SHARE, is_servo_stable
from rgss.physics.mujoco.mjcf import add_body, add_geom, add_inertial, cylinder_inertia, number
from rgss.physics.mujoco.solids import finger_solids
from rgss.scenes import Gripper, Linkage, PadLayout, Pose, leading_joint, link_names_of

GRIPPER_BASE = "gripper_base"
"""Link, body and shape of the gripper's base."""

MACHINE = (1, 2)
"""Collision filter of the robot's shapes, for contacts without an explicit pair: with the scene, not with itself."""

CUP_BIT = 4
"""Bit of the collision filter by which a suction cup meets objects.

A pair of shapes is in contact at all times, and its filter cannot be changed; that of shapes can.
"""

# The joints of a linkage follow within micrometres, however light its links are.
GEAR_IMPEDANCE = "0.9999 0.9999 0.001"


@dataclass(frozen=True, slots=True, kw_only=True)
class HandParts:
    """Elements of a model to which a hand adds.

    Attributes:
        equality: Couplings.
        actuator: Motors.
        stiffness: Attributes of contacts and joint limits.
    """

    equality: ET.Element
    actuator: ET.Element
    stiffness: Mapping[str, str]


@dataclass(frozen=True, slots=True, kw_only=True)
class HandModel:
    """Names of the parts of a hand.

    Attributes:
        joints: Joints of sliding fingers, shared by their bodies and motors.
        finger_shapes: Index of the finger by the name of a shape of it; that of a suction cup is 0.
        linkage_joints: Name of the joint of each link of a linkage by the index of the link.
    """

    joints: tuple[str, ...] = ()
    finger_shapes: Mapping[str, int] = field(default_factory=dict)
    linkage_joints: Mapping[int, str] = field(default_factory=dict)


def add_hand(
    parts: HandParts, flange: ET.Element, gripper: Gripper, pads: Sequence[PadLayout], *, step_s: float
) -> HandModel:
    """Add a rigid base with sliding fingers or a suction cup.

    Args:
        parts: Elements to which motors and couplings are added.
        flange: The element of the flange.
        gripper: The gripper, without a linkage.
        pads: Contact elements of the pad of each finger.
        step_s: Length of a step.
    """
    geometry = gripper.geometry
    base = add_body(flange, GRIPPER_BASE, geometry.base_pose)
    base_kg = gripper.base_mass_kg - gripper.cup_mass_kg
    add_inertial(base, base_kg, cylinder_inertia(geometry.base, base_kg))
    add_geom(base, GRIPPER_BASE, geometry.base, Pose(), touches=MACHINE)
    if geometry.cup is not None:
        cup = add_body(base, "suction_cup", geometry.base_pose.inverse() @ geometry.cup_pose)
        add_inertial(cup, gripper.cup_mass_kg, cylinder_inertia(geometry.cup, gripper.cup_mass_kg))
        add_geom(cup, "suction_cup", geometry.cup, Pose(), touches=(MACHINE[0] | CUP_BIT, MACHINE[1]))
        (shape,) = cup.findall("geom")
        # The contact has the attributes of the shape with the greater priority; the bond sets the friction.
        shape.attrib.update({"priority": "1", "condim": "3", **parts.stiffness})
        return HandModel(finger_shapes={"suction_cup": 0})
    joints = tuple(f"finger:{index}" for index in range(geometry.fingers))
    finger_shapes = _add_fingers(parts, base, gripper, joints, pads, step_s=step_s)
    return HandModel(joints=joints, finger_shapes=finger_shapes)


def _add_fingers(
    parts: HandParts,
    base: ET.Element,
    gripper: Gripper,
    joints: Sequence[str],
    pads: Sequence[PadLayout],
    *,
    step_s: float,
) -> dict[str, int]:
    """Add rigid fingers on prismatic joints, each with a motor; returns the index of the finger of each shape.

    A motor controls speed within a force limit (`MujocoFingerDrive`). Two fingers are coupled to equal travel;
    uncoupled, each would yield to any force along their common axis.
    """
    geometry = gripper.geometry
    x, y, z = geometry.finger.size_m
    inertia = np.diag([y**2 + z**2, x**2 + z**2, x**2 + y**2]) * gripper.finger_mass_kg / 12
    force = number(gripper.finger_force_n)
    gain = gripper.finger_force_n / (SATURATING_SHARE * gripper.finger_velocity_m_s)
    is_servo = is_servo_stable(gripper, step_s)
    shapes: dict[str, int] = {}
    for index, name in enumerate(joints):
        open_pose = geometry.base_pose.inverse() @ geometry.finger_pose(index, geometry.largest_opening_m)
        finger = add_body(base, name, open_pose)
        add_inertial(finger, gripper.finger_mass_kg, inertia)
        for part, (shape, at) in enumerate(finger_solids(geometry, pads[index])):
            shapes[f"{name}:{part}"] = index
            add_geom(finger, f"{name}:{part}", shape, at, touches=MACHINE)
        drive = {"armature": number(gripper.drive.inertia_kg)} if gripper.drive.inertia_kg else {}
        slide = {
            **drive,
            "name": name,
            "type": "slide",
            "axis": "-1 0 0",
            "range": f"0 {number(geometry.stroke_m)}",
            "solreflimit": parts.stiffness["solref"],
            "solimplimit": parts.stiffness["solimp"],
        }
        ET.SubElement(finger, "joint", slide)
        motor = {"name": name, "joint": name, "forcerange": f"-{force} {force}"}
        if is_servo:
            ET.SubElement(parts.actuator, "velocity", {**motor, "kv": number(gain)})
        else:
            ET.SubElement(parts.actuator, "motor", motor)
    if geometry.fingers == 2:
        one, other = joints
        coupling = {"joint1": one, "joint2": other, "polycoef": "0 1 0 0 0", **parts.stiffness}
        ET.SubElement(parts.equality, "joint", coupling)
    return shapes


def add_bond(equality: ET.Element, body: str, stiffness: Mapping[str, str]) -> None:
    """Add the bond of a suction cup and an object, without effect until it is activated.

    Args:
        equality: The element of couplings.
        body: The object's body, whose name the bond has.
        stiffness: Attributes of contacts.
    """
    bond = {"name": body, "body1": "suction_cup", "body2": body, "active": "false", **stiffness}
    ET.SubElement(equality, "weld", bond)


def add_linkage_drive(
    parts: HandParts, linkage: Linkage, bodies: Mapping[str, ET.Element], *, step_s: float
) -> HandModel:
    """Couple the joints of a linkage to its leading joint, give that a motor and the driven one a range.

    Args:
        parts: Elements to which the motor and couplings are added.
        linkage: The mechanism, whose links are in the model.
        bodies: The element of each link by its name.
        step_s: Length of a step.
    """
    names = link_names_of(linkage)
    joints = {index: f"{names[index]}_joint" for index, link in enumerate(linkage.links) if link.kind is not None}
    leader = leading_joint(linkage)
    leading = linkage.links[leader]
    for index, name in joints.items():
        if index == linkage.driven:
            lower, upper = sorted((linkage.opened, linkage.closed))
            (joint,) = bodies[names[index]].findall("joint")
            joint.set("range", f"{number(lower)} {number(upper)}")
            joint.set("solreflimit", parts.stiffness["solref"])
            joint.set("solimplimit", parts.stiffness["solimp"])
        if index == leader:
            continue
        link = linkage.links[index]
        ratio = link.multiplier / leading.multiplier
        coupling = {
            "joint1": name,
            "joint2": joints[leader],
            "polycoef": f"{number(link.offset - ratio * leading.offset)} {number(ratio)} 0 0 0",
            # The shortest time constant that the engine allows.
            "solref": f"{number(2 * step_s)} 1",
            "solimp": GEAR_IMPEDANCE,
        }
        ET.SubElement(parts.equality, "joint", coupling)
    effort, name = number(linkage.effort / abs(leading.multiplier)), joints[leader]
    ET.SubElement(parts.actuator, "motor", {"name": name, "joint": name, "forcerange": f"-{effort} {effort}"})
    return HandModel(linkage_joints=joints)


def finger_of_linkage_link(linkage: Linkage) -> dict[str, int]:
    """Index of the finger by the name of a link that is fixed relative to its pad."""
    names = link_names_of(linkage)
    return {names[part]: finger for finger, parts in enumerate(linkage.finger_parts) for part in parts}
