"""Grasps of objects: choice among candidates, contact patches and contact elements of pads."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.scenes.grasps.grasp_choice import Approach, ChosenGrasp, GivenGrasp, GraspCandidates, SuctionPoint
    from rgss.scenes.grasps.pad_contact import PadPatch, pad_patches, rotation_of, settled_grasp, surface_of
    from rgss.scenes.grasps.pad_layout import PadLayout, joined_layout, most_elements, pad_layouts
    from rgss.scenes.grasps.rib_geometry import RIBS
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
