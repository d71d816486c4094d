"""Simulation of the arm alone, driven by joint torques, without contacts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from rgss.errors import SimulationError
from rgss.physics.bodies import add_object
from rgss.physics.engine import ClientOwner, load_urdf_text
from rgss.physics.gears import ArmGears
from rgss.physics.hands import LinkageDrive
from rgss.physics.settings import PhysicsSettings
from rgss.scenes import Gripper, Pose, Robot, Workpiece, assembled_urdf, finger_joint


class TorqueArm(ClientOwner):
    """One arm with its gripper in an empty world; a context manager that always closes its client.

    Stiff motors hold the fingers in position.
    """

    def __init__(self, robot: Robot, gripper: Gripper, settings: PhysicsSettings, *, gravity_m_s2: float) -> None:
        """Build the arm.

        Args:
            robot: The arm.
            gripper: The gripper on its flange.
            settings: Step length and solver.
            gravity_m_s2: Magnitude of gravity.

        Raises:
            SimulationError: The engine cannot build it.
        """
        super().__init__()
        self._held = self._bond = -1
        self._linkage: LinkageDrive | None = None
        self._grasp_centre = gripper.geometry.grasp_centre
        try:
            self._build(robot, gripper, settings, gravity_m_s2)
        except self._engine.error as error:
            self.close()
            raise SimulationError(f"the physics engine rejected the arm: {error}", hint="check the robot") from error
        except BaseException:
            self.close()
            raise

    def reset(self, configuration_rad: Sequence[float], finger_travel_m: float) -> None:
        """Put the arm at rest at a configuration and the fingers at a travel from open."""
        for joint, angle in zip(self._joints, configuration_rad, strict=True):
            self._engine.resetJointState(self._body, joint, angle, 0.0, physicsClientId=self._client)
        self._gears.reset(configuration_rad)
        self.hold_fingers(finger_travel_m)

    def hold_fingers(self, finger_travel_m: float) -> None:
        """Put the fingers at a travel from open and hold them there; no effect for a suction cup."""
        if not self._fingers:
            return
        if self._linkage is not None:
            self._linkage.reset(finger_travel_m)
            self._linkage.hold(finger_travel_m, stiff=True)
            return
        for joint in self._fingers:
            self._engine.resetJointState(self._body, joint, finger_travel_m, 0.0, physicsClientId=self._client)
        self._engine.setJointMotorControlArray(
            self._body,
            self._fingers,
            self._engine.POSITION_CONTROL,
            targetPositions=[finger_travel_m] * len(self._fingers),
            forces=[_HOLDING_FORCE_N] * len(self._fingers),
            physicsClientId=self._client,
        )

    def attach(self, workpiece: Workpiece, held: Pose | None = None) -> None:
        """Fix a workpiece to the flange, with mass but without a collision shape.

        Args:
            workpiece: The workpiece.
            held: Transform of the workpiece to the grasp-centre frame; None to centre it on the grasp centre.
        """
        flange = self._engine.getLinkState(
            self._body, self._flange, computeForwardKinematics=1, physicsClientId=self._client
        )
        centre = self._grasp_centre if held is None else self._grasp_centre @ held
        pose = Pose(position_m=tuple(flange[4]), quaternion_xyzw=tuple(flange[5])) @ centre
        # The controller's model of a held cylinder has its centre of mass in the middle.
        placed = replace(workpiece, centre_of_mass_m=0.0) if held is None else workpiece
        self._held, principal = add_object(self._engine, self._client, replace(placed, pose=pose))
        bonded = centre @ principal
        self._engine.setCollisionFilterGroupMask(self._held, -1, 0, 0, physicsClientId=self._client)
        self._engine.changeDynamics(self._held, -1, linearDamping=0.0, angularDamping=0.0, physicsClientId=self._client)
        self._bond = self._engine.createConstraint(
            self._body,
            self._flange,
            self._held,
            -1,
            self._engine.JOINT_FIXED,
            [0, 0, 0],
            bonded.position_m,
            [0, 0, 0],
            *((bonded.quaternion_xyzw,) if held is not None else ()),
            physicsClientId=self._client,
        )

    def detach(self) -> None:
        """Remove the workpiece from the world."""
        if self._held >= 0:
            self._engine.removeConstraint(self._bond, physicsClientId=self._client)
            self._engine.removeBody(self._held, physicsClientId=self._client)
            self._held = -1

    def step(self, torques_n_m: Sequence[float]) -> None:
        """Apply joint torques for one step."""
        self._engine.setJointMotorControlArray(
            self._body,
            self._joints,
            self._engine.TORQUE_CONTROL,
            forces=list(torques_n_m),
            physicsClientId=self._client,
        )
        self._engine.stepSimulation(physicsClientId=self._client)

    def state(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Joint angles (rad) and speeds (rad/s)."""
        states = self._engine.getJointStates(self._body, self._joints, physicsClientId=self._client)
        return tuple(s[0] for s in states), tuple(s[1] for s in states)

    @property
    def slipped_follower(self) -> str:
        """Name of a follower whose coupling does not transmit what it needs; empty if none."""
        return self._gears.slipped

    @property
    def follow_error(self) -> float:
        """Greatest deviation of a follower of the arm from its driven joint in rad or m; 0 without followers."""
        return self._gears.largest_error

    def _build(self, robot: Robot, gripper: Gripper, settings: PhysicsSettings, gravity_m_s2: float) -> None:
        engine, client = self._engine, self._client
        engine.setGravity(0.0, 0.0, -gravity_m_s2, physicsClientId=client)
        engine.setPhysicsEngineParameter(
            fixedTimeStep=settings.step_s,
            numSolverIterations=settings.solver_iterations,
            numSubSteps=0,
            deterministicOverlappingPairs=1,
            physicsClientId=client,
        )
        self._body = load_urdf_text(
            client,
            assembled_urdf(robot, gripper),
            position=robot.base.position_m,
            orientation=robot.base.quaternion_xyzw,
            flags=engine.URDF_USE_INERTIA_FROM_FILE
            | engine.URDF_USE_IMPLICIT_CYLINDER
            | engine.URDF_IGNORE_VISUAL_SHAPES,
        )
        names, links = {}, {}
        for index in range(engine.getNumJoints(self._body, physicsClientId=client)):
            info = engine.getJointInfo(self._body, index, physicsClientId=client)
            names[info[1].decode()] = links[info[12].decode()] = index
            engine.changeDynamics(
                self._body, index, linearDamping=0.0, angularDamping=0.0, jointDamping=0.0, physicsClientId=client
            )
        self._flange = links[robot.flange]
        self._joints = [names[joint.name] for joint in robot.joints]
        self._gears = ArmGears(engine, client, self._body, robot, names)
        self._fingers = [names[finger_joint(finger)] for finger in range(gripper.geometry.fingers)]
        if gripper.geometry.linkage is not None:
            self._linkage = LinkageDrive(
                engine, client, self._body, gripper.geometry.linkage, names, step_s=settings.step_s
            )
        # The engine's default motors would brake the joints.
        engine.setJointMotorControlArray(
            self._body,
            self._joints,
            engine.VELOCITY_CONTROL,
            forces=[0.0] * len(self._joints),
            physicsClientId=client,
        )


_HOLDING_FORCE_N = 1.0e4
