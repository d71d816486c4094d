"""Hand with one suction cup: a grasp is firm when its seal holds the object's weight."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.scenes import Gripper, Scene, Suction, misfit

_WHOLE = 0.999


class SuctionHand:
    """Suction cup, switched on and off, without force control."""

    has_force_feedback = False

    def __init__(self, gripper: Gripper, suction: Suction) -> None:
        """Store the gripper's parameters.

        Args:
            gripper: Its shape and greatest normal force.
            suction: Its suction cup.
        """
        self._gripper = gripper
        self._suction = suction

    def misfit(self, scene: Scene) -> str:
        """Reason why the cup does not seal on the top of the object; empty if it does."""
        return misfit(self._gripper.geometry, scene)

    def closing_s(self, scene: Scene, firm_s: float) -> float:  # noqa: ARG002 - it is the same for each
        """Time to full vacuum, plus the required duration of a firm grasp."""
        return self._suction.build_up_s + firm_s

    def opening_s(self, scene: Scene) -> float:  # noqa: ARG002 - it is the same for each
        """Time to the release of the object."""
        return self._suction.release_s

    @property
    def longest_travel_s(self) -> float:
        """The longer of build-up and release."""
        return max(self._suction.build_up_s, self._suction.release_s)

    @property
    def least_closing_s(self) -> float:
        """Zero: the vacuum switch reports full vacuum."""
        return 0.0

    @property
    def least_opening_s(self) -> float:
        """Time to the release of the object."""
        return self._suction.release_s

    def needed_force_n(self, weight_n: float, friction: float) -> float:  # noqa: ARG002 - a cup needs none
        """The weight, which acts along the axis of the cup."""
        return weight_n

    def shortfall(self, forces_n: Sequence[float], needed_n: float) -> str:
        """Message with the force of the vacuum, and that which must be exceeded."""
        return f"the cup holds {min(forces_n):.2f} N, a firm grasp needs more than {needed_n:.2f} N"

    def is_firm(self, forces_n: Sequence[float], needed_n: float) -> bool:
        """True at full vacuum, as reported by a vacuum switch, whose force exceeds the weight."""
        whole_n = (1.0 - self._suction.leak) * self._gripper.finger_force_n
        return min(forces_n) >= _WHOLE * whole_n and min(forces_n) > needed_n
