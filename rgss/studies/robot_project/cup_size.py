"""Size of the object of a new project, and where its gripper's pads hold it: clear of the table and of the links."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import GripperGeometry, Linkage, Pose, at_opening, boss_height_m, motion_of
from rgss.studies.robot_project.layout import Cup

Array = NDArray[np.float64]

_SHARES = (1.0, 0.8, 0.6)
_SHARE_OF_OPENING = 0.55
_CLOSED_ROOM_M, _SIDE_ROOM_M, _TOP_ROOM_M, _TABLE_ROOM_M = 0.003, 0.005, 0.01, 0.012
_LARGEST_FROM_TIP_M, _LEAST_FROM_TIP_M = 0.015, 0.005
_CLOSING_SAMPLES, _EDGE_SAMPLES = 9, 7
_MOST_CORNERS = 160


def cups_of(geometry: GripperGeometry) -> tuple[Cup, ...]:
    """Cups that a linkage can grasp, the largest first; smaller ones leave more room to its links.

    Radius and height are whole millimetres, and those of the usual cup at most.

    Args:
        geometry: The gripper, which has a linkage.
    """
    usual, radius_m = Cup(), _radius_m(geometry)
    cups = []
    for share in _SHARES:
        narrow_m = _whole_mm(max(share * radius_m, _least_radius_m(geometry)))
        closed = at_opening(geometry, narrow_m)
        room_m = closed.grasp_depth_m - _reach_above_m(geometry, narrow_m) - _TOP_ROOM_M
        height_m = max(min(usual.height_m, 2 * room_m), narrow_m)
        cups.append(Cup(radius_m=narrow_m, height_m=_whole_mm(height_m)))
    return tuple(dict.fromkeys(cups))


def grasp_from_tip_m(geometry: GripperGeometry) -> float | None:
    """Distance of the grasp centre from the ends of the pads in m, in whole millimetres; None for their middle.

    An object is held in the middle of its height, so that its half must have room below the grasp centre, for the ends
    of the pads and of what carries them above the table, and above it, below the links that close on it.
    """
    radius_m, half_m = _radius_m(geometry), geometry.finger.size_m[2] / 2
    end_m = at_opening(geometry, radius_m).grasp_depth_m + half_m
    below_links_m = end_m - _reach_above_m(geometry, radius_m) - _TOP_ROOM_M
    past_pads_m = max(0.0, _fingers_end_m(geometry, radius_m) - end_m)
    wanted_m = min(_LARGEST_FROM_TIP_M, (below_links_m - _TABLE_ROOM_M - past_pads_m) / 2)
    return None if wanted_m >= half_m else min(max(_whole_mm(wanted_m), _LEAST_FROM_TIP_M), half_m)


def _radius_m(geometry: GripperGeometry) -> float:
    widest_m = max(_SHARE_OF_OPENING * geometry.largest_opening_m, _least_radius_m(geometry))
    return min(Cup().radius_m, widest_m)


def _least_radius_m(geometry: GripperGeometry) -> float:
    return geometry.largest_opening_m - geometry.stroke_m + _CLOSED_ROOM_M


def _fingers_end_m(geometry: GripperGeometry, radius_m: float) -> float:
    """Greatest distance from the flange of the links with the pads, closed on a cup, in m."""
    linkage = geometry.linkage
    if linkage is None:
        return geometry.base.height_m + geometry.finger.size_m[2]
    motion = motion_of(linkage)
    poses = linkage.link_poses(motion.driven_at(motion.largest_opening_m - radius_m))
    ends = (
        poses[index].position_m[2] + poses[index].rotate(corner)[2]
        for parts in linkage.finger_parts
        for index in parts
        for hull in linkage.links[index].hulls_m
        for corner in hull
    )
    return max(ends)


def _reach_above_m(geometry: GripperGeometry, radius_m: float) -> float:
    """Greatest distance from the flange of what is above a cup while the pads close on it, in m."""
    linkage = geometry.linkage
    if linkage is None:
        return geometry.base.height_m
    motion = motion_of(linkage)
    pads = {pad.link for pad in linkage.pads}
    fingers = {index for parts in linkage.finger_parts for index in parts}
    deepest_m = boss_height_m(linkage)
    for driven in np.linspace(linkage.opened, motion.driven_at(motion.largest_opening_m - radius_m), _CLOSING_SAMPLES):
        for index, pose in enumerate(linkage.link_poses(float(driven))):
            for points_m in () if index in pads else _points(linkage, index, pose):
                # What carries a pad stays as far beside the object as its pad lets it.
                side_m = radius_m if index in fingers else radius_m + _SIDE_ROOM_M
                above = points_m[np.hypot(points_m[:, 0], points_m[:, 1]) < side_m]
                deepest_m = max(deepest_m, float(above[:, 2].max(initial=0.0)))
    return deepest_m


def _points(linkage: Linkage, index: int, pose: Pose) -> list[Array]:
    """Points of each convex shape of a link on the lines between its corners, shape (n, 3), at the flange."""
    shares = np.linspace(0.0, 1.0, _EDGE_SAMPLES)[:, np.newaxis, np.newaxis, np.newaxis]
    found = []
    for hull in linkage.links[index].hulls_m:
        corners = np.array([pose.rotate(corner) for corner in hull[:_MOST_CORNERS]]) + pose.position_m
        between = (1.0 - shares) * corners[:, np.newaxis] + shares * corners[np.newaxis, :]
        found.append(between.reshape(-1, 3))
    return found


def _whole_mm(length_m: float) -> float:
    return math.floor(1e3 * length_m + 1e-9) / 1e3
