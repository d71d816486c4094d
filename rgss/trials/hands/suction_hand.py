"""Hand of one suction cup: a grasp is firm when its seal holds the object's weight."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.scenes import Gripper, Scene, Suction, misfit

_WHOLE = 0.999


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

    def misfit(self, scene: Scene) -> str:
        """Why the cup does not seal on the top of the object; empty where it does."""
        return misfit(self._gripper.geometry, scene)

    def closing_s(self, scene: Scene, firm_s: float) -> float:  # noqa: ARG002 - it is the same for each
        """Time until the whole vacuum holds, and for which it must."""
        return self._suction.build_up_s + firm_s

    def opening_s(self, scene: Scene) -> float:  # noqa: ARG002 - it is the same for each
        """Time until the object is free."""
        return self._suction.release_s

    @property
    def longest_travel_s(self) -> float:
        """The longer of the two."""
        return max(self._suction.build_up_s, self._suction.release_s)

    @property
    def least_closing_s(self) -> float:
        """None: the vacuum switch reports when it is whole."""
        return 0.0

    @property
    def least_opening_s(self) -> float:
        """Time until the object is free."""
        return self._suction.release_s

    def needed_force_n(self, weight_n: float, friction: float) -> float:  # noqa: ARG002 - a cup needs none
        """The weight, which hangs along the axis of the cup."""
        return weight_n

    def shortfall(self, forces_n: Sequence[float], needed_n: float) -> str:
        """The force of the vacuum beside the weight."""
        return f"the cup holds {min(forces_n):.2f} N, the object weighs {needed_n:.2f} N"

    def is_firm(self, forces_n: Sequence[float], needed_n: float) -> bool:
        """True if the whole vacuum is built up, as a vacuum switch reports it, and exceeds the weight."""
        whole_n = (1.0 - self._suction.leak) * self._gripper.finger_force_n
        return min(forces_n) >= _WHOLE * whole_n and min(forces_n) > needed_n
