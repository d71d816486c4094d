"""What grasp candidates need to know of a hand that sucks."""

from __future__ import annotations

from typing import Protocol


class SuctionHand(Protocol):
    """A hand that holds by one suction cup on its axis."""

    @property
    def cup_radius_m(self) -> float:
        """Radius of the cup's lip, which must lie on a flat face."""
        ...
