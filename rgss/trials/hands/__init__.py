"""Hands: how each kind of gripper takes and releases an object, one module a kind."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.hands.finger_hand import FingerHand
    from rgss.trials.hands.hand import Hand
    from rgss.trials.hands.hands import hand_of
    from rgss.trials.hands.open_loop_hand import OpenLoopHand
    from rgss.trials.hands.suction_hand import SuctionHand
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
