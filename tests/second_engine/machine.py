"""Scene, arm, hand and cup as a MuJoCo model.

Built from the scene, the gripper and the robot's description alone. Nothing of what the first
engine is given is used, so that a mistake in how those become its world would show.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence

import numpy as np

from rgss.scenes import Box, Cylinder, Gripper, Pose, Scene, Shape

CUP = "cup"
TOOL = "tool"
RAIL = "rail"

# What may touch without a pair of its own: machine and scene, as in the first engine, and neither itself.
_MACHINE, _SCENE = (1, 2), (2, 1)
_ALONE = (0, 0)
# Contacts and stops yield like critically damped springs with a time constant of 4 ms. The blow of a closing finger
# depends on it (12 N at 4 ms and 15 N at 2 ms where 7 N are commanded), what a hand holds does not.
_STIFF = {"solref": "0.004 1", "solimp": "0.95 0.99 0.0001"}
# A finger's motor gives all its force once the finger lags by this share of its speed. With less than F dt / (2 M v),
# which is 0.42 at most here, the finger jumps over the band in a step and closes at a wrong speed.
_SATURATING_SHARE = 0.5
_CARRIAGE_INERTIA_KG_M2 = 1.0


def empty_model(gravity_m_s2: float, *, step_s: float) -> ET.Element:
    """A model without bodies.

    Contacts of this engine are soft, and what is held creeps. Against that its documentation recommends elliptic
    friction cones, the Newton solver, and friction much stiffer than the normal direction (`impratio`): at 100 a cup
    near the limit sinks by 1 µm/s, at 10 by 12 µm/s. The second solver that it offers for what is left
    (`noslip_iterations`) is not needed, and neither changes the limit by as much as 1 %. A line of contact needs its
    two ends, and a face its corners: `multiccd`. Bodies that press with 10 N sink in by 10 µm, so that the contacts
    are computed to nanometres (`ccd_tolerance`): to the default of a micrometre, a contact now and then has a wrong
    normal for a step.
    """
    root = ET.Element("mujoco", {"model": "second-engine"})
    ET.SubElement(root, "compiler", {"angle": "radian", "autolimits": "true"})
    option = ET.SubElement(
        root,
        "option",
        {
            "timestep": _number(step_s),
            "gravity": f"0 0 {_number(-gravity_m_s2)}",
            "integrator": "implicitfast",
            "solver": "Newton",
            "tolerance": "1e-10",
            "cone": "elliptic",
            "impratio": "100",
            "ccd_tolerance": "1e-9",
            "ccd_iterations": "100",
        },
    )
    ET.SubElement(option, "flag", {"multiccd": "enable"})
    for part in ("worldbody", "contact", "equality", "actuator"):
        ET.SubElement(root, part)
    return root


def add_scene(root: ET.Element, scene: Scene) -> None:
    """Put the fixed bodies of a scene into the world."""
    for body in scene.bodies:
        _add_geom(root.find("worldbody"), body.id, body.shape, body.pose, touches=_SCENE)


def add_support(root: ET.Element, name: str) -> None:
    """Put the plane z = 0 into the world, which touches only what it is paired with."""
    ET.SubElement(root.find("worldbody"), "geom", {"name": name, "type": "plane", "size": "1 1 1", **_bits(_ALONE)})


def add_cup(root: ET.Element, shape: Cylinder, mass_kg: float, pose: Pose, frictions: Mapping[str, float]) -> None:
    """Put a solid cylinder into the world, free to move.

    Args:
        root: The model.
        shape: Its shape.
        mass_kg: Its mass.
        pose: Transform of its centre to the world.
        frictions: The coefficient of it and each shape that it may touch. The engine would take the greater one of both
            bodies' coefficients, where the project takes the product; a pair has a coefficient of its own.
    """
    body = _add_body(root.find("worldbody"), CUP, pose)
    ET.SubElement(body, "freejoint")
    _add_inertial(body, mass_kg, _cylinder_inertia(shape, mass_kg))
    _add_geom(body, CUP, shape, Pose(), touches=_ALONE)
    step_s = float(root.find("option").get("timestep"))
    for name, friction in frictions.items():
        sliding = _number(friction)
        ET.SubElement(
            root.find("contact"),
            "pair",
            {
                "geom1": name,
                "geom2": CUP,
                # Sliding friction alone: nothing in the project has coefficients of spinning and rolling, and the first
                # engine's are zero. A twist is withstood by the two ends of each line of contact.
                "condim": "3",
                "friction": f"{sliding} {sliding} 0 0 0",
                **_STIFF,
                # The fastest that the engine allows. Friction has no memory of where a body was gripped, and a body
                # that is carried round a bend lags by half a step of the acceleration: see the test of the slip.
                "solreffriction": f"{_number(2 * step_s)} 1",
            },
        )


def add_hand(root: ET.Element, flange: ET.Element, gripper: Gripper) -> None:
    """Put a gripper on a flange: a solid base and solid fingers on slides, each with a motor.

    A motor drives towards a speed with at most a force. Two fingers are coupled to close by the
    same travel, as in the project; each alone would give way to any force along their common axis.
    """
    geometry = gripper.geometry
    base = _add_body(flange, "gripper_base", geometry.base_pose)
    _add_inertial(base, gripper.base_mass_kg, _cylinder_inertia(geometry.base, gripper.base_mass_kg))
    _add_geom(base, "gripper_base", geometry.base, Pose(), touches=_MACHINE)
    x, y, z = geometry.finger.size_m
    inertia = np.diag([y**2 + z**2, x**2 + z**2, x**2 + y**2]) * gripper.finger_mass_kg / 12
    force = _number(gripper.finger_force_n)
    gain = gripper.finger_force_n / (_SATURATING_SHARE * gripper.finger_velocity_m_s)
    for name in finger_names(gripper):
        index = int(name.rpartition("_")[2])
        open_pose = geometry.base_pose.inverse() @ geometry.finger_pose(index, geometry.largest_opening_m)
        finger = _add_body(base, name, open_pose)
        _add_inertial(finger, gripper.finger_mass_kg, inertia)
        _add_geom(finger, name, geometry.finger, Pose(), touches=_MACHINE)
        ET.SubElement(
            finger,
            "joint",
            {
                "name": name,
                "type": "slide",
                "axis": "-1 0 0",
                "range": f"0 {_number(geometry.stroke_m)}",
                "solreflimit": _STIFF["solref"],
                "solimplimit": _STIFF["solimp"],
            },
        )
        ET.SubElement(
            root.find("actuator"),
            "velocity",
            {"name": name, "joint": name, "kv": _number(gain), "forcerange": f"-{force} {force}"},
        )
    if geometry.fingers == 2:
        one, other = finger_names(gripper)
        coupling = {"joint1": one, "joint2": other, "polycoef": "0 1 0 0 0"}
        ET.SubElement(root.find("equality"), "joint", {**coupling, **_STIFF})
    ET.SubElement(flange, "site", {"name": TOOL, **_placed(geometry.grasp_centre)})


def add_arm(root: ET.Element, scene: Scene) -> ET.Element:
    """Put the scene's arm into the world, each joint with a motor of its rated torque; returns the flange."""
    robot = scene.robot
    description = ET.fromstring(robot.urdf)  # noqa: S314 - a file of this repository
    links = {link.get("name"): link for link in description.iter("link")}
    joint_below = {joint.find("parent").get("link"): joint for joint in description.iter("joint")}
    (name,) = set(links) - {joint.find("child").get("link") for joint in joint_below.values()}
    body = _add_link(root.find("worldbody"), links[name], robot.base)
    while name != robot.flange:
        joint = joint_below[name]
        name = joint.find("child").get("link")
        body = _add_link(body, links[name], _origin(joint))
        if joint.get("type") == "revolute":
            ET.SubElement(body, "joint", {"name": joint.get("name"), "axis": joint.find("axis").get("xyz")})
    for joint in robot.joints:
        _add_motor(root, joint.name, joint.torque_n_m)
    return body


