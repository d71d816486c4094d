"""Static stability of an object at rest: its centre of mass above the foot on which it stands."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from itertools import combinations

from rgss.scenes.scene import Workpiece
from rgss.scenes.shapes import LyingCylinder, ObjectShape, corners_of

Point2 = tuple[float, float]

_FLAT_M = 5e-4
"""Height above the lowest corner up to which corners count as the foot, the tolerance of a mesh's hull."""

_NARROW_M = 1e-4
"""Width of a foot below which it is an edge or a point."""

_EXACT_M = 1e-6


class FootKind(str, Enum):
    """Contact of an object with a level support."""

    FACE = "face"
    EDGE = "edge"
    POINT = "point"


@dataclass(frozen=True, slots=True, kw_only=True)
class Foot:
    """Foot of an object at rest.

    Attributes:
        kind: Whether it is a face, an edge or a point.
        outside_m: Distance of the centre of mass, seen from above, outside the foot, which rolling resistance widens;
            negative inside.
        is_stable: False if the object topples or rolls away without another support.
    """

    kind: FootKind
    outside_m: float
    is_stable: bool


def foot_of(workpiece: Workpiece) -> Foot:
    """Foot of an object, in its orientation at rest on a level support.

    Rolling resistance, a torque over the normal force, moves the resultant of the support by as much beyond the foot.
    """
    corners = _convex(_lowest(workpiece.shape))
    kind = _kind(corners)
    resistance_m = workpiece.rolling_resistance_m
    outside_m = _outside(workpiece.centre_of_mass_across_m, corners) - resistance_m
    # On an edge or a point the balance is unstable even with the centre of mass above it.
    is_stable = outside_m <= _EXACT_M and (kind is FootKind.FACE or resistance_m > 0.0)
    return Foot(kind=kind, outside_m=outside_m, is_stable=is_stable)


def _lowest(shape: ObjectShape) -> list[Point2]:
    if isinstance(shape, LyingCylinder):
        return [(-shape.length_m / 2, 0.0), (shape.length_m / 2, 0.0)]
    corners = [corner for part in corners_of(shape) for corner in part]
    least_m = min(z for _, _, z in corners)
    return [(x, y) for x, y, z in corners if z <= least_m + _FLAT_M]


def _convex(points: Sequence[Point2]) -> list[Point2]:
    """Corners of the convex hull, anticlockwise (Andrew's monotone chain)."""
    ordered = sorted(set(points))
    if len(ordered) < 3:
        return ordered
    halves: list[list[Point2]] = []
    for run in (ordered, ordered[::-1]):
        half: list[Point2] = []
        for point in run:
            while len(half) > 1 and _turn(half[-2], half[-1], point) <= 0.0:
                half.pop()
            half.append(point)
        halves.append(half[:-1])
    return halves[0] + halves[1]


def _kind(corners: Sequence[Point2]) -> FootKind:
    longest_m = max((math.dist(a, b) for a, b in combinations(corners, 2)), default=0.0)
    if longest_m < _NARROW_M:
        return FootKind.POINT
    widths = (max(abs(_turn(a, b, c)) for c in corners) / math.dist(a, b) for a, b in _edges(corners))
    return FootKind.EDGE if len(corners) < 3 or min(widths) < _NARROW_M else FootKind.FACE


def _outside(point: Point2, corners: Sequence[Point2]) -> float:
    """Distance of a point from a convex polygon; negative inside."""
    distances = [_from_segment(point, a, b) for a, b in _edges(corners)]
    is_inside = len(corners) > 2 and all(_turn(a, b, point) >= 0.0 for a, b in _edges(corners))
    return -min(distances) if is_inside else min(distances)


def _edges(corners: Sequence[Point2]) -> list[tuple[Point2, Point2]]:
    return list(zip(corners, [*corners[1:], corners[0]], strict=True))


def _turn(a: Point2, b: Point2, c: Point2) -> float:
    """Twice the signed area of a triangle, positive anticlockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def _from_segment(point: Point2, a: Point2, b: Point2) -> float:
    square = (b[0] - a[0]) ** 2 + (b[1] - a[1]) ** 2
    along = 0.0
    if square > 0.0:
        along = ((point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])) / square
    along = min(1.0, max(0.0, along))
    return math.dist(point, (a[0] + along * (b[0] - a[0]), a[1] + along * (b[1] - a[1])))
