"""Open-loop hand: fingers are commanded to open or close without feedback of force or position."""

from __future__ import annotations

from rgss.scenes import Gripper, Scene
from rgss.trials.hands.finger_hand import FingerHand


class OpenLoopHand(FingerHand):
    """Hand whose commands take a fixed time; fingers press with their full, constant force."""

    has_force_feedback = False

    def __init__(self, gripper: Gripper, command_s: float) -> None:
        """Store the gripper's parameters.

        Args:
            gripper: Its shape, speed and force.
            command_s: Duration of a command.
        """
        super().__init__(gripper)
        self._command_s = command_s

    def closing_s(self, scene: Scene, firm_s: float) -> float:
        """Duration of the command, after which the object is held."""
        return max(self._command_s, super().closing_s(scene, firm_s))

    def opening_s(self, scene: Scene) -> float:  # noqa: ARG002 - it is the same for each
        """Duration of the command."""
        return self._command_s

    @property
    def least_closing_s(self) -> float:
        """Duration of the command."""
        return self._command_s

    @property
    def least_opening_s(self) -> float:
        """Duration of the command."""
        return self._command_s
