"""Factory of hands."""

from __future__ import annotations

from rgss.scenes import Gripper
from rgss.trials.hands.finger_hand import FingerHand
from rgss.trials.hands.hand import Hand
from rgss.trials.hands.linkage_hand import LinkageHand
from rgss.trials.hands.open_loop_hand import OpenLoopHand
from rgss.trials.hands.suction_hand import SuctionHand


def hand_of(gripper: Gripper) -> Hand:
    """Hand of a gripper, by its kind."""
    if gripper.suction is not None:
        return SuctionHand(gripper, gripper.suction)
    if gripper.drive.command_s is not None:
        return OpenLoopHand(gripper, gripper.drive.command_s)
    return FingerHand(gripper) if gripper.geometry.linkage is None else LinkageHand(gripper)
