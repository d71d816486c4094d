"""Mimic joints of an arm: joints that follow one of its driven joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.scenes.joints.joint_kind import JointKind


@dataclass(frozen=True, slots=True, kw_only=True)
class Follower:
    """Joint of an arm that follows a driven joint: q = multiplier q_driver + offset.

    Attributes:
        name: Its name in the robot description.
        driver: Index of the driven joint among the joints of the arm.
        multiplier: Its displacement per displacement of the driven joint; not zero.
        offset: Its position where the driven joint is at zero, in rad or m.
        effort: Greatest torque in N·m, or force in N, that the coupling transmits to it; infinite if the URDF has none.
        kind: Kind of the joint.
    """

    name: str
    driver: int
    multiplier: float
    offset: float
    effort: float
    kind: JointKind

    def position(self, driven: Sequence[float]) -> float:
        """Its position in rad or m.

        Args:
            driven: Positions of the driven joints, shape (n,).
        """
        return self.multiplier * driven[self.driver] + self.offset
