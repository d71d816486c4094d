"""The grasp polygon: the contacts seen along the axis of the grasp, one corner for each finger."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import ContactPoint, Matrix, Vector3
from rgss.grasping.grasp import Grasp

FEWEST_CORNERS = 3
"""Corners of the smallest polygon that has angles."""

_COINCIDENT = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GraspPolygon:
    """A polygon in a plane across the axis of the grasp.

    Attributes:
        corners_m: In their order round their mean, in the plane, shape (k, 2); measured from the centre of mass.
        centroid_m: Of its area, in space, from the centre of mass, shape (3,). Along the axis it is as high as the
            corners are on average; where there is no area it is the middle of the segment.
        is_flat: Tells whether it has no area: fewer than three corners, or all in a line.
    """

    corners_m: Matrix
    centroid_m: Matrix
    is_flat: bool


def grasp_polygon(grasp: Grasp, grasp_axis: Vector3 | None = None) -> GraspPolygon:
    """Make the polygon of a grasp.

    The points of one finger make one corner: their mean, weighted by their normal forces where they press. Corners that
    coincide count once, and they are joined in the order of their direction from their mean, which never crosses
    itself.

    Args:
        grasp: The grasp.
        grasp_axis: The direction along which the contacts are looked at, such as the gripper's axis. None stands for
            the normal of the plane that fits the corners best.

    Raises:
        DefinitionError: The axis has no direction.
    """
    corners = _finger_points(grasp)
    mean = corners.mean(axis=0)
    # The last right singular vector is the direction in which the corners spread least.
    axis = np.array(_unit(grasp_axis)) if grasp_axis is not None else np.linalg.svd(corners - mean)[2][2]
    plane = ContactPoint(position_m=(0.0, 0.0, 0.0), normal=tuple(axis.tolist())).axes()[1:]
    centre = plane @ mean
    ring = _ring(corners @ plane.T, centre, _COINCIDENT * grasp.characteristic_length_m)
    middle, is_flat = _centroid(ring, _COINCIDENT * grasp.characteristic_length_m)
    return GraspPolygon(corners_m=ring, centroid_m=middle @ plane + (axis @ mean) * axis, is_flat=is_flat)


def internal_angles(corners_m: Matrix) -> Matrix:
    """Internal angles (rad) of a simple polygon that is given counter-clockwise, shape (k,), each from 0 to 2π."""
    back = np.roll(corners_m, 1, axis=0) - corners_m
    ahead = np.roll(corners_m, -1, axis=0) - corners_m
    cross = ahead[:, 0] * back[:, 1] - ahead[:, 1] * back[:, 0]
    angles: Matrix = np.arctan2(cross, np.sum(ahead * back, axis=1)) % (2.0 * math.pi)
    return angles


def worst_deviation(corners: int) -> float:
    """The greatest sum of |θ_i - θ̄| (rad) that a convex polygon can have: θ_max of equation 3.9.

    With θ̄ = π (k - 2) / k, it is that of a polygon pressed into a line, which has two angles of 0 and k - 2 of π:
    (k - 2)(π - θ̄) + 2 θ̄ = 4 θ̄ (Roa and Suárez, Grasp quality measures, 2015).
    """
    return 4.0 * math.pi * (corners - 2) / corners


def _unit(vector: Vector3) -> Vector3:
    length = math.hypot(*vector)
    if not 0.0 < length < math.inf:
        raise DefinitionError(f"{vector} is not an axis of a grasp", hint="give three finite numbers, not all zero")
    return vector[0] / length, vector[1] / length, vector[2] / length


def _finger_points(grasp: Grasp) -> Matrix:
    arms, points = grasp.arms_m(), []
    for members in grasp.fingers():
        weights = np.array([grasp.contacts[index].normal_force_n for index in members])
        if not weights.sum() > 0.0:
            weights = np.ones(len(members))
        points.append(weights @ arms[list(members)] / weights.sum())
    return np.array(points)


def _ring(points: Matrix, centre: Matrix, tolerance: float) -> Matrix:
    """The distinct points, counter-clockwise about a centre."""
    kept: list[Matrix] = []
    for point in points:
        if all(np.linalg.norm(point - other) > tolerance for other in kept):
            kept.append(point)
    ring = np.array(kept)
    spokes = ring - centre
    order = np.lexsort((np.hypot(spokes[:, 0], spokes[:, 1]), np.arctan2(spokes[:, 1], spokes[:, 0])))
    ordered: Matrix = ring[order]
    return ordered


def _centroid(ring: Matrix, tolerance: float) -> tuple[Matrix, bool]:
    """Centroid of a polygon's area, or of the segment that it is pressed into, and whether it is."""
    mean = ring.mean(axis=0)
    directions = np.linalg.svd(ring - mean)[2]
    spread = (ring - mean) @ directions.T
    if len(ring) < FEWEST_CORNERS or np.ptp(spread[:, 1]) <= tolerance:
        middle: Matrix = mean + (spread[:, 0].min() + spread[:, 0].max()) / 2.0 * directions[0]
        return middle, True
    spokes, following = ring - mean, np.roll(ring, -1, axis=0) - mean
    areas = spokes[:, 0] * following[:, 1] - spokes[:, 1] * following[:, 0]
    centroid: Matrix = mean + areas @ (spokes + following) / (3.0 * areas.sum())
    return centroid, False
