"""Joint work and joint speeds of a phase: mechanical energy, and the joint nearest to its speed limit."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import Metric
from rgss.scenes import Joint

Array = NDArray[np.float64]


def speed_metrics(peaks_rad_s: Array, joints: Sequence[Joint]) -> dict[str, Metric]:
    """Greatest joint speed as a share of its limit, and the number of that joint, from 1.

    Args:
        peaks_rad_s: Greatest speed of each joint, shape (joints,).
        joints: The joints with their limits.
    """
    ratios = [peak / joint.speed_rad_s for peak, joint in zip(peaks_rad_s.tolist(), joints, strict=True)]
    return {"peak_joint_speed_ratio": max(ratios), "fastest_joint": 1 + ratios.index(max(ratios))}


class JointMotion:
    """Accumulator of joint work and joint speeds over the steps of a phase.

    The work of a step is τ q̇ Δt with the motor's torque in the step and the mean of the speeds before and after it:
    what a constant torque adds to the kinetic energy. With the speed after it, as the engine's semi-implicit
    integration moves the joint, each change of speed would add (τ Δt)²/2 I, which recovery does not return.
    """

    def __init__(self, joints: Sequence[Joint]) -> None:
        """Start at rest.

        Args:
            joints: The arm's joints with their limits.
        """
        self._joints = joints
        self._limits = np.array([joint.torque_n_m for joint in joints])
        self._peak = np.zeros(len(joints))
        self._speeds_rad_s = np.zeros(len(joints))
        self._absolute_j: list[float] = []
        self._net_j: list[float] = []

    def note_all(self, torques_n_m: Array, speeds_rad_s: Array, step_s: float) -> None:
        """Add steps.

        Args:
            torques_n_m: Torque of each joint in each step, shape (steps, joints); clipped to the joints' limits.
            speeds_rad_s: Speed of each joint after each step, shape (steps, joints).
            step_s: Length of a step.
        """
        before = np.vstack([self._speeds_rad_s, speeds_rad_s[:-1]])
        work = np.clip(torques_n_m, -self._limits, self._limits) * (before + speeds_rad_s) / 2.0 * step_s
        self._absolute_j.append(math.fsum(np.abs(work).ravel().tolist()))
        self._net_j.append(math.fsum(work.ravel().tolist()))
        self._speeds_rad_s = np.array(speeds_rad_s[-1])
        self._peak = np.maximum(self._peak, np.abs(speeds_rad_s).max(axis=0))

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit."""
        return {
            "joint_work_j": math.fsum(self._absolute_j),
            "joint_net_work_j": math.fsum(self._net_j),
            **speed_metrics(self._peak, self._joints),
        }
