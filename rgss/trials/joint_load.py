"""How hard the joints worked: what torques they needed, and which of them reached their limit."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.evidence import Metric
from rgss.scenes import Joint

_AT_THE_LIMIT = 1.0 - 1.0e-6


class JointLoad:
    """The torques of a phase, step by step.

    Attributes:
        saturated: The joints that reached their limit, in the order in which they did. The first is
            the cause; the others may have followed it.
    """

    def __init__(self, joints: Sequence[Joint]) -> None:
        """Begin with no load.

        Args:
            joints: The arm's joints with their limits.
        """
        self.saturated: list[int] = []
        self._names = [joint.name for joint in joints]
        self._limits = [joint.torque_n_m for joint in joints]
        self._reached = [_AT_THE_LIMIT * limit for limit in self._limits]
        self._peak = [0.0] * len(joints)
        self._saturated_s = [0.0] * len(joints)

    def note(self, torques_n_m: Sequence[float], step_s: float) -> None:
        """Add one step.

        Args:
            torques_n_m: Torque of each joint: what its motor gave, or what its controller asked for.
            step_s: Length of the step.
        """
        for index, torque in enumerate(torques_n_m):
            size = -torque if torque < 0.0 else torque
            if size > self._peak[index]:
                self._peak[index] = size
            if size >= self._reached[index]:
                self._saturated_s[index] += step_s
                if index not in self.saturated:
                    self.saturated.append(index)

    def words(self) -> str:
        """Which joints reached their limit, to follow what went wrong; empty if none did."""
        if not self.saturated:
            return ""
        return f"; at its torque limit: {', then '.join(self._names[index] for index in self.saturated)}"

    def metrics(self) -> dict[str, Metric]:
        """The observations by name with unit; a joint's torque is never above its limit, and joints count from 1."""
        given = tuple(min(peak, limit) for peak, limit in zip(self._peak, self._limits, strict=True))
        ratios = [peak / limit for peak, limit in zip(given, self._limits, strict=True)]
        return {
            "peak_joint_torque_n_m": given,
            "peak_joint_torque_ratio": max(ratios),
            "most_loaded_joint": 1 + ratios.index(max(ratios)),
            "joint_saturated_s": tuple(self._saturated_s),
        }
