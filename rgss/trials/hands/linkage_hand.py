"""Hand of a linkage, whose links come down to the object while the pads close on it."""

from __future__ import annotations

from functools import cached_property

from rgss.kinematics import ClosingLinks
from rgss.scenes import Scene
from rgss.trials.hands.finger_hand import FingerHand


class LinkageHand(FingerHand):
    """Hand of two coupled fingers with a force sensor in each."""

    def misfit(self, scene: Scene) -> str:
        """Reason why the object cannot be held; empty if it can: its width, or a link that meets it before the pads."""
        unfit = super().misfit(scene)
        contact = None if unfit else self._links.contact(scene)
        if contact is None:
            return unfit
        return f"{contact.link} would be {-1e3 * contact.distance_m:.3g} mm in the object when the pads touch it"

    @cached_property
    def _links(self) -> ClosingLinks:
        return ClosingLinks(self._gripper.geometry)