def add_rail(root: ET.Element, flange: Pose, *, carriage_kg: float, force_n: float) -> ET.Element:
    """Put a carriage on a vertical rail into the world; returns its flange.

    Args:
        root: The model.
        flange: Transform of the flange to the world at the rail's zero, its z pointing down.
        carriage_kg: Mass of the carriage.
        force_n: Greatest force of its motor.
    """
    body = _add_body(root.find("worldbody"), "carriage", flange)
    _add_inertial(body, carriage_kg, np.eye(3) * _CARRIAGE_INERTIA_KG_M2)
    ET.SubElement(body, "joint", {"name": RAIL, "type": "slide", "axis": "0 0 -1"})
    _add_motor(root, RAIL, force_n)
    return body


def finger_names(gripper: Gripper) -> tuple[str, ...]:
    """Names of the fingers' bodies, which are also those of their shapes, joints and motors."""
    return tuple(f"finger_{index}" for index in range(gripper.geometry.fingers))


def machine_shapes(root: ET.Element) -> tuple[str, ...]:
    """Names of the shapes of arm and hand."""
    return tuple(geom.get("name") for geom in root.iter("geom") if geom.get("contype") == str(_MACHINE[0]))


def _add_link(parent: ET.Element, link: ET.Element, pose: Pose) -> ET.Element:
    name = link.get("name")
    body = _add_body(parent, name, pose)
    inertial = link.find("inertial")
    at = _origin(inertial)
    xx, yy, zz, xy, xz, yz = (
        float(inertial.find("inertia").get(key)) for key in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    )
    turn = np.array([at.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]).T
    inertia = turn @ np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) @ turn.T
    _add_inertial(body, float(inertial.find("mass").get("value")), inertia, at.position_m)
    for index, collision in enumerate(link.iter("collision")):
        cylinder = collision.find("geometry/cylinder")
        shape = Cylinder(radius_m=float(cylinder.get("radius")), height_m=float(cylinder.get("length")))
        _add_geom(body, f"{name}_{index}", shape, _origin(collision), touches=_MACHINE)
    return body


