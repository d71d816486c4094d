"""Kinds of grippers by their files, one module for each kind."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.hands.fit import misfit, suction_point_of, too_narrow, too_wide, unsealed
    from rgss.scenes.hands.height_fit import palm_fit
    from rgss.scenes.hands.kinds import GRIPPER_KINDS, kind_of_gripper
    from rgss.scenes.hands.linkage_fit import at_object
    from rgss.scenes.hands.linkage_gripper import LinkageGripper, pad_limits
    from rgss.scenes.hands.linkage_shape import at_opening
    from rgss.scenes.hands.pad_search import FoundPads, MechanismError, find_pads
    from rgss.scenes.hands.tool_at_object import object_in_hand, tool_with_pads_at
    from rgss.scenes.hands.unpowered import unpowered_shortfall
    from rgss.scenes.hands.vacuum_gripper import at_top
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
