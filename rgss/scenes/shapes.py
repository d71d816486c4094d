"""Primitive shapes: one for each body, so that every engine sees the same solid."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A box centred in its frame.

    Attributes:
        size_m: Full edge lengths along x, y, z.
    """

    size_m: tuple[float, float, float]

    @property
    def half_height_m(self) -> float:
        """Half the extent along z."""
        return self.size_m[2] / 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Cylinder:
    """A cylinder centred in its frame, its axis along z.

    Attributes:
        radius_m: Radius.
        height_m: Full height.
    """

    radius_m: float
    height_m: float

    @property
    def half_height_m(self) -> float:
        """Half the extent along z."""
        return self.height_m / 2


Shape = Box | Cylinder
