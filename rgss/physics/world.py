"""Contact world in PyBullet: the scene's bodies, the workpiece, and the arm with its gripper.

Properties of the engine behind this design: a finger on a velocity motor exerts its force limit exactly, while a torque
command causes an impact; target position and velocity must be commanded at every step; every call names its client.
Those that set_workpiece the bodies are in `world_builder`.
"""

# long file: one class with a short method for each operation of a step.

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

from rgss.errors import SimulationError
from rgss.physics.bodies import links_of
from rgss.physics.contact_reader import ContactReader
from rgss.physics.contacts import Contacts, FingerContact
from rgss.physics.engine import ClientOwner
from rgss.physics.hand_view import HandView
from rgss.physics.hands import LinkageDrive
from rgss.physics.settings import PhysicsSettings
from rgss.physics.suction_seal import SuctionSeal
from rgss.physics.world_builder import WorldBuilder
from rgss.scenes import Gripper, Pose, Scene

_ARM_POSITION_GAIN = 0.2
_RENEWAL_COSINE = math.cos(math.radians(15.0) / 2)
_RENEWAL_CHECK_STEPS = 8


class World(ClientOwner):
    """One physics world; a context manager that always closes its client.

    Velocity motors with the joints' torque limits drive the arm to its targets; fingers move at a velocity with a force
    limit.
    """

    def __init__(
        self,
        scene: Scene,
        gripper: Gripper,
        settings: PhysicsSettings,
        *,
        joint_offsets_rad: Sequence[float] = (),
    ) -> None:
        """Build the world.

        Args:
            scene: Fixed bodies, workpiece and robot.
            gripper: The gripper on the robot's flange.
            settings: Step length and solver.
            joint_offsets_rad: True minus reported angle of each joint of the arm; empty if they are equal.

        Raises:
            SimulationError: The engine cannot build it.
        """
        super().__init__()
        self._joint_offsets_rad = tuple(joint_offsets_rad)
        self.scene = scene
        self.gripper = gripper
        self.settings = settings
        self._steps = 0
        self._seal: SuctionSeal | None = None
        self._linkage: LinkageDrive | None = None
        self._to_renew: list[int] = []
        self._renewed_at = scene.workpiece.pose.quaternion_xyzw
        try:
            builder = WorldBuilder(
                engine=self._engine, client=self._client, scene=scene, gripper=gripper, settings=settings
            )
            builder.set_parameters()
            self._scene_names = builder.add_scene()
            added = builder.add_objects()
            self._objects = {name: number for name, (number, _) in added.items()}
            self._principals = {name: principal for name, (_, principal) in added.items()}
            self._select_workpiece(scene.workpiece.id)
            self._robot = builder.add_robot()
            self._index_robot(builder)
        except self._engine.error as error:
            self.close()
            raise SimulationError(f"the physics engine rejected the world: {error}", hint="check the scene") from error
        except BaseException:
            self.close()
            raise

    def reset_arm(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration, fingers open, without stepping."""
        true_rad = self._true(configuration_rad)
        for joint, angle in zip(self._arm_joints, true_rad, strict=True):
            self._engine.resetJointState(self._robot, joint, angle, 0.0, physicsClientId=self._client)
        self._followers.reset(true_rad)
        if self._linkage is None:
            for joint in self._finger_joints:
                self._engine.resetJointState(self._robot, joint, 0.0, 0.0, physicsClientId=self._client)
        else:
            self._linkage.reset(0.0)
        self.command_arm(configuration_rad, (0.0,) * len(self._arm_joints))
        self.hold_open()

    def command_arm(self, position_rad: Sequence[float], velocity_rad_s: Sequence[float]) -> None:
        """Set the arm's targets for the next step, in encoder angles."""
        if self._joint_offsets_rad:
            position_rad = self._true(position_rad)
        if self.scene.robot.followers:
            self._followers.command(position_rad, velocity_rad_s)
            return
        # Calls of every step pass positional arguments, which the engine parses in half the time.
        self._engine.setJointMotorControlArray(
            self._robot,
            self._arm_joints,
            self._engine.POSITION_CONTROL,
            position_rad,
            velocity_rad_s,
            self._arm_torques,
            self._arm_position_gains,
            self._arm_velocity_gains,
            self._client,
        )

    def hold_open(self) -> None:
        """Hold the fingers at their open end."""
        if self._seal is not None:
            self._seal.switch(on=False)
            return
        if self._linkage is not None:
            self._linkage.hold(0.0)
            return
        count = len(self._finger_joints)
        self._engine.setJointMotorControlArray(
            self._robot,
            self._finger_joints,
            self._engine.POSITION_CONTROL,
            [0.0] * count,
            [0.0] * count,
            [self.gripper.finger_force_n] * count,
            physicsClientId=self._client,
        )

    def drive_fingers(self, velocity_m_s: float, force_n: float) -> None:
        """Move every finger at a velocity (positive closes) with at most a force, or switch the vacuum on or off."""
        if self._seal is not None:
            self._seal.switch(on=velocity_m_s > 0.0)
            return
        if velocity_m_s < 0.0:
            self.renew_contacts()
        if self._linkage is not None:
            self._linkage.drive(velocity_m_s, force_n)
            return
        count = len(self._finger_joints)
        self._engine.setJointMotorControlArray(
            self._robot,
            self._finger_joints,
            self._engine.VELOCITY_CONTROL,
            targetVelocities=[velocity_m_s] * count,
            forces=[force_n] * count,
            physicsClientId=self._client,
        )

    def step(self) -> None:
        """Advance by one step."""
        self._steps += 1
        if self._steps % _RENEWAL_CHECK_STEPS == 0 and self._seal is None:
            self._renew_contacts_after_rotation()
        if self._linkage is not None:
            self._linkage.before_step()
        self._engine.stepSimulation(self._client)
        if self._seal is not None:
            self._seal.after_step(self._flange_pose(), self.workpiece_pose())

    def bend(self, arc_m: Sequence[float]) -> None:
        """Second-order correction of the workpiece's position after a step in which the hand carried it.

        The engine moves a hand along its arc and a free body along the tangent at the start of the step. The difference
        adds up to millimetres, and friction at its limit does not compensate it.

        Args:
            arc_m: Displacement of the tool over the step minus that along its initial velocity, in the world, in m.
        """
        engine, client, body = self._engine, self._client, self._workpiece
        (x, y, z), turned = engine.getBasePositionAndOrientation(body, client)
        velocities = engine.getBaseVelocity(body, client)
        corrected = (x + arc_m[0], y + arc_m[1], z + arc_m[2])
        engine.resetBasePositionAndOrientation(body, corrected, turned, client)
        engine.resetBaseVelocity(body, *velocities, client)  # the engine zeroes the velocity of a body that it places

    def reduce_solver_effort(self, *, free: bool) -> None:
        """Use fewer iterations of the solver while nothing is held, or restore them.

        Args:
            free: True while the hand is empty and moves.
        """
        settings = self.settings
        iterations = self._solver_iterations
        # The gears of a linkage always need their iterations.
        fewer = settings.free_iterations if self._linkage is None else iterations
        self._engine.setPhysicsEngineParameter(
            numSolverIterations=min(iterations, fewer) if free else iterations,
            physicsClientId=self._client,
        )

    def renew_contacts(self) -> None:
        """Discard the engine's cached contacts of the workpiece, so that they are detected again.

        The engine caches the points of a persistent contact, with their normals in the world at detection. While a held
        object rotates they become wrong: forces change that should not, and an opening finger drags the object along.
        Each renewal loses the elastic deflection of the friction, some hundredths of a millimetre.
        """
        for link in links_of(self._engine, self._client, self._workpiece):
            self._rediscover(self._workpiece, link)

    def set_workpiece(self, scene: Scene) -> None:
        """Make another object the workpiece, or change the place where it is released.

        Args:
            scene: The scene with that object as its workpiece, at its present pose.
        """
        self.scene = scene
        self._select_workpiece(scene.workpiece.id)
        self._renewed_at = self._engine.getBasePositionAndOrientation(self._workpiece, self._client)[1]
        self._reader = self._reader_of_workpiece()
        self._seal = self._seal_on(self._workpiece, scene)

    def object_pose(self, name: str) -> Pose:
        """Transform of an object's shape to the world."""
        if self._objects[name] == self._workpiece:
            return self.workpiece_pose()
        position, turned = self._engine.getBasePositionAndOrientation(self._objects[name], self._client)
        return Pose(position_m=position, quaternion_xyzw=turned) @ self._principals[name].inverse()

    def arm_state(self) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
        """Reported joint positions (rad), velocities (rad/s) and motor torques (N·m) of the arm after the last step.

        A torque equals the joint's limit if the motor saturated.
        """
        states = self._engine.getJointStates(self._robot, self._arm_joints, self._client)
        positions, velocities, _, torques = zip(*states, strict=True)
        if self.scene.robot.followers:
            torques = self._followers.driven_efforts(torques)
        if self._joint_offsets_rad:
            pairs = zip(positions, self._joint_offsets_rad, strict=True)
            positions = tuple([angle - offset for angle, offset in pairs])
        return positions, velocities, torques

    def finger_travel_m(self) -> tuple[float, ...]:
        """Travel of each finger from its open end in m."""
        if not self._finger_joints:
            return ()
        if self._linkage is not None:
            return self._linkage.travel_m()
        states = self._engine.getJointStates(self._robot, self._finger_joints, self._client)
        return tuple([state[0] for state in states])

    def workpiece_pose(self) -> Pose:
        """Transform of the workpiece's shape to the world."""
        position, orientation = self._workpiece_at()
        return Pose(position_m=position, quaternion_xyzw=orientation)

    def tool_pose(self) -> Pose:
        """Transform of the grasp-centre frame to the world at the true joint angles."""
        return self.hand_view().tool

    def hand_view(self) -> HandView:
        """Snapshot of the object, the tool and the fingers at their true poses."""
        position, orientation = self._workpiece_at()
        state = self._engine.getLinkState(self._robot, self._flange, 0, 1, self._client)
        return HandView(position, orientation, state[4], state[5], self._grasp_centre_m, self.finger_travel_m())

    def contacts(self, standing: Contacts | None = None) -> Contacts:
        """Contacts after the last step.

        The arm's base link does not move and so is never reported, wherever it is mounted.

        Args:
            standing: Contacts observed when the workpiece last rested without contact to the robot, if it did; they
                remain valid as long as the robot touches nothing.
        """
        if self._seal is None or not self._seal.is_sealed:
            return self._reader.contacts(standing)
        return self._reader.contacts()._replace(finger_forces_n=(self._seal.force_n,))

    @property
    def grip_fault(self) -> str:
        """Reason why a switched-on suction cup does not hold the workpiece; empty if it does, and for fingers."""
        return "" if self._seal is None else self._seal.fault

    @property
    def seal_margin(self) -> float | None:
        """Factor by which the load of a suction cup could grow before its seal breaks; None if it is unknown."""
        return None if self._seal is None else self._seal.margin

    def seal_pull(self) -> tuple[tuple[float, float, float], tuple[float, float, float]] | None:
        """Centre of a suction cup's lip in the world and the force in N on the workpiece there; None without a seal."""
        pull_n = None if self._seal is None else self._seal.pull_n()
        if pull_n is None:
            return None
        return (self._flange_pose() @ self.gripper.geometry.lip).position_m, pull_n

    @property
    def slipped_follower(self) -> str:
        """Name of a follower whose coupling does not transmit what it needs; empty if none."""
        return self._followers.slipped

    @property
    def follow_error(self) -> float:
        """Greatest deviation of a following joint, of a linkage or the arm, from its ratio in rad or m; 0 without."""
        return max(0.0 if self._linkage is None else self._linkage.largest_error, self._followers.largest_error)

    def support_force_n(self) -> float:
        """Sum of the normal forces of the scene's bodies on the workpiece in the last step."""
        return self._reader.scene_force_n()

    def finger_contacts(self) -> tuple[FingerContact, ...]:
        """Contact points of the fingers on the workpiece in the last step."""
        return self._reader.finger_contacts(self.settings.step_s)

    def _flange_pose(self) -> Pose:
        state = self._engine.getLinkState(self._robot, self._flange, 0, 1, self._client)
        return Pose(position_m=state[4], quaternion_xyzw=state[5])

    def _renew_contacts_after_rotation(self) -> None:
        _, turned = self._engine.getBasePositionAndOrientation(self._workpiece, self._client)
        if not self._to_renew:
            (ax, ay, az, aw), (bx, by, bz, bw) = turned, self._renewed_at
            if abs(ax * bx + ay * by + az * bz + aw * bw) >= _RENEWAL_COSINE:
                return
            self._renewed_at = turned
            self._to_renew = list(self._finger_of_link)
        # One finger at a time, so that the friction of the others holds the object.
        self._rediscover(self._robot, self._to_renew.pop())

    def _true(self, reported_rad: Sequence[float]) -> Sequence[float]:
        """True joint angles from the reported ones."""
        offsets = self._joint_offsets_rad or (0.0,) * len(reported_rad)
        return [angle + offset for angle, offset in zip(reported_rad, offsets, strict=True)]

    def _workpiece_at(self) -> tuple[tuple[float, float, float], tuple[float, float, float, float]]:
        """Position and orientation of the workpiece's shape; the engine reports those of its principal frame."""
        found, turned = self._engine.getBasePositionAndOrientation(self._workpiece, self._client)
        if self._is_offset:
            pose = Pose(position_m=found, quaternion_xyzw=turned) @ self._shape_in_principal
            return pose.position_m, pose.quaternion_xyzw
        return found, turned

    def _rediscover(self, body: int, link: int) -> None:
        # Setting a filter, even to its present value, removes the link from the broad phase and adds it again.
        self._engine.setCollisionFilterGroupMask(body, link, 1, -1, physicsClientId=self._client)

    def _select_workpiece(self, name: str) -> None:
        """Make an object the workpiece."""
        self._workpiece, self._principal = self._objects[name], self._principals[name]
        self._is_offset = self._principal != Pose()
        self._shape_in_principal = self._principal.inverse()

    def _reader_of_workpiece(self) -> ContactReader:
        """Contact reader of the workpiece; the other objects count as bodies of the scene."""
        others = {number: name for name, number in self._objects.items() if number != self._workpiece}
        return ContactReader(
            self._engine,
            self._client,
            robot=self._robot,
            workpiece=self._workpiece,
            finger_of_link=self._finger_of_link,
            link_names=self._link_names,
            scene_names={**self._scene_names, **others},
            principal=self._principal,
        )

    def _index_robot(self, builder: WorldBuilder) -> None:
        index = builder.index_robot(self._robot)
        arm = self.scene.robot.joints
        self._arm_joints = index.arm_joints
        self._arm_torques = [joint.torque_n_m for joint in arm]
        self._arm_position_gains, self._arm_velocity_gains = [_ARM_POSITION_GAIN] * len(arm), [1.0] * len(arm)
        self._finger_joints = index.finger_joints
        self._flange = index.flange
        self._grasp_centre_m = self.gripper.geometry.grasp_centre.position_m
        self._finger_of_link = index.finger_of_link if index.cup is None else {index.cup: 0}
        self._link_names = index.link_names
        self._reader = self._reader_of_workpiece()
        builder.set_robot_dynamics(self._robot, index)
        builder.leave_out_standing_links(self._robot, index, self._scene_names)
        self._followers = builder.follower_motors(self._robot, index, _ARM_POSITION_GAIN)
        self._solver_iterations = builder.solver_iterations
        self._linkage = builder.linkage_drive(self._robot, index)
        self._seal_on = partial(builder.seal, self._robot, index)
        self._seal = self._seal_on(self._workpiece, self.scene)
