"""MuJoCo model of scene, arm, hand and workpiece.

Built from the scene, the gripper and the robot's URDF. Except for the ribs of the pads it shares nothing with the
PyBullet world, so that an error in the construction of either shows as a difference.

Contacts of this engine are soft, and a held object creeps. As a remedy its documentation recommends elliptic friction
cones, the Newton solver, and friction much stiffer than the normal direction (`impratio`): at 100 an object near the
limit sinks by 1 µm/s, at 10 by 12 µm/s. Its second solver for the residual slip (`noslip_iterations`) is not needed,
and neither changes the limit by as much as 1 %. Contact of a face needs several points: `multiccd`. A force of 10 N
penetrates by 10 µm, so contacts are computed to nanometres (`ccd_tolerance`): with the default of a micrometre a
contact occasionally has a wrong normal for one step.
"""

from __future__ import annotations

import itertools
import math
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rgss.errors import SimulationError
from rgss.physics.mujoco.mjcf import add_body, add_geom, add_inertial, cylinder_inertia, number, numbers
from rgss.physics.mujoco.robot_links import RobotLink, read_links
from rgss.physics.mujoco.solids import finger_solids, object_solids
from rgss.physics.settings import PhysicsSettings
from rgss.scenes import Gripper, Pose, Scene, Workpiece, centre_of_mass, finger_pads, inertia_kg_m2

WORKPIECE = "workpiece"

# Collision filter for contacts without an explicit pair: machine with scene, neither with itself.
_MACHINE, _SCENE, _ALONE = (1, 2), (2, 1), (0, 0)
_IMPEDANCE = "0.95 0.99 0.0001"
# A finger's motor gives all its force once the finger lags by this share of its speed. With less than F dt / (2 M v),
# which is 0.42 at most for the reference grippers, the finger jumps over the band in a step and closes wrongly.
_SATURATING_SHARE = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldModel:
    """MuJoCo model with the names of its parts.

    Attributes:
        text: The model as MJCF.
        fingers: Names of the fingers' joints, shared by their bodies and motors.
        finger_shapes: Index of the finger by the name of a shape of it.
        scene_bodies: Id of the scene's body by the name of its shape.
        links: Name of the robot's link by the name of a shape, without the fingers.
        object_bodies: Name of the body of each object.
        object_shapes: Id of the object by the name of a shape of it.
    """

    text: str
    fingers: tuple[str, ...]
    finger_shapes: Mapping[str, int]
    scene_bodies: Mapping[str, str]
    links: Mapping[str, str]
    object_bodies: Mapping[str, str]
    object_shapes: Mapping[str, str]


def world_model(
    scene: Scene, gripper: Gripper, settings: PhysicsSettings, *, contact_time_constant_s: float
) -> WorldModel:
    """MuJoCo model of a scene with its robot, a gripper on the flange, and the objects.

    Args:
        scene: Fixed bodies, workpiece and robot.
        gripper: The gripper.
        settings: Step and solver.
        contact_time_constant_s: Time constant of contacts and joint limits.

    Raises:
        SimulationError: The robot has a shape that the engine does not support, or an object a mass that is not
        positive.
    """
    builder = _Builder(scene, gripper, settings, contact_time_constant_s)
    builder.add_scene()
    builder.add_robot()
    builder.add_objects()
    return WorldModel(
        text=ET.tostring(builder.root, encoding="unicode"),
        fingers=builder.fingers,
        finger_shapes=builder.finger_shapes,
        scene_bodies=builder.scene_bodies,
        links=builder.links,
        object_bodies=builder.object_bodies,
        object_shapes=builder.object_shapes,
    )


