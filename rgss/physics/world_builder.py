"""Builder of a world in a physics client: parameters, bodies, robot.

Properties of the engine behind this design: the friction of a contact is the product of the two bodies' coefficients;
damping must be set to zero, or falling bodies are slowed; every call names its client.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from rgss.errors import SimulationError
from rgss.physics.bodies import add_body, add_object, links_of
from rgss.physics.engine import load_urdf_text
from rgss.physics.follower_motors import FollowerMotors
from rgss.physics.hands import LinkageDrive, least_iterations
from rgss.physics.settings import PhysicsSettings
from rgss.physics.suction_bond import PyBulletBond
from rgss.physics.suction_seal import SuctionSeal
from rgss.scenes import (
    CUP_LINK,
    Gripper,
    PadLayout,
    Pose,
    Scene,
    SceneObject,
    assembled_urdf,
    finger_joint,
    finger_pads,
    link_names_of,
    most_elements,
    standing_links,
    suction_point_of,
)

_GEAR_FORCE_N = 1.0e4
_FRICTION_RECOVERY = 0.9
_LEAST_FRICTION = 1.0e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class RobotIndex:
    """The engine's ids of the robot's joints and links.

    Attributes:
        arm_joints: Joints of the arm, from the base to the flange.
        finger_joints: Joints of the fingers, which are also the ids of their links.
        finger_of_link: The finger to which a link belongs: those links, and what is fixed relative to a pad.
        flange: Link of the flange.
        cup: Link of the suction cup; None for a gripper with fingers.
        link_names: Name of each link by its id; -1 is the base.
        joints: Id of each joint by its name.
    """

    arm_joints: list[int]
    finger_joints: list[int]
    finger_of_link: Mapping[int, int]
    flange: int
    cup: int | None
    link_names: Mapping[int, str]
    joints: Mapping[str, int]


@dataclass(frozen=True, slots=True, kw_only=True)
class WorldBuilder:
    """Builder of a scene, a workpiece and a robot with its gripper in a physics client.

    Attributes:
        engine: The module of the engine.
        client: The client.
        scene: Fixed bodies, workpiece and robot.
        gripper: The gripper on the robot's flange.
        settings: Step length and solver.
    """

    engine: Any
    client: int
    scene: Scene
    gripper: Gripper
    settings: PhysicsSettings

    def set_parameters(self) -> None:
        """Set gravity, step and solver."""
        engine, client = self.engine, self.client
        engine.setGravity(0.0, 0.0, -self.scene.gravity_m_s2, physicsClientId=client)
        engine.setPhysicsEngineParameter(
            fixedTimeStep=self.settings.step_s,
            numSolverIterations=self.solver_iterations,
            numSubSteps=0,
            # With a residual threshold of zero every iteration runs, and a held object does not creep.
            solverResidualThreshold=0.0,
            # Friction restores this share of a held body's displacement in a step.
            frictionERP=_FRICTION_RECOVERY,
            # Without it the order of contact pairs, and so the last bits of a result, can differ from run to run.
            deterministicOverlappingPairs=1,
            physicsClientId=client,
        )

    @property
    def solver_iterations(self) -> int:
        """Iterations of the solver, at least those that the gears of a linkage need."""
        iterations, linkage = self.settings.solver_iterations, self.gripper.geometry.linkage
        return iterations if linkage is None else max(iterations, least_iterations(linkage))

    def add_scene(self) -> dict[int, str]:
        """Add the fixed bodies; returns their names by id."""
        names = {}
        for body in self.scene.bodies:
            number = add_body(self.engine, self.client, body.primitive, body.pose, 0.0)
            self.engine.changeDynamics(number, -1, lateralFriction=body.friction, physicsClientId=self.client)
            names[number] = body.id
        return names

    def add_objects(self) -> dict[str, tuple[int, Pose]]:
        """Add the workpiece and the other objects; returns the id of each and the transform of its principal axes."""
        return {one.workpiece.id: self._add_object(one) for one in self.scene.objects}

    def _friction_of(self, support: str) -> float:
        """Friction coefficient of a body or an object."""
        frictions = {body.id: body.friction for body in self.scene.bodies}
        frictions |= {one.workpiece.id: one.workpiece.friction for one in self.scene.objects}
        return frictions[support]

    def _add_object(self, one: SceneObject) -> tuple[int, Pose]:
        workpiece = one.workpiece
        if not 0.0 < workpiece.mass_kg < math.inf:
            # A body of zero mass would be static.
            raise SimulationError(
                f"the mass of the workpiece must be positive, got {workpiece.mass_kg} kg",
                hint="give a mass greater than zero",
            )
        body, principal = add_object(self.engine, self.client, workpiece)
        links = links_of(self.engine, self.client, body)
        for link in links:
            self.engine.changeDynamics(
                body,
                link,
                lateralFriction=workpiece.friction,
                linearDamping=0.0,
                angularDamping=0.0,
                frictionAnchor=1,
                activationState=self.engine.ACTIVATION_STATE_DISABLE_SLEEPING,
                physicsClientId=self.client,
            )
        if workpiece.rolling_resistance_m:
            # The engine multiplies the length by the friction of the other body.
            beneath = self._friction_of(one.support)
            length_m = workpiece.rolling_resistance_m / max(beneath, _LEAST_FRICTION)
            for link in links:
                self.engine.changeDynamics(body, link, rollingFriction=length_m, physicsClientId=self.client)
        return body, principal

    @property
    def pads(self) -> tuple[PadLayout, ...]:
        """Contact elements of the pad of each finger."""
        return finger_pads(self.scene, self.gripper.geometry)

    def add_robot(self) -> int:
        """Add the robot with its gripper; returns its id."""
        base, engine, gripper = self.scene.robot.base, self.engine, self.gripper
        drives_kg = gripper.geometry.fingers * gripper.drive.inertia_kg
        if drives_kg and drives_kg >= gripper.base_mass_kg:
            raise SimulationError(
                f"the drives' inertia of {drives_kg:g} kg must be less than the base's mass of "
                f"{gripper.base_mass_kg:g} kg",
                hint="give the gripper's base its mass with the drives, or less drive_inertia",
            )
        return load_urdf_text(
            self.client,
            assembled_urdf(
                self.scene.robot,
                self.gripper,
                pads=self.pads,
                has_drives=True,
            ),
            position=base.position_m,
            orientation=base.quaternion_xyzw,
            flags=engine.URDF_USE_INERTIA_FROM_FILE
            | engine.URDF_USE_IMPLICIT_CYLINDER
            | engine.URDF_IGNORE_VISUAL_SHAPES,
        )

    def index_robot(self, robot: int) -> RobotIndex:
        """The engine's ids of the robot's joints and links."""
        engine, client = self.engine, self.client
        info: list[Any] = [
            engine.getJointInfo(robot, index, physicsClientId=client)
            for index in range(engine.getNumJoints(robot, physicsClientId=client))
        ]
        joints = {entry[1].decode(): entry[0] for entry in info}
        links = {entry[12].decode(): entry[0] for entry in info}
        link_names = {index: name for name, index in links.items()}
        link_names[-1] = engine.getBodyInfo(robot, physicsClientId=client)[0].decode()
        geometry = self.gripper.geometry
        fingers = [joints[finger_joint(finger)] for finger in range(geometry.fingers)]
        finger_of_link = {link: finger for finger, link in enumerate(fingers)}
        if geometry.linkage is not None:
            names = link_names_of(geometry.linkage)
            for finger, parts in enumerate(geometry.linkage.finger_parts):
                finger_of_link |= {links[names[part]]: finger for part in parts}
        return RobotIndex(
            arm_joints=[joints[joint.name] for joint in self.scene.robot.joints],
            finger_joints=fingers,
            finger_of_link=finger_of_link,
            flange=links[self.scene.robot.flange],
            cup=links.get(CUP_LINK),
            link_names=link_names,
            joints=joints,
        )

    def set_robot_dynamics(self, robot: int, index: RobotIndex) -> None:
        """Remove the robot's damping; set the fingers' friction and pad compliance."""
        engine, client = self.engine, self.client
        for link in range(-1, engine.getNumJoints(robot, physicsClientId=client)):
            engine.changeDynamics(
                robot, link, linearDamping=0.0, angularDamping=0.0, jointDamping=0.0, physicsClientId=client
            )
        elements = most_elements(self.pads)
        stiffness_n_m = self.settings.pad_stiffness_n_m / elements
        for link in index.finger_of_link:
            engine.changeDynamics(
                robot,
                link,
                lateralFriction=self.gripper.friction,
                frictionAnchor=1,
                contactStiffness=stiffness_n_m,
                contactDamping=self.settings.pad_damping_n_s_m / elements,
                physicsClientId=client,
            )
        if len(index.finger_joints) == 2 and self.gripper.geometry.linkage is None:
            self._couple_fingers(robot, *index.finger_joints)

    def leave_out_standing_links(self, robot: int, index: RobotIndex, scene_bodies: Iterable[int]) -> None:
        """Let what is fixed to the robot's base touch the scene, as the base does: neither moves.

        The engine leaves out the base itself alone.
        """
        root = ET.fromstring(self.scene.robot.urdf)  # noqa: S314 - entities and document types are refused on reading
        standing = standing_links(root)
        for link, name in index.link_names.items():
            if link < 0 or name not in standing:
                continue
            for body in scene_bodies:
                self.engine.setCollisionFilterPair(robot, body, link, -1, 0, physicsClientId=self.client)

    def follower_motors(self, robot: int, index: RobotIndex, gain: float) -> FollowerMotors:
        """Motors of the arm's followers.

        Args:
            robot: The robot.
            index: Its joints.
            gain: Share of a joint's position error that its motor removes in a step.
        """
        arm, joints = self.scene.robot, index.joints
        return FollowerMotors(self.engine, self.client, robot, arm, joints, gain=gain, step_s=self.settings.step_s)

    def linkage_drive(self, robot: int, index: RobotIndex) -> LinkageDrive | None:
        """Drive of a gripper's linkage; None for sliding fingers and for a cup."""
        linkage = self.gripper.geometry.linkage
        if linkage is None:
            return None
        return LinkageDrive(self.engine, self.client, robot, linkage, index.joints, step_s=self.settings.step_s)

    def seal(self, robot: int, index: RobotIndex, body: int, scene: Scene) -> SuctionSeal | None:
        """Seal of a suction cup on the workpiece of a scene; None for a gripper with fingers."""
        suction = self.gripper.suction
        if suction is None or index.cup is None:
            return None
        # Of a robot with a single joint the engine counts gravity twice at a constraint of a link that is fixed to the
        # moving one: an object that hangs there sags by g step² / 0.2, 0.9 mm at 240 Hz, and is pressed on its support.
        only = index.arm_joints[0] if len(index.arm_joints) == 1 else None
        bond = PyBulletBond(
            self.engine,
            self.client,
            robot=robot,
            cup_link=index.cup,
            bond_link=index.cup if only is None else only,
            body=body,
            greatest_force_n=self.gripper.finger_force_n,
        )
        point, step_s = suction_point_of(scene), self.settings.step_s
        return SuctionSeal(bond, point=point, gripper=self.gripper, suction=suction, step_s=step_s)

    def _couple_fingers(self, robot: int, one: int, other: int) -> None:
        """Gear two opposed fingers together; ungeared they do not resist a force along their common axis."""
        engine = self.engine
        frames = [1, 0, 0], [0, 0, 0], [0, 0, 0]
        gear = engine.createConstraint(
            robot, one, robot, other, engine.JOINT_GEAR, *frames, physicsClientId=self.client
        )
        engine.changeConstraint(gear, gearRatio=-1, maxForce=_GEAR_FORCE_N, erp=0.2, physicsClientId=self.client)
