"""Observations of the arm over a phase: loads, work and speeds of the joints, and tracking of the tool."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import cast

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import Metric
from rgss.scenes import Joint
from rgss.trials.plants.joint_load import JointLoad
from rgss.trials.plants.joint_motion import JointMotion

Array = NDArray[np.float64]


def tool_metrics(positions_m: Array, targets_m: Array, velocities: Array, accelerations: Array) -> dict[str, float]:
    """Tracking error of the tool, and peaks of its speed and acceleration.

    Args:
        positions_m: Positions of the tool in the world, shape (n, 3).
        targets_m: Its target positions, shape (n, 3).
        velocities: Its velocities in m/s, shape (m, 3).
        accelerations: Magnitudes of its acceleration in m/s², shape (k,).
    """
    return {
        "tracking_error_m": float(np.linalg.norm(positions_m - targets_m, axis=1).max()),
        "peak_tool_speed_m_s": float(np.linalg.norm(velocities, axis=1).max()),
        "peak_tool_acceleration_m_s2": float(accelerations.max(initial=0.0)),
    }


def tool_metrics_by_differences(positions_m: Array, targets_m: Array, *, step_s: float) -> dict[str, float]:
    """Tracking metrics with velocities and accelerations by differences of the positions.

    Args:
        positions_m: Positions of the tool in the world at the start and after each step, shape (n + 1, 3).
        targets_m: Its target positions, shape (n + 1, 3).
        step_s: Length of a step.
    """
    velocities = np.diff(positions_m, axis=0) / step_s
    accelerations = np.diff(velocities, axis=0) / step_s
    return tool_metrics(positions_m, targets_m, velocities, np.linalg.norm(accelerations, axis=1))


class ArmObservations:
    """Accumulator of loads, work and speeds of the joints in a phase, for any plant with torques."""

    def __init__(self, joints: Sequence[Joint], step_s: float) -> None:
        """Start at rest.

        Args:
            joints: The arm's joints with their limits.
            step_s: Length of a step.
        """
        self._load = JointLoad(joints)
        self._motion = JointMotion(joints)
        self._step_s = step_s
        self._tool: Mapping[str, Metric] = {"tracking_error_m": 0.0}

    def note_steps(self, torques_n_m: Array, speeds_rad_s: Array) -> None:
        """Add steps.

        Args:
            torques_n_m: Torque of each joint in each step, shape (steps, joints).
            speeds_rad_s: Speed of each joint after each step, shape (steps, joints).
        """
        if len(torques_n_m):
            self._load.note_all(torques_n_m, self._step_s)
            self._motion.note_all(torques_n_m, speeds_rad_s, self._step_s)

    def note_tool(self, metrics: Mapping[str, Metric]) -> None:
        """Store the metrics of the tool, in the form of `tool_metrics`."""
        self._tool = metrics

    def tracking_failure(self, error_m: float) -> str:
        """Detail of a tracking failure, with the joints that reached their limit."""
        return f"the tool was {error_m * 1e3:.2f} mm from its target{self.saturated_joints()}"

    def saturated_joints(self) -> str:
        """End of the detail of a failure, with the joints that reached their torque limit; empty if none did."""
        return self._load.words()

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit."""
        load, motion = self._load.metrics(), self._motion.metrics()
        return {**self._tool, **load, **motion, **governing_joint(load, motion)}


def governing_joint(load: Mapping[str, Metric], motion: Mapping[str, Metric]) -> dict[str, Metric]:
    """Greatest share of a limit, of torque or of speed, that a joint reached, and the number of that joint.

    Args:
        load: Metrics with ``peak_joint_torque_ratio`` and ``most_loaded_joint``.
        motion: Metrics with ``peak_joint_speed_ratio`` and ``fastest_joint``.
    """
    torque, speed = (
        cast("float", ratio) for ratio in (load["peak_joint_torque_ratio"], motion["peak_joint_speed_ratio"])
    )
    by_torque = torque >= speed
    return {
        "peak_joint_utilisation": max(torque, speed),
        "governing_joint": load["most_loaded_joint"] if by_torque else motion["fastest_joint"],
    }