class _Builder:
    """Builder that adds the parts of a world to an empty model."""

    def __init__(
        self, scene: Scene, gripper: Gripper, settings: PhysicsSettings, contact_time_constant_s: float
    ) -> None:
        self._scene, self._gripper, self._settings = scene, gripper, settings
        self._stiffness = {
            "solref": f"{number(contact_time_constant_s)} 1",
            "solimp": _IMPEDANCE,
        }
        self.fingers = tuple(f"finger:{index}" for index in range(gripper.geometry.fingers))
        self.finger_shapes: dict[str, int] = {}
        self.scene_bodies: dict[str, str] = {}
        self.links: dict[str, str] = {}
        self.object_bodies: dict[str, str] = {}
        self.object_shapes: dict[str, str] = {}
        self.root = ET.Element("mujoco", {"model": "rgss"})
        ET.SubElement(self.root, "compiler", {"angle": "radian", "autolimits": "true"})
        option = {
            "timestep": number(settings.step_s),
            "gravity": f"0 0 {number(-scene.gravity_m_s2)}",
            "integrator": "implicitfast",
            "solver": "Newton",
            "iterations": str(settings.solver_iterations),
            "tolerance": "1e-10",
            "cone": "elliptic",
            "impratio": "100",
            "ccd_tolerance": "1e-9",
            "ccd_iterations": "100",
        }
        ET.SubElement(ET.SubElement(self.root, "option", option), "flag", {"multiccd": "enable"})
        self._asset, self._world, self._contact, self._equality, self._actuator = (
            ET.SubElement(self.root, part) for part in ("asset", "worldbody", "contact", "equality", "actuator")
        )

    def add_scene(self) -> None:
        """Add the fixed bodies."""
        for body in self._scene.bodies:
            name = f"scene:{body.id}"
            self.scene_bodies[name] = body.id
            add_geom(self._world, name, body.primitive, body.pose, touches=_SCENE)

    def add_robot(self) -> None:
        """Add the arm with a motor of its rated torque at each joint, and the hand on its flange."""
        robot = self._scene.robot
        parents: dict[str, ET.Element] = {}
        for link in read_links(robot.urdf):
            parent = parents[link.parent] if link.parent else self._world
            parents[link.name] = self._add_link(parent, link, link.pose if link.parent else robot.base @ link.pose)
        for joint in robot.joints:
            limit = number(joint.torque_n_m)
            motor = {"name": joint.name, "joint": joint.name, "forcerange": f"-{limit} {limit}"}
            ET.SubElement(self._actuator, "motor", motor)
        self._add_hand(parents[robot.flange])

    def add_objects(self) -> None:
        """Add each object as a free body, with a contact pair for each of its shapes and any other shape.

        By default the engine uses the greater of both bodies' friction coefficients, the trials use their product; a
        pair has its own coefficient.
        """
        # Contact of an object with any other part of the machine ends the trial, so its friction is irrelevant.
        frictions = dict.fromkeys(self.links, 0.0)
        frictions.update(dict.fromkeys(self.finger_shapes, self._gripper.friction))
        scene = {f"scene:{one.id}": one.friction for one in self._scene.bodies}
        for index, one in enumerate(self._scene.objects):
            workpiece = one.workpiece
            names = self._add_object(f"object:{workpiece.id}" if index else WORKPIECE, workpiece)
            touched = {**scene, **frictions}
            for own, (name, friction) in itertools.product(names, touched.items()):
                rolls = workpiece.rolling_resistance_m if name in scene else 0.0
                self._add_pair(name, own, friction * workpiece.friction, rolls)
            frictions.update(dict.fromkeys(names, workpiece.friction))

    def _add_object(self, body_name: str, workpiece: Workpiece) -> list[str]:
        """Add a free body; returns the names of its shapes."""
        if not 0.0 < workpiece.mass_kg < math.inf:
            raise SimulationError(
                f"the mass of the workpiece must be positive, got {workpiece.mass_kg} kg",
                hint="give a mass greater than zero",
            )
        body = add_body(self._world, body_name, workpiece.pose)
        ET.SubElement(body, "freejoint")
        add_inertial(*(body, workpiece.mass_kg, inertia_kg_m2(workpiece)), centre_m=centre_of_mass(workpiece))
        names = []
        for index, (shape, at) in enumerate(object_solids(workpiece.shape)):
            names.append(f"{body_name}:{index}" if index else body_name)
            if isinstance(shape, tuple):
                corners = " ".join(numbers(corner) for corner in shape)
                ET.SubElement(self._asset, "mesh", {"name": names[-1], "vertex": corners})
            add_geom(body, names[-1], shape, at, touches=_ALONE)
        self.object_bodies[workpiece.id] = body_name
        self.object_shapes.update(dict.fromkeys(names, workpiece.id))
        return names

    def _add_pair(self, one: str, other: str, friction: float, rolling_m: float) -> None:
        """Add a contact of two shapes."""
        sliding, rolling = number(friction), number(rolling_m) if rolling_m > 0.0 else "0"
        pair = {
            "geom1": one,
            "geom2": other,
            # Sliding friction only: nothing in a scene has coefficients of spinning and rolling friction. A torque
            # about the normal is resisted by the two ends of each line of contact.
            "condim": "6" if rolling_m > 0.0 else "3",
            "friction": f"{sliding} {sliding} 0 {rolling} {rolling}",
            **self._stiffness,
            # The shortest time constant that the engine allows.
            "solreffriction": f"{number(2 * self._settings.step_s)} 1",
        }
        ET.SubElement(self._contact, "pair", pair)

    def _add_link(self, parent: ET.Element, link: RobotLink, pose: Pose) -> ET.Element:
        body = add_body(parent, f"link:{link.name}", pose)
        if link.mass_kg > 0.0:
            add_inertial(body, link.mass_kg, link.inertia_kg_m2, link.centre_m)
        for index, (shape, at) in enumerate(link.shapes):
            name = f"link:{link.name}:{index}"
            self.links[name] = link.name
            if isinstance(shape, tuple):
                # The engine re-centres a mesh at its centre of mass and compensates that in the geom's placement.
                corners = " ".join(numbers(corner) for corner in shape)
                ET.SubElement(self._asset, "mesh", {"name": name, "vertex": corners})
            add_geom(body, name, shape, at, touches=_MACHINE)
        if link.joint:
            kind = {"type": "slide"} if link.is_prismatic else {}
            ET.SubElement(body, "joint", {"name": link.joint, "axis": numbers(link.axis), **kind})
        return body

    def _add_hand(self, flange: ET.Element) -> None:
        """Add a rigid base and rigid fingers on prismatic joints, each with a motor.

        A motor controls speed within a force limit. Two fingers are coupled to equal travel; uncoupled, each would
        yield to any force along their common axis.
        """
        gripper = self._gripper
        geometry = gripper.geometry
        base = add_body(flange, "gripper_base", geometry.base_pose)
        add_inertial(base, gripper.base_mass_kg, cylinder_inertia(geometry.base, gripper.base_mass_kg))
        self.links["gripper_base"] = "gripper_base"
        add_geom(base, "gripper_base", geometry.base, Pose(), touches=_MACHINE)
        x, y, z = geometry.finger.size_m
        inertia = np.diag([y**2 + z**2, x**2 + z**2, x**2 + y**2]) * gripper.finger_mass_kg / 12
        force = number(gripper.finger_force_n)
        pads = finger_pads(self._scene, geometry)
        gain = gripper.finger_force_n / (_SATURATING_SHARE * gripper.finger_velocity_m_s)
        for index, name in enumerate(self.fingers):
            open_pose = geometry.base_pose.inverse() @ geometry.finger_pose(index, geometry.largest_opening_m)
            finger = add_body(base, name, open_pose)
            add_inertial(finger, gripper.finger_mass_kg, inertia)
            for part, (shape, at) in enumerate(finger_solids(geometry, pads[index])):
                self.finger_shapes[f"{name}:{part}"] = index
                add_geom(finger, f"{name}:{part}", shape, at, touches=_MACHINE)
            drive = {"armature": number(gripper.drive.inertia_kg)} if gripper.drive.inertia_kg else {}
            slide = {
                **drive,
                "name": name,
                "type": "slide",
                "axis": "-1 0 0",
                "range": f"0 {number(geometry.stroke_m)}",
                "solreflimit": self._stiffness["solref"],
                "solimplimit": self._stiffness["solimp"],
            }
            ET.SubElement(finger, "joint", slide)
            motor = {"name": name, "joint": name, "kv": number(gain), "forcerange": f"-{force} {force}"}
            ET.SubElement(self._actuator, "velocity", motor)
        if geometry.fingers == 2:
            one, other = self.fingers
            coupling = {"joint1": one, "joint2": other, "polycoef": "0 1 0 0 0", **self._stiffness}
            ET.SubElement(self._equality, "joint", coupling)
