"""Fingers of a mechanism that slide towards the tool axis, and the directions from which they do."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.scenes.linkage import Linkage, LinkageLink
from rgss.scenes.pose import Pose

_LEAST_TRAVEL_M = 1.0e-3
_LEAST_SHARE = 0.99
_APART_DEG = 10


def finger_azimuths_deg(linkage: Linkage) -> tuple[int, ...]:
    """Azimuths about the tool axis, in degrees from 0, of the links that slide straight towards the axis or from it.

    Args:
        linkage: The mechanism, with any of its ends as the open one; its pads are not read.
    """
    found: list[int] = []
    ends = zip(linkage.links, linkage.link_poses(linkage.opened), linkage.link_poses(linkage.closed), strict=True)
    for link, one, other in ends:
        azimuth = _azimuth_deg(link, one, other)
        if azimuth is not None and all(_APART_DEG <= abs(azimuth - known) <= 360 - _APART_DEG for known in found):
            found.append(azimuth)
    return tuple(sorted(found))


def _azimuth_deg(link: LinkageLink, one: Pose, other: Pose) -> int | None:
    """Azimuth of a link, if it has a shape and its travel points to the tool axis."""
    corners = [corner for hull in link.hulls_m for corner in hull]
    if not corners:
        return None
    places = [_middle(pose, corners) for pose in (one, other)]
    outer, inner = sorted(places, key=lambda place: math.hypot(*place[:2]), reverse=True)
    travel_m = math.dist(outer, inner)
    inwards_m = math.hypot(*outer[:2]) - math.hypot(*inner[:2])
    if travel_m < _LEAST_TRAVEL_M or inwards_m < _LEAST_SHARE * travel_m:
        return None
    return round(math.degrees(math.atan2(outer[1], outer[0]))) % 360


def _middle(pose: Pose, corners: Sequence[tuple[float, float, float]]) -> tuple[float, float, float]:
    places = [(pose @ Pose(position_m=corner)).position_m for corner in corners]
    x, y, z = (math.fsum(place[axis] for place in places) / len(places) for axis in range(3))
    return x, y, z
