"""Monitor of the arm in contact physics: buffered states of all steps, evaluated together on demand."""

from __future__ import annotations

import math
from array import array
from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from rgss.evidence import Metric
from rgss.physics import PhysicsSettings
from rgss.scenes import Robot
from rgss.trials.plants import ArmObservations, ControlSettings, tool_metrics

Array = NDArray[np.float64]
JointState = tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]


class ToolKinematics(Protocol):
    """Forward kinematics of the tool."""

    @property
    def reach_m(self) -> float:
        """Greatest distance of a joint's axis from the tool."""

    def tool_motion(self, qs: ArrayLike, dqs: ArrayLike) -> tuple[Array, Array]:
        """Positions (m) and velocities (m/s) of the tool, each (k, 3), for joint positions and speeds, each (k, n)."""


class ArmMonitor:
    """Buffer of the joints' states in each step; the observations are computed from all steps at once."""

    def __init__(
        self,
        kinematics: ToolKinematics,
        robot: Robot,
        control: ControlSettings,
        settings: PhysicsSettings,
        *,
        path_m: Sequence[Sequence[float]] | Array = (),
    ) -> None:
        """Start at rest.

        Args:
            kinematics: Kinematics of the arm, with the tool at the grasp centre.
            robot: The arm.
            control: Tolerance of the tool's tracking error, and averaging of its acceleration.
            settings: Length of a step.
            path_m: Target positions of the tool in the world, at the start of a move and after each of its steps; empty
                if the arm is at rest.
        """
        self._kinematics = kinematics
        self._joints = robot.joints
        self._limit_m = control.largest_tracking_error_m
        # An angular error of a joint moves the tool by at most the error times the reach, that of a driven joint also
        # by those of its followers.
        moved = [1.0] * len(robot.joints)
        for one in robot.followers:
            moved[one.driver] += abs(one.multiplier)
        self._near_rad = self._limit_m / (kinematics.reach_m * math.hypot(*moved))
        self._step_s = settings.step_s
        self._window = max(1, round(control.acceleration_window_s * settings.rate_hz))
        # Velocities and torques of the steps at rest; those of a move have positions too.
        self._held = array("d")
        self._followed = array("d")
        self._path_m = path_m

    def note(self, state: JointState) -> None:
        """Add a step at rest.

        Args:
            state: The joints' positions (rad), velocities (rad/s) and torques (N·m) after it.
        """
        self._held.extend(state[1] + state[2])

    def follow(self, state: JointState, target_rad: Sequence[float]) -> str | None:
        """Add a step of a move.

        Args:
            state: The joints' positions (rad), velocities (rad/s) and torques (N·m) after it.
            target_rad: Target positions of the joints.

        Returns:
            The violation, if the tracking error of the tool exceeds its limit.
        """
        positions, velocities, torques = state
        self._followed.extend(positions + velocities + torques)
        if math.dist(positions, target_rad) <= self._near_rad:
            return None
        target_m = self._path_m[len(self._followed) // (3 * len(positions))]
        error = math.dist(self._kinematics.tool_motion([positions], [velocities])[0][0], target_m)
        if error <= self._limit_m:
            return None
        return self._observed({}).tracking_failure(error)

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit; those of the tool are missing if it did not follow a path."""
        return self._observed(self._tool()).metrics()

    def _tool(self) -> Mapping[str, Metric]:
        states = self._states()
        if not len(states):
            return {"tracking_error_m": 0.0, "peak_tool_speed_m_s": None, "peak_tool_acceleration_m_s2": None}
        positions, velocities = self._kinematics.tool_motion(states[:, 0], states[:, 1])
        # Every move starts from rest.
        padded = np.vstack([np.zeros((self._window, 3)), velocities])
        changes = np.linalg.norm(padded[self._window :] - padded[: -self._window], axis=1)
        targets = np.asarray(self._path_m[1 : len(states) + 1])
        return tool_metrics(positions, targets, velocities, changes / (self._window * self._step_s))

    def _states(self) -> Array:
        """Positions, velocities and torques of the steps of a move, shape (steps, 3, joints)."""
        return np.frombuffer(self._followed).reshape(-1, 3, len(self._joints))

    def _observed(self, tool: Mapping[str, Metric]) -> ArmObservations:
        arm = ArmObservations(self._joints, self._step_s)
        # In a phase the arm is either at rest or moves.
        held, moved = np.array(self._held).reshape(-1, 2, len(self._joints)), np.array(self._states())
        arm.note_steps(held[:, 1], held[:, 0])
        arm.note_steps(moved[:, 2], moved[:, 1])
        arm.note_tool(tool)
        return arm
