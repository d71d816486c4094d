"""Hands: gripping and releasing by each kind of gripper, one module for each kind."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.hands.hands import hand_of
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
