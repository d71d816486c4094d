"""Interface of a hand: how a kind of gripper takes and releases an object."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from rgss.scenes import Scene


class Hand(Protocol):
    """A gripper as the task program uses it, of any kind and at any fidelity."""

    has_force_feedback: bool
    """Whether it reads its force and can increase it while the object is carried."""

    def misfit(self, scene: Scene) -> str:
        """Why the hand cannot hold an object by its size or shape; empty where it can.

        Args:
            scene: The scene, with the object as its workpiece.
        """

    def closing_s(self, scene: Scene, firm_s: float) -> float:
        """Time from the command to close until the grasp is firm.

        Args:
            scene: The scene, with the object as its workpiece.
            firm_s: Time for which a grasp must be firm where the hand reads its force.
        """

    def opening_s(self, scene: Scene) -> float:
        """Time from the command to open until the hand is open.

        Args:
            scene: The scene, with the object that was held as its workpiece.
        """

    @property
    def longest_travel_s(self) -> float:
        """Time that the hand needs over its whole travel."""

    @property
    def least_closing_s(self) -> float:
        """Time that closing takes even where the object is firmly held before."""

    @property
    def least_opening_s(self) -> float:
        """Time that opening takes even where no finger travels."""

    def needed_force_n(self, weight_n: float, friction: float) -> float:
        """Normal force of each finger above which a grasp counts as firm.

        Args:
            weight_n: Weight of the object, as the robot knows it.
            friction: Coefficient of a finger on the object, as the robot knows it.
        """

    def shortfall(self, forces_n: Sequence[float], needed_n: float) -> str:
        """What is short of a firm grasp, for the detail of a failure.

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
