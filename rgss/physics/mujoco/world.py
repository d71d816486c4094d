"""Contact world in MuJoCo: joint control, finger motors, contacts."""

from __future__ import annotations

from collections.abc import Sequence
from types import TracebackType
from typing import Any

import numpy as np

from rgss.errors import DefinitionError, SimulationError
from rgss.physics.contacts import Contacts, FingerContact
from rgss.physics.hand_view import HandView
from rgss.physics.mujoco.contact_reader import MujocoContactReader
from rgss.physics.mujoco.engine import compiled, mujoco
from rgss.physics.mujoco.finger_drive import MujocoFingerDrive
from rgss.physics.mujoco.followers import MujocoFollowers
from rgss.physics.mujoco.linkage_drive import MujocoLinkageDrive
from rgss.physics.mujoco.model import world_model
from rgss.physics.mujoco.suction_bond import MujocoBond
from rgss.physics.settings import PhysicsSettings
from rgss.physics.suction_seal import SuctionSeal
from rgss.scenes import Gripper, Pose, Scene, suction_point_of

LEAST_MUJOCO_RATE_HZ = 500.0
"""Contacts, with a time constant of 4 ms, are stable if it is two steps or more."""

_FREQUENCY_RAD_S = 300.0


class MujocoWorld:
    """Implementation of `rgss.physics.ContactWorld` in MuJoCo.

    The arm's joints are controlled by computed torque: inverse dynamics of the target acceleration, from the engine's
    mass matrix and bias forces, and a critically damped correction. The machine is thus dynamic, with bounded torques.
    If positions were written into the state instead, the hand would jump in every step without a velocity, and friction
    would not carry the object along.
    """

    def __init__(
        self,
        scene: Scene,
        gripper: Gripper,
        settings: PhysicsSettings,
        *,
        contact_time_constant_s: float,
        joint_offsets_rad: Sequence[float] = (),
    ) -> None:
        """Build the world.

        Args:
            scene: Fixed bodies, workpiece and robot.
            gripper: The gripper on the robot's flange.
            settings: Step and solver.
            contact_time_constant_s: Time constant of contacts and joint limits.
            joint_offsets_rad: True minus reported angle of each joint of the arm; empty if they are equal.

        Raises:
            DefinitionError: The rate is below the one at which contacts are stable.
            SimulationError: The engine cannot build it.
        """
        if settings.rate_hz < LEAST_MUJOCO_RATE_HZ:
            raise DefinitionError(
                f"the rate must be at least {LEAST_MUJOCO_RATE_HZ:g} Hz in MuJoCo, got {settings.rate_hz:g} Hz",
                hint="contacts are unstable below it",
            )
        self.scene, self.gripper, self.settings = scene, gripper, settings
        self._engine = mujoco()
        described = world_model(scene, gripper, settings, contact_time_constant_s=contact_time_constant_s)
        self._model: Any = compiled(described.text)
        self._data: Any = self._engine.MjData(self._model)
        model, driven = self._model, [joint.name for joint in scene.robot.joints]
        self._positions = np.array([model.joint(name).qposadr[0] for name in driven])
        self._speeds = np.array([model.joint(name).dofadr[0] for name in driven])
        self._followers = MujocoFollowers(model, self._data, scene.robot)
        self._motors = np.array([model.actuator(name).id for name in driven])
        self._limits = model.actuator_forcerange[self._motors, 1].copy()
        self._travels = np.array([model.joint(name).qposadr[0] for name in described.fingers], dtype=int)
        self._offsets = np.array(joint_offsets_rad or np.zeros(len(driven)), dtype=float)
        self._flange = int(model.body(f"link:{scene.robot.flange}").id)
        self._objects = {name: int(model.body(body).id) for name, body in described.object_bodies.items()}
        self._grasp_centre_m = gripper.geometry.grasp_centre.position_m
        self._reader = MujocoContactReader(model, self._data, described)
        self._bodies = described.object_bodies
        self._fingers = MujocoFingerDrive(model, self._data, gripper, described.fingers, step_s=settings.step_s)
        self._linkage: MujocoLinkageDrive | None = None
        if gripper.geometry.linkage is not None:
            linkage, joints = gripper.geometry.linkage, described.linkage_joints
            self._linkage = MujocoLinkageDrive(model, self._data, linkage, joints, step_s=settings.step_s)
        self._select_workpiece(scene.workpiece.id)
        self._wanted, self._needed = np.zeros(model.nv), np.zeros(model.nv)
        self._target = self._target_speed = self._speed_before = self._torques = np.zeros(len(driven))
        self._stood_m, self._stood_wxyz = np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0])
        self.reset_arm((0.0,) * len(driven))

    def __enter__(self) -> MujocoWorld:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Do nothing: model and state are freed with this world."""

    def reset_arm(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration, fingers open and the workpiece unchanged, without stepping."""
        self._engine.mj_resetData(self._model, self._data)
        self._target = np.array(configuration_rad, dtype=float) + self._offsets
        self._data.qpos[self._positions] = self._target
        self._followers.reset(self._target)
        if self._linkage is not None:
            self._linkage.reset()
        self._fingers.reset()
        self._target_speed = self._speed_before = self._torques = np.zeros(len(self._target))
        self.hold_open()
        self._engine.mj_forward(self._model, self._data)
        self._note_workpiece()

    def command_arm(self, position_rad: Sequence[float], velocity_rad_s: Sequence[float]) -> None:
        """Set the arm's targets for the next step: reported positions at its start, mean velocities over it."""
        self._target, self._target_speed = np.asarray(position_rad) + self._offsets, np.asarray(velocity_rad_s)

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
        return (self._pose_of(self._flange) @ self.gripper.geometry.lip).position_m, pull_n

    @property
    def slipped_follower(self) -> str:
        """Name of a follower whose coupling does not transmit what it needs; empty if none."""
        return self._followers.slipped

    @property
    def follow_error(self) -> float:
        """Greatest deviation of a following joint, of a linkage or the arm, from its ratio in rad or m; 0 without."""
        return max(0.0 if self._linkage is None else self._linkage.largest_error, self._followers.largest_error)

    def hold_open(self) -> None:
        """Hold the fingers at their open end, against its stop."""
        self.drive_fingers(-self.gripper.finger_velocity_m_s, self.gripper.finger_force_n)

    def drive_fingers(self, velocity_m_s: float, force_n: float) -> None:
        """Move every finger at a velocity (positive closes) with at most a force, or switch the vacuum on or off."""
        if self._seal is not None:
            self._seal.switch(on=velocity_m_s > 0.0)
            return
        if self._linkage is not None:
            self._linkage.drive(velocity_m_s, force_n)
            return
        self._fingers.drive(velocity_m_s, force_n)

    def step(self) -> None:
        """Advance by one step.

        Raises:
            SimulationError: The engine warned, for instance of an instability.
        """
        model, data, engine = self._model, self._data, self._engine
        engine.mj_step1(model, data)
        self._note_workpiece()
        lag = self._target - data.qpos[self._positions]
        slowness = self._speed_before - data.qvel[self._speeds]
        correction = _FREQUENCY_RAD_S**2 * lag + 2 * _FREQUENCY_RAD_S * slowness
        self._wanted[self._speeds] = (self._target_speed - self._speed_before) / self.settings.step_s + correction
        self._speed_before = self._target_speed
        self._followers.accelerate(self._wanted)
        engine.mj_mulM(model, data, self._needed, self._wanted)
        torques = self._followers.driven_efforts(self._needed + data.qfrc_bias)
        self._torques = np.minimum(np.maximum(torques, -self._limits), self._limits)
        data.ctrl[self._motors] = self._torques
        if self._linkage is not None:
            self._linkage.before_step()
        self._fingers.before_step()
        engine.mj_step2(model, data)
        engine.mj_kinematics(model, data)
        self._followers.after_step()
        if data.warning.number.any():
            names = [str(engine.mjtWarning(index).name) for index in np.flatnonzero(data.warning.number).tolist()]
            raise SimulationError(f"MuJoCo warned: {', '.join(names)}", hint="use a higher rate")
        if self._seal is not None:
            self._seal.after_step(self._pose_of(self._flange), self.workpiece_pose())

    def bend(self, arc_m: Sequence[float]) -> None:
        """Second-order correction of a carried workpiece's position, as PyBullet needs it; see `ContactWorld.bend`."""
        at = self._workpiece_at
        self._data.qpos[at : at + 3] += arc_m
        self._data.xpos[self._workpiece] += arc_m

    def reduce_solver_effort(self, *, free: bool) -> None:
        """Do nothing: Newton's method converges early if there is little to solve."""

    def arm_state(self) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
        """Reported joint positions (rad), velocities (rad/s) and motor torques (N·m) of the arm after the last step."""
        positions, velocities = self._data.qpos[self._positions] - self._offsets, self._data.qvel[self._speeds]
        return tuple(positions.tolist()), tuple(velocities.tolist()), tuple(self._torques.tolist())

    def finger_travel_m(self) -> tuple[float, ...]:
        """Travel of each finger from its open end."""
        if self._linkage is not None:
            return self._linkage.travel_m()
        return tuple(self._data.qpos[self._travels].tolist())

    def workpiece_pose(self) -> Pose:
        """Transform of the workpiece to the world."""
        return self._pose_of(self._workpiece)

    def object_pose(self, name: str) -> Pose:
        """Transform of an object's shape to the world."""
        return self._pose_of(self._objects[name])

    def set_workpiece(self, scene: Scene) -> None:
        """Make another object the workpiece, or change the place where it is released.

        Args:
            scene: The scene with that object as its workpiece, at its present pose.
        """
        self.scene = scene
        self._select_workpiece(scene.workpiece.id)

    def tool_pose(self) -> Pose:
        """Transform of the grasp-centre frame to the world at the true joint angles."""
        return self.hand_view().tool

    def hand_view(self) -> HandView:
        """Poses of object, flange and fingers after the last step."""
        held, flange = self._pose_of(self._workpiece), self._pose_of(self._flange)
        return HandView(
            held.position_m,
            held.quaternion_xyzw,
            flange.position_m,
            flange.quaternion_xyzw,
            self._grasp_centre_m,
            self.finger_travel_m(),
        )

    def contacts(self, standing: Contacts | None = None) -> Contacts:
        """Contacts of the last step; see `ContactWorld.contacts`."""
        if self._seal is None or not self._seal.is_sealed:
            return self._reader.contacts(standing)
        return self._reader.contacts(None)._replace(finger_forces_n=(self._seal.force_n,))

    def support_force_n(self) -> float:
        """Sum of the normal forces of the scene's bodies on the workpiece in the last step."""
        return self._reader.scene_force_n()

    def finger_contacts(self) -> tuple[FingerContact, ...]:
        """Contact points of the fingers on the workpiece, by finger and ascending height."""
        return self._reader.finger_contacts(_pose(self._stood_m, self._stood_wxyz))

    def _select_workpiece(self, name: str) -> None:
        self._workpiece = self._objects[name]
        self._workpiece_at = int(self._model.joint(self._model.body(self._workpiece).jntadr[0]).qposadr[0])
        self._reader.select(name)
        self._seal = self._seal_on(name)
        self._note_workpiece()

    def _seal_on(self, name: str) -> SuctionSeal | None:
        """Seal of a suction cup on an object; None for a gripper with fingers."""
        geometry, suction = self.gripper.geometry, self.gripper.suction
        if suction is None:
            return None
        lip_m = (geometry.cup_pose.inverse() @ geometry.lip).position_m
        friction = self.gripper.friction * self.scene.workpiece.friction
        bond = MujocoBond(
            self._model, self._data, self._reader, body=self._bodies[name], lip_m=lip_m, friction=friction
        )
        point, step_s = suction_point_of(self.scene), self.settings.step_s
        return SuctionSeal(bond, point=point, gripper=self.gripper, suction=suction, step_s=step_s)

    def _note_workpiece(self) -> None:
        """Store the pose of the workpiece at the start of a step, at which the engine detects contacts."""
        self._stood_m = self._data.xpos[self._workpiece].copy()
        self._stood_wxyz = self._data.xquat[self._workpiece].copy()

    def _pose_of(self, body: int) -> Pose:
        return _pose(self._data.xpos[body], self._data.xquat[body])


def _pose(position_m: Any, quaternion_wxyz: Any) -> Pose:
    x, y, z = position_m.tolist()
    qw, qx, qy, qz = quaternion_wxyz.tolist()
    return Pose(position_m=(x, y, z), quaternion_xyzw=(qx, qy, qz, qw))