def _add_body(parent: ET.Element, name: str, pose: Pose) -> ET.Element:
    return ET.SubElement(parent, "body", {"name": name, **_placed(pose)})


def _add_inertial(
    body: ET.Element, mass_kg: float, inertia: np.ndarray, centre_m: Sequence[float] = (0.0, 0.0, 0.0)
) -> None:
    entries = [inertia[row, column] for row, column in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    attributes = {"pos": _numbers(centre_m), "mass": _number(mass_kg), "fullinertia": _numbers(entries)}
    ET.SubElement(body, "inertial", attributes)


def _add_geom(parent: ET.Element, name: str, shape: Shape, pose: Pose, *, touches: tuple[int, int]) -> None:
    if isinstance(shape, Box):
        kind, size = "box", [edge / 2 for edge in shape.size_m]
    else:
        kind, size = "cylinder", [shape.radius_m, shape.half_height_m]
    attributes = {"name": name, "type": kind, "size": _numbers(size)}
    ET.SubElement(parent, "geom", {**attributes, **_bits(touches), **_placed(pose)})


def _add_motor(root: ET.Element, joint: str, limit: float) -> None:
    bound = _number(limit)
    ET.SubElement(root.find("actuator"), "motor", {"name": joint, "joint": joint, "forcerange": f"-{bound} {bound}"})


def _bits(touches: tuple[int, int]) -> dict[str, str]:
    own, others = touches
    return {"contype": str(own), "conaffinity": str(others)}


def _cylinder_inertia(shape: Cylinder, mass_kg: float) -> np.ndarray:
    across = mass_kg * (3 * shape.radius_m**2 + shape.height_m**2) / 12
    return np.diag([across, across, mass_kg * shape.radius_m**2 / 2])


def _origin(element: ET.Element) -> Pose:
    origin = element.find("origin")
    x, y, z = (float(value) for value in origin.get("xyz").split())
    roll, pitch, yaw = (float(value) for value in origin.get("rpy").split())
    return Pose.from_roll_pitch_yaw((x, y, z), (roll, pitch, yaw))


def _placed(pose: Pose) -> dict[str, str]:
    x, y, z, w = pose.quaternion_xyzw
    return {"pos": _numbers(pose.position_m), "quat": _numbers((w, x, y, z))}


def _numbers(values: Sequence[float]) -> str:
    return " ".join(_number(value) for value in values)


def _number(value: float) -> str:
    return repr(float(value))
