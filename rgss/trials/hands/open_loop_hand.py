"""Hand of fingers that are only commanded to open or to close: no force or position is read."""

from __future__ import annotations

from rgss.scenes import Gripper, Scene
from rgss.trials.hands.finger_hand import FingerHand


class OpenLoopHand(FingerHand):
    """Fingers whose commands take a fixed time; they press with all of their force, and it is never increased."""

    has_force_feedback = False

    def __init__(self, gripper: Gripper, command_s: float) -> None:
        """Take the gripper.

        Args:
            gripper: Its shape, speed and force.
            command_s: Time that a command takes.
        """
        super().__init__(gripper)
        self._command_s = command_s

    def closing_s(self, scene: Scene, firm_s: float) -> float:
        """Time of the command, by which the object is held."""
        return max(self._command_s, super().closing_s(scene, firm_s))

    def opening_s(self, scene: Scene) -> float:  # noqa: ARG002 - it is the same for each
        """Time of the command."""
        return self._command_s

    @property
    def least_closing_s(self) -> float:
        """Time of the command."""
        return self._command_s

    @property
    def least_opening_s(self) -> float:
        """Time of the command."""
        return self._command_s
