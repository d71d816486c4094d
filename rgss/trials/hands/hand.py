"""Interface of a hand: gripping and releasing by a kind of gripper."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rgss.scenes import Scene


class Hand(Protocol):
    """Interface of a gripper for the task program, of any kind and at any fidelity."""

    has_force_feedback: bool
    """True if it senses its force and can increase it while the object is carried."""

    def misfit(self, scene: Scene) -> str:
        """Reason why an object does not fit the hand by size or shape; empty if it fits."""

    def closing_s(self, scene: Scene, firm_s: float) -> float:
        """Time in s from the command to close to a firm grasp.

        Args:
            scene: The scene, with the object as its workpiece.
            firm_s: Required duration of a firm grasp for a hand that senses its force.
        """

    def opening_s(self, scene: Scene) -> float:
        """Time in s from the command to open to the open hand.

        Args:
            scene: The scene, with the held object as its workpiece.
        """

    @property
    def longest_travel_s(self) -> float:
        """Time in s of the full travel."""

    @property
    def least_closing_s(self) -> float:
        """Least time of closing in s, even if the object is firmly held earlier."""

    @property
    def least_opening_s(self) -> float:
        """Least time of opening in s, even without travel."""

    def needed_force_n(self, weight_n: float, friction: float) -> float:
        """Threshold in N of each finger's normal force for a firm grasp.

        Args:
            weight_n: Weight of the object assumed by the robot.
            friction: Coefficient of a finger on the object assumed by the robot.
        """

    def shortfall(self, forces_n: Sequence[float], needed_n: float) -> str:
        """Message about a grasp that is not firm, for the detail of a failure.

        Args:
            forces_n: Normal force of each finger.
            needed_n: Force that each finger must have.
        """

    def is_firm(self, forces_n: Sequence[float], needed_n: float) -> bool:
        """True if the fingers hold the object firmly.

        Args:
            forces_n: Normal force of each finger.
            needed_n: Force that each finger must have.
        """
