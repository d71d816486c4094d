"""Contact elements of a finger's pad for physics engines, depending on the contact patch.

An engine detects one contact point of a pair of shapes in a step. A pad therefore consists of round elements, each with
one contact point that is detected at once: two ribs across the ends of a line patch, four knobs at the corners of a
face patch, or one knob at a point patch.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from rgss.scenes.grasps.pad_contact import PadPatch, pad_patches
from rgss.scenes.grasps.rib_geometry import RIBS, PadRibs, pad_ribs
from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.pose import Pose
from rgss.scenes.shapes import Box, Cylinder, ObjectShape

_LARGEST_RADIUS_M = 0.004
_RADIUS_SHARE = 0.25
_PROUD_SHARE = 0.75
_LINE_M = 1.0e-3


@dataclass(frozen=True, slots=True, kw_only=True)
class PadElement:
    """Capsule of a pad, tangent to the plane of the flat pad; of length 0, a sphere.

    Attributes:
        across_m: Position along the finger's width.
        height_m: Position along the finger, from its centre.
        is_across: True if its axis is across the finger, False if along it.
        length_m: Length of its cylinder.
    """

    across_m: float
    height_m: float
    is_across: bool
    length_m: float


@dataclass(frozen=True, slots=True, kw_only=True)
class PadLayout:
    """The elements of the pad of one finger.

    Attributes:
        radius_m: Radius of each element.
        proud_m: Height of the elements above the rest of the finger.
        elements: The elements.
    """

    radius_m: float
    proud_m: float
    elements: tuple[PadElement, ...]


def ribbed_layout(ribs: PadRibs, finger: Box) -> PadLayout:
    """Layout of a pad of two ribs across the finger."""
    length_m = finger.size_m[1] - 2 * ribs.radius_m
    return PadLayout(
        radius_m=ribs.radius_m,
        proud_m=ribs.proud_m,
        elements=tuple(
            PadElement(across_m=0.0, height_m=height_m, is_across=True, length_m=length_m)
            for height_m in ribs.heights_m
        ),
    )


def pad_layouts(geometry: GripperGeometry, shape: ObjectShape, tool_in_object: Pose | None) -> tuple[PadLayout, ...]:
    """Contact elements of the pad of each finger.

    Args:
        geometry: The gripper's shape.
        shape: The object's solid.
        tool_in_object: Transform of the grasp-centre frame to the object's frame; None for a cylinder held at its
            centre with the gripper along its axis.
    """
    if tool_in_object is None:
        if not isinstance(shape, Cylinder):
            raise AssertionError("only a cylinder can be held without a stated grasp")
        return (ribbed_layout(pad_ribs(geometry, shape), geometry.finger),) * geometry.fingers
    patches = pad_patches(shape, tool_in_object, geometry)
    if patches is None:
        return (_plain(geometry),) * geometry.fingers
    return tuple(_layout(patch, geometry) for patch in patches)


def joined_layout(layouts: Sequence[PadLayout]) -> PadLayout:
    """Layout of one pad with the elements of several, for objects of different forms.

    All elements are tangent to the plane of the flat pad, so that an object touches those in its own contact patch
    before any other.

    Args:
        layouts: The layouts; the least radius is used for all elements.
    """
    least = min(layouts, key=lambda layout: layout.radius_m)
    elements = (
        # A shorter cylinder of a larger radius ends where a longer one of the least radius does.
        replace(one, length_m=one.length_m + 2 * (layout.radius_m - least.radius_m) if one.length_m else 0.0)
        for layout in layouts
        for one in layout.elements
    )
    return replace(least, elements=tuple(dict.fromkeys(elements)))


def most_elements(layouts: Sequence[PadLayout]) -> int:
    """Greatest number of elements of a pad, the divisor of its stiffness; at least that of a ribbed pad."""
    return max([RIBS, *(len(layout.elements) for layout in layouts)])


def _plain(geometry: GripperGeometry) -> PadLayout:
    """Layout for a grasp without a contact patch: four knobs at the corners of the pad."""
    _, width_m, length_m = geometry.finger.size_m
    start = geometry.base.height_m - geometry.grasp_depth_m
    whole = PadPatch(
        opening_m=0.0,
        across_m=(-width_m / 2, width_m / 2),
        along_m=(start, start + length_m),
        slope=1.0,
        is_on_rim=False,
    )
    return _layout(whole, geometry)


def _layout(patch: PadPatch, geometry: GripperGeometry) -> PadLayout:
    thickness_m, width_m, length_m = geometry.finger.size_m
    to_centre = geometry.grasp_depth_m - geometry.base.height_m - length_m / 2
    wide, long = (high - low for low, high in (patch.across_m, patch.along_m))
    extents = [extent for extent in (wide, long) if extent > _LINE_M]
    radius = min(_LARGEST_RADIUS_M, _RADIUS_SHARE * min(thickness_m, width_m, *extents))
    low_y, high_y = _inset(patch.across_m, radius, width_m / 2)
    low_z, high_z = _inset(patch.along_m, radius, math.inf)
    heights, places = (low_z + to_centre, high_z + to_centre), (low_y, high_y)
    if wide <= _LINE_M < long:
        rib = PadElement(across_m=0.0, height_m=0.0, is_across=True, length_m=width_m - 2 * radius)
        elements = [replace(rib, height_m=height) for height in heights]
    elif long <= _LINE_M < wide:
        rib = PadElement(across_m=0.0, height_m=0.0, is_across=False, length_m=length_m - 2 * radius)
        elements = [replace(rib, across_m=place) for place in places]
    elif max(wide, long) <= _LINE_M:
        elements = [PadElement(across_m=low_y, height_m=heights[0], is_across=True, length_m=0.0)]
    else:
        elements = [
            PadElement(across_m=place, height_m=height, is_across=True, length_m=0.0)
            for height in heights
            for place in places
        ]
    return PadLayout(radius_m=radius, proud_m=_PROUD_SHARE * radius, elements=tuple(elements))


def _inset(ends: tuple[float, float], radius_m: float, limit_m: float) -> tuple[float, float]:
    """Ends of a patch, inset by the radius of an element; its middle if it is narrower."""
    low, high = ends
    if high - low <= _LINE_M:
        middle = min(max((low + high) / 2, radius_m - limit_m), limit_m - radius_m)
        return middle, middle
    return low + radius_m, high - radius_m
