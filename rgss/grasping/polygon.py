"""Grasp polygon: projection of the contacts along the grasp axis, one corner for each finger."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rgss.errors import DefinitionError
from rgss.grasping.contact import ContactPoint, Matrix, Vector3
from rgss.grasping.grasp import Grasp

Point = tuple[float, float]

FEWEST_CORNERS = 3
"""Least number of corners of a polygon with angles."""

_COINCIDENT = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class GraspPolygon:
    """Polygon in the plane perpendicular to the grasp axis.

    Attributes:
        corners_m: Corners in the plane, counter-clockwise about their mean, relative to the centre of mass, shape (k,
        2).
        centroid_m: Centroid of the area in space, relative to the centre of mass, shape (3,). Its coordinate along the
        axis is the corners' mean; without an area it is the midpoint of the segment.
        is_flat: True if it has no area: fewer than three corners, or all collinear.
    """

    corners_m: Matrix
    centroid_m: Matrix
    is_flat: bool


def grasp_polygon(grasp: Grasp, grasp_axis: Vector3 | None = None) -> GraspPolygon:
    """Grasp polygon of a grasp.

    The points of one finger form one corner: their mean, weighted by their normal forces if they press. Coincident
    corners count once, and corners are connected in the order of their direction from their mean, which avoids
    self-intersection.

    Args:
        grasp: The grasp.
        grasp_axis: Direction of projection, such as the gripper's axis. None for the normal of the plane that fits the
            corners best.

    Raises:
        DefinitionError: The axis is zero or not finite.
    """
    # In plain numbers, as the contacts' axes: a polygon has few corners and is computed in every analysis of a grasp.
    corners = _finger_points(grasp)
    count = len(corners)
    x, y, z = (math.fsum(row) / count for row in zip(*corners, strict=True))
    mean = (x, y, z)
    axis = _unit(grasp_axis) if grasp_axis is not None else _axis_of_plane(corners)
    first, second = plane = ContactPoint(position_m=(0.0, 0.0, 0.0), normal=axis).tangents()
    tolerance = _COINCIDENT * grasp.characteristic_length_m
    seen = [(_dot(first, corner), _dot(second, corner)) for corner in corners]
    ring = _ring(seen, (_dot(first, mean), _dot(second, mean)), tolerance)
    (across, up), is_flat = _centroid(ring, tolerance)
    height = _dot(axis, mean)
    centroid = np.array([across * a + up * b + height * c for a, b, c in zip(*plane, axis, strict=True)])
    return GraspPolygon(corners_m=np.array(ring), centroid_m=centroid, is_flat=is_flat)


def internal_angles(corners_m: Matrix) -> Matrix:
    """Internal angles (rad) of a simple counter-clockwise polygon, shape (k,), each from 0 to 2π."""
    corners = [(x, y) for x, y in np.asarray(corners_m).tolist()]
    angles = []
    for (bx, by), (x, y), (ax, ay) in zip(
        (corners[-1], *corners[:-1]), corners, (*corners[1:], corners[0]), strict=True
    ):
        back, ahead = (bx - x, by - y), (ax - x, ay - y)
        cross = ahead[0] * back[1] - ahead[1] * back[0]
        angles.append(math.atan2(cross, ahead[0] * back[0] + ahead[1] * back[1]) % (2.0 * math.pi))
    return np.array(angles)


def worst_deviation(corners: int) -> float:
    """Greatest sum of |θ_i - θ̄| (rad) of a convex polygon: θ_max of equation 3.9.

    With θ̄ = π (k - 2) / k, it is attained by a polygon degenerated to a line, which has two angles of 0 and k - 2 of
    π: (k - 2)(π - θ̄) + 2 θ̄ = 4 θ̄ (Roa and Suárez, Grasp quality measures, 2015).
    """
    return 4.0 * math.pi * (corners - 2) / corners


def _unit(vector: Vector3) -> Vector3:
    length = math.hypot(*vector)
    if not 0.0 < length < math.inf:
        raise DefinitionError(
            f"the axis of a grasp must be a finite, non-zero vector, got {vector}", hint="give three finite numbers"
        )
    return vector[0] / length, vector[1] / length, vector[2] / length


def _axis_of_plane(corners: Sequence[Vector3]) -> Vector3:
    """Normal of the least-squares plane of points."""
    points = np.array(corners)
    # The last right singular vector is the direction of least variance.
    x, y, z = np.linalg.svd(points - points.mean(axis=0))[2][2].tolist()
    return x, y, z


def _dot(one: Vector3, other: Vector3) -> float:
    return one[0] * other[0] + one[1] * other[1] + one[2] * other[2]


def _finger_points(grasp: Grasp) -> list[Vector3]:
    """Mean of each finger's points relative to the centre of mass, weighted by their normal forces if they press."""
    ox, oy, oz = grasp.centre_of_mass_m
    points = []
    for members in grasp.fingers():
        contacts = [grasp.contacts[index] for index in members]
        weights = [contact.normal_force_n for contact in contacts]
        total = math.fsum(weights)
        if not total > 0.0:
            weights, total = [1.0] * len(contacts), float(len(contacts))
        x, y, z = (
            math.fsum(weight * contact.position_m[row] for weight, contact in zip(weights, contacts, strict=True))
            / total
            for row in range(3)
        )
        points.append((x - ox, y - oy, z - oz))
    return points


def _ring(points: Sequence[Point], centre: Point, tolerance: float) -> list[Point]:
    """Distinct points, counter-clockwise about a centre."""
    kept: list[Point] = []
    for point in points:
        if all(math.dist(point, other) > tolerance for other in kept):
            kept.append(point)
    cx, cy = centre
    return sorted(kept, key=lambda point: (math.atan2(point[1] - cy, point[0] - cx), math.dist(point, centre)))


def _centroid(ring: Sequence[Point], tolerance: float) -> tuple[Point, bool]:
    """Centroid of a polygon's area, or midpoint of a degenerate polygon's segment, and True if it is degenerate."""
    count = len(ring)
    mx, my = math.fsum(x for x, _ in ring) / count, math.fsum(y for _, y in ring) / count
    spokes = [(x - mx, y - my) for x, y in ring]
    # Direction of the corners' greatest variance: half the angle of their second moments.
    sxx, syy, sxy = (
        math.fsum(x * x for x, _ in spokes),
        math.fsum(y * y for _, y in spokes),
        math.fsum(x * y for x, y in spokes),
    )
    turn = math.atan2(2.0 * sxy, sxx - syy) / 2.0
    ux, uy = math.cos(turn), math.sin(turn)
    along, across = [x * ux + y * uy for x, y in spokes], [y * ux - x * uy for x, y in spokes]
    if count < FEWEST_CORNERS or max(across) - min(across) <= tolerance:
        middle = (min(along) + max(along)) / 2.0
        return (mx + middle * ux, my + middle * uy), True
    area = gx = gy = 0.0
    for (ax, ay), (bx, by) in zip(spokes, (*spokes[1:], spokes[0]), strict=True):
        part = ax * by - ay * bx
        area, gx, gy = area + part, gx + part * (ax + bx), gy + part * (ay + by)
    return (mx + gx / (3.0 * area), my + gy / (3.0 * area)), False
