"""Engine-independent interface of the world of a contact trial, for the task program and its monitors."""

from __future__ import annotations

from collections.abc import Sequence
from types import TracebackType
from typing import Protocol

from rgss.physics.contacts import Contacts, FingerContact
from rgss.physics.hand_view import HandView
from rgss.physics.settings import PhysicsSettings
from rgss.scenes import Gripper, Pose, Scene


class ContactWorld(Protocol):
    """Simulated arm, hand, workpiece and scene, stepped at a fixed rate; a context manager that frees its engine."""

    @property
    def scene(self) -> Scene:
        """Fixed bodies, workpiece and robot."""

    @property
    def gripper(self) -> Gripper:
        """The gripper on the robot's flange."""

    @property
    def settings(self) -> PhysicsSettings:
        """Step length and solver."""

    @property
    def grip_fault(self) -> str:
        """Reason why a switched-on suction cup does not hold the workpiece; empty if it does, and for fingers."""

    @property
    def slipped_follower(self) -> str:
        """Name of a follower of the arm whose coupling does not transmit what it needs; empty if none."""

    @property
    def seal_margin(self) -> float | None:
        """Factor by which the load of a suction cup could grow before its seal breaks; None if it is unknown."""

    def seal_pull(self) -> tuple[tuple[float, float, float], tuple[float, float, float]] | None:
        """Centre of a suction cup's lip in the world and the force in N on the workpiece there; None without a seal."""

    def __enter__(self) -> ContactWorld: ...

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None: ...

    def close(self) -> None:
        """Free the engine's resources; closing twice is allowed."""

    def reset_arm(self, configuration_rad: Sequence[float]) -> None:
        """Put the arm at rest at a configuration, fingers open, without stepping."""

    def command_arm(self, position_rad: Sequence[float], velocity_rad_s: Sequence[float]) -> None:
        """Set the arm's targets for the next step: positions at its start, mean velocities over it."""

    def hold_open(self) -> None:
        """Hold the fingers at their open end."""

    def drive_fingers(self, velocity_m_s: float, force_n: float) -> None:
        """Move every finger at a velocity (positive closes) with at most a force."""

    def step(self) -> None:
        """Advance by one step.

        Raises:
            SimulationError: The engine lost the solution.
        """

    def bend(self, arc_m: Sequence[float]) -> None:
        """Second-order correction of the workpiece's position after a step in which the hand carried it.

        Args:
            arc_m: Displacement of the tool over the step minus that along its initial velocity, in the world, in m.
        """

    def reduce_solver_effort(self, *, free: bool) -> None:
        """Reduce the solver's effort while nothing is held, or restore it; an engine may ignore this.

        Args:
            free: True while the hand is empty and moves.
        """

    def arm_state(self) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
        """Joint positions (rad), velocities (rad/s) and motor torques (N·m) of the arm after the last step."""

    def finger_travel_m(self) -> tuple[float, ...]:
        """Travel of each finger from its open end in m."""

    def workpiece_pose(self) -> Pose:
        """Transform of the workpiece to the world."""

    def object_pose(self, name: str) -> Pose:
        """Transform of an object of the scene to the world."""

    def set_workpiece(self, scene: Scene) -> None:
        """Make another object the workpiece, or change the place where it is released.

        Args:
            scene: The scene with that object as its workpiece, at its present pose.
        """

    def tool_pose(self) -> Pose:
        """Transform of the grasp-centre frame to the world at the true joint angles."""

    def hand_view(self) -> HandView:
        """Poses of object, flange and fingers after the last step."""

    def contacts(self, standing: Contacts | None = None) -> Contacts:
        """Contacts of the last step.

        Args:
            standing: Contacts observed when the workpiece last rested without contact to the robot, if it did; they
                remain valid as long as the robot touches nothing.
        """

    def support_force_n(self) -> float:
        """Sum in N of the normal forces of the scene's bodies on the workpiece in the last step."""

    def finger_contacts(self) -> tuple[FingerContact, ...]:
        """Contact points of the fingers on the workpiece, by finger and ascending height."""
