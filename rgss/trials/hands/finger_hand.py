"""Hand of prismatic fingers with equal stroke and a force sensor in each finger."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.scenes import Gripper, Scene, grasp_opening_m, misfit

_FAIR_PART = 0.5


class FingerHand:
    """Hand with fingers in any mounting."""

    has_force_feedback = True

    def __init__(self, gripper: Gripper) -> None:
        """Store the gripper's parameters.

        Args:
            gripper: Its shape, speed and the condition of a firm grasp.
        """
        self._gripper = gripper

    def misfit(self, scene: Scene) -> str:
        """Reason why the object is too wide to enter or too narrow to be touched; empty if it fits."""
        return misfit(self._gripper.geometry, scene)

    def closing_s(self, scene: Scene, firm_s: float) -> float:
        """Time in s of the travel to the object at the finger velocity, plus the duration of a firm grasp."""
        return self.travel_s(scene) + firm_s

    def travel_s(self, scene: Scene) -> float:
        """Time in s of the travel from open to the object at the finger velocity."""
        geometry = self._gripper.geometry
        travel_m = min(geometry.stroke_m, geometry.largest_opening_m - grasp_opening_m(scene, geometry))
        return travel_m / self._gripper.finger_velocity_m_s

    def opening_s(self, scene: Scene) -> float:
        """Time of the same travel back."""
        return self.travel_s(scene)

    @property
    def longest_travel_s(self) -> float:
        """Time of the stroke at the finger velocity."""
        return self._gripper.geometry.stroke_m / self._gripper.finger_velocity_m_s

    @property
    def least_closing_s(self) -> float:
        """Zero: a firm grasp is complete."""
        return 0.0

    @property
    def least_opening_s(self) -> float:
        """Zero: fingers are open at the end of their travel."""
        return 0.0

    def needed_force_n(self, weight_n: float, friction: float) -> float:
        """Stated threshold of a finger's force, else the force that friction requires to hold the weight."""
        stated_n = self._gripper.drive.firm_force_n
        return weight_n / (friction * self._gripper.geometry.fingers) if stated_n is None else stated_n

    def shortfall(self, forces_n: Sequence[float], needed_n: float) -> str:
        """Message with the force of each finger and the required force."""
        shown = ", ".join(f"{force:.2f}" for force in forces_n)
        where = "" if any(forces_n) else "nothing is between the fingers: "
        return f"{where}fingers press with {shown} N, each needs {needed_n:.2f} N"

    def is_firm(self, forces_n: Sequence[float], needed_n: float) -> bool:
        """True if each finger's force exceeds the stated threshold, or their sum the force that friction requires.

        Coupled fingers share their force: while the object is supported, the support takes the difference between them,
        so that one may press with less than its share although together they hold.
        """
        if self._gripper.drive.firm_force_n is not None:
            return min(forces_n) > needed_n
        return min(forces_n) > _FAIR_PART * needed_n and math.fsum(forces_n) > len(forces_n) * needed_n
