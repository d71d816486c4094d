"""Hand of prismatic fingers that close by the same stroke, with a sensor of each finger's force."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.scenes import Gripper, Scene, grasp_opening_m, misfit

_FAIR_PART = 0.5


class FingerHand:
    """Fingers in any mounting, on the axis or apart from it."""

    has_force_feedback = True

    def __init__(self, gripper: Gripper) -> None:
        """Take the gripper.

        Args:
            gripper: Its shape, speed and the condition of a firm grasp.
        """
        self._gripper = gripper

    def misfit(self, scene: Scene) -> str:
        """Why the object is too wide to enter or too narrow to be touched; empty where it fits."""
        return misfit(self._gripper.geometry, scene)

    def closing_s(self, scene: Scene, firm_s: float) -> float:
        """Travel to the object at the finger velocity, and the time for which the grasp must be firm."""
        return self.travel_s(scene) + firm_s

    def travel_s(self, scene: Scene) -> float:
        """Travel from open to the object at the finger velocity.

        Args:
            scene: The scene, with the object as its workpiece.
        """
        geometry = self._gripper.geometry
        travel_m = min(geometry.stroke_m, geometry.largest_opening_m - grasp_opening_m(scene, geometry))
        return travel_m / self._gripper.finger_velocity_m_s

    def opening_s(self, scene: Scene) -> float:
        """The same travel back."""
        return self.travel_s(scene)

    @property
    def longest_travel_s(self) -> float:
        """The stroke at the finger velocity."""
        return self._gripper.geometry.stroke_m / self._gripper.finger_velocity_m_s

    @property
    def least_closing_s(self) -> float:
        """None: a grasp that is firm is complete."""
        return 0.0

    @property
    def least_opening_s(self) -> float:
        """None: fingers are open when they have travelled."""
        return 0.0

    def needed_force_n(self, weight_n: float, friction: float) -> float:
        """The stated reaction of a finger, else the force that friction needs to hold the weight."""
        stated_n = self._gripper.drive.firm_force_n
        return weight_n / (friction * self._gripper.geometry.fingers) if stated_n is None else stated_n

    def shortfall(self, forces_n: Sequence[float], needed_n: float) -> str:
        """The force of each finger beside the one that it needs."""
        shown = ", ".join(f"{force:.2f}" for force in forces_n)
        return f"fingers press with {shown} N, each needs {needed_n:.2f} N"

    def is_firm(self, forces_n: Sequence[float], needed_n: float) -> bool:
        """True if each finger's reaction exceeds the stated one, or together they have what friction needs.

        Coupled fingers share their force: while the object stands, its support takes the difference
        between them, so that one may press with less than its part although together they hold.
        """
        if self._gripper.drive.firm_force_n is not None:
            return min(forces_n) > needed_n
        return min(forces_n) > _FAIR_PART * needed_n and math.fsum(forces_n) > len(forces_n) * needed_n
