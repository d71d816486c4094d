"""Joint torques of a phase and the joints that reached their limit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.evidence import Metric
from rgss.scenes import Joint

_AT_THE_LIMIT = 1.0 - 1.0e-6


class JointLoad:
    """Accumulator of the joint torques of a phase.

    Attributes:
        saturated: The joints that reached their limit, in order of time. The first is the cause; the others may be
        consequences.
    """

    def __init__(self, joints: Sequence[Joint]) -> None:
        """Start without load.

        Args:
            joints: The arm's joints with their limits.
        """
        self.saturated: list[int] = []
        self._names = [joint.name for joint in joints]
        self._limits = [joint.torque_n_m for joint in joints]
        self._reached = _AT_THE_LIMIT * np.array(self._limits)
        self._peak = np.zeros(len(joints))
        self._saturated_steps = np.zeros(len(joints), dtype=np.int64)
        self._step_s = 0.0

    def note(self, torques_n_m: Sequence[float], step_s: float) -> None:
        """Add one step.

        Args:
            torques_n_m: Torque of each joint: actual or commanded.
            step_s: Length of the step.
        """
        self.note_all(np.array([torques_n_m]), step_s)

    def note_all(self, torques_n_m: NDArray[np.float64], step_s: float) -> None:
        """Add steps.

        Args:
            torques_n_m: Torque of each joint in each step, shape (steps, joints).
            step_s: Length of a step.
        """
        sizes = np.abs(torques_n_m)
        reached = sizes >= self._reached
        self._peak = np.maximum(self._peak, sizes.max(axis=0))
        self._saturated_steps += reached.sum(axis=0)
        self._step_s = step_s
        first = reached.argmax(axis=0)
        new = [joint for joint in np.flatnonzero(reached.any(axis=0)).tolist() if joint not in self.saturated]
        self.saturated.extend(sorted(new, key=lambda joint: int(first[joint])))

    def words(self) -> str:
        """Text with the joints that reached their limit, for the detail of a failure; empty if there are none."""
        if not self.saturated:
            return ""
        return f"; at its torque limit: {', then '.join(self._names[index] for index in self.saturated)}"

    def metrics(self) -> dict[str, Metric]:
        """Metrics by name with unit; torques are clipped to the limits, and joints are numbered from 1."""
        given = tuple(min(peak, limit) for peak, limit in zip(self._peak.tolist(), self._limits, strict=True))
        ratios = [peak / limit for peak, limit in zip(given, self._limits, strict=True)]
        return {
            "peak_joint_torque_n_m": given,
            "peak_joint_torque_ratio": max(ratios),
            "most_loaded_joint": 1 + ratios.index(max(ratios)),
            "joint_saturated_s": tuple(steps * self._step_s for steps in self._saturated_steps.tolist()),
        }
