"""Hand of one suction cup: a grasp is firm when its seal holds the object's weight."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.scenes import Gripper, Suction, Workpiece, misfit


class SuctionHand:
    """A suction cup, switched on and off; it has no force to be increased."""

    has_force_feedback = False

    def __init__(self, gripper: Gripper, suction: Suction) -> None:
        """Take the gripper.

        Args:
            gripper: Its shape and greatest normal force.
            suction: What its cup holds.
        """
        self._gripper = gripper
        self._suction = suction

    def misfit(self, workpiece: Workpiece) -> str:
        """Why the cup does not seal on the top of the object; empty where it does."""
        return misfit(self._gripper.geometry, workpiece.shape)

    def closing_s(self, workpiece: Workpiece) -> float:  # noqa: ARG002 - it is the same for each
        """Time until the whole vacuum holds."""
        return self._suction.build_up_s

    def opening_s(self, workpiece: Workpiece) -> float:  # noqa: ARG002 - it is the same for each
        """Time until the object is free."""
        return self._suction.release_s

    @property
    def longest_travel_s(self) -> float:
        """The longer of the two."""
        return max(self._suction.build_up_s, self._suction.release_s)

    @property
    def least_opening_s(self) -> float:
        """Time until the object is free."""
        return self._suction.release_s

    def needed_force_n(self, weight_n: float, friction: float) -> float:
        """The holding force that the weight needs in any direction."""
        return weight_n / self._gripper.grip_coefficient(friction)

    def is_firm(self, forces_n: Sequence[float], needed_n: float) -> bool:
        """True if the vacuum holds the object."""
        return min(forces_n) > needed_n
