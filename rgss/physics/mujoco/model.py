"""MuJoCo model of scene, arm, hand and workpiece.

Built from the scene, the gripper and the robot's URDF. Except for the ribs of the pads it shares nothing with the
PyBullet world, so that an error in the construction of either shows as a difference. The links of a gripper's linkage
are those of the URDF that both engines read.

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

from rgss.errors import SimulationError
from rgss.physics.mujoco.followers import add_clutch
from rgss.physics.mujoco.hand_model import (
    CUP_BIT,
    GEAR_IMPEDANCE,
    GRIPPER_BASE,
    MACHINE,
    HandModel,
    HandParts,
    add_bond,
    add_hand,
    add_linkage_drive,
    finger_of_linkage_link,
)
from rgss.physics.mujoco.mjcf import add_body, add_geom, add_inertial, number, numbers
from rgss.physics.mujoco.robot_links import RobotLink, read_links
from rgss.physics.mujoco.solids import object_solids
from rgss.physics.settings import PhysicsSettings
from rgss.scenes import Gripper, Pose, Scene, Workpiece, assembled_urdf, centre_of_mass, finger_pads, inertia_kg_m2

WORKPIECE = "workpiece"

_SCENE = (2, 1)
_IMPEDANCE = "0.95 0.99 0.0001"


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldModel:
    """MuJoCo model with the names of its parts.

    Attributes:
        text: The model as MJCF.
        fingers: Names of the sliding fingers' joints, shared by their bodies and motors; empty for other grippers.
        pressing: Number of fingers, or 1 for a suction cup.
        finger_shapes: Index of the finger by the name of a shape of it; that of a suction cup is 0.
        linkage_joints: Name of the joint of each link of a gripper's linkage by the index of the link.
        scene_bodies: Id of the scene's body by the name of its shape.
        links: Name of the robot's link by the name of a shape, without the fingers.
        object_bodies: Name of the body of each object.
        object_shapes: Id of the object by the name of a shape of it.
    """

    text: str
    fingers: tuple[str, ...]
    pressing: int
    finger_shapes: Mapping[str, int]
    linkage_joints: Mapping[int, str]
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
        fingers=builder.hand.joints,
        pressing=max(1, gripper.geometry.fingers),
        finger_shapes=builder.finger_shapes,
        linkage_joints=builder.hand.linkage_joints,
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
        self.hand = HandModel()
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
            # The load of a suction cup is read from the rows of its bond.
            "jacobian": "dense" if gripper.suction is not None else "auto",
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
        robot, geometry = self._scene.robot, self._gripper.geometry
        pads = finger_pads(self._scene, geometry)
        is_linkage = geometry.linkage is not None
        urdf = assembled_urdf(robot, self._gripper, pads=pads) if is_linkage else robot.urdf
        parents: dict[str, ET.Element] = {}
        for link in read_links(urdf):
            parent = parents[link.parent] if link.parent else self._world
            parents[link.name] = self._add_link(parent, link, link.pose if link.parent else robot.base @ link.pose)
        for joint in robot.joints:
            limit = number(joint.torque_n_m)
            motor = {"name": joint.name, "joint": joint.name, "forcerange": f"-{limit} {limit}"}
            ET.SubElement(self._actuator, "motor", motor)
        for follower in robot.followers:
            coupling = {
                "name": follower.name,
                "joint1": follower.name,
                "joint2": robot.joints[follower.driver].name,
                "polycoef": f"{number(follower.offset)} {number(follower.multiplier)} 0 0 0",
                # The shortest time constant that the engine allows.
                "solref": f"{number(2 * self._settings.step_s)} 1",
                "solimp": GEAR_IMPEDANCE,
            }
            ET.SubElement(self._equality, "joint", coupling)
            if math.isfinite(follower.effort):
                add_clutch(self.root, follower, robot.joints[follower.driver].name)
        parts = HandParts(equality=self._equality, actuator=self._actuator, stiffness=self._stiffness)
        if geometry.linkage is not None:
            self.hand = add_linkage_drive(parts, geometry.linkage, parents, step_s=self._settings.step_s)
            finger_of_link = finger_of_linkage_link(geometry.linkage)
            named = {name: finger_of_link[link] for name, link in self.links.items() if link in finger_of_link}
            self.finger_shapes.update(named)
            self.links = {name: link for name, link in self.links.items() if name not in named}
            return
        self.hand = add_hand(parts, parents[robot.flange], self._gripper, pads, step_s=self._settings.step_s)
        self.links[GRIPPER_BASE] = GRIPPER_BASE
        self.finger_shapes.update(self.hand.finger_shapes)

    def add_objects(self) -> None:
        """Add each object as a free body, with a contact pair for each of its shapes and any other shape.

        By default the engine uses the greater of both bodies' friction coefficients, the trials use their product; a
        pair has its own coefficient.
        """
        # Contact of an object with any other part of the machine ends the trial, so its friction is irrelevant.
        frictions = dict.fromkeys(self.links, 0.0)
        if self._gripper.geometry.cup is None:
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
            add_geom(body, names[-1], shape, at, touches=(0, CUP_BIT if self._gripper.geometry.cup is not None else 0))
        self.object_bodies[workpiece.id] = body_name
        self.object_shapes.update(dict.fromkeys(names, workpiece.id))
        if self._gripper.geometry.cup is not None:
            add_bond(self._equality, body_name, self._stiffness)
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
            add_geom(body, name, shape, at, touches=MACHINE)
        if link.joint:
            kind = {"type": "slide"} if link.is_prismatic else {}
            ET.SubElement(body, "joint", {"name": link.joint, "axis": numbers(link.axis), **kind})
        return body
