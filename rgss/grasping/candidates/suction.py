"""Suction points of an object, on flat faces that support the whole lip of a cup."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.scenes import Box, Cylinder, LyingCylinder, MeshShape, ObjectShape, Pose, SuctionPoint, surface_of

Array = NDArray[np.float64]
Vector3 = tuple[float, float, float]
_COPLANAR = 1e-6
_COS_SQUARE = float(np.cos(np.radians(5.0)))
_RIM_POINTS = 32
_ABOVE_M = 5e-4
_MARGIN_M = 2e-3
_RESERVES_M = (2e-3, 1e-3, 5e-4, 1e-4)
"""Distances of the lip from the edge of its face to try: at the edge itself no arm would come to its place."""

_GRID_SHARE = 0.25
_GRID_STEPS = 24


@lru_cache(maxsize=64)
def suction_points(shape: ObjectShape, cup_radius_m: float, centre_of_mass_m: Vector3) -> tuple[SuctionPoint, ...]:
    """Suction points of an object, one on each flat face that supports the lip, 2 mm from its edges where it can be.

    Ordered by the distance of the cup's axis from the centre of mass, the lever arm of the bending moment, then by the
    normal from the top down. A face that another part of the object covers under the lip has no suction point. They are
    computed once in a process: they depend neither on the object's pose nor on a seed.

    Args:
        shape: The object's shape; the wall of a cylinder has no suction point.
        cup_radius_m: Radius of the cup's lip.
        centre_of_mass_m: The object's centre of mass.
    """
    found = []
    parts = _half_spaces(shape)
    for normal, edges in _faces(shape):
        centre = np.array(centre_of_mass_m)
        tried = (_free_place(normal, edges, centre, cup_radius_m, reserve_m, parts) for reserve_m in _RESERVES_M)
        place = next((one for one in tried if one is not None), None)
        if place is not None:
            point, room = place
            arm = float(np.linalg.norm(np.cross(point - centre, normal)))
            found.append((round(arm, 9), tuple(np.round(-normal[::-1], 9)), _point(point, normal, room)))
    return tuple(one for _, _, one in sorted(found, key=lambda row: row[:2]))


def _free_place(
    normal: Array, rows: Array, centre: Array, radius_m: float, reserve_m: float, parts: list[Array]
) -> tuple[Array, float] | None:
    """Point of a face with room for the cup and a reserve that no other part covers, and the room in m."""
    needed_m = radius_m + reserve_m
    place = _place(normal, rows, centre, needed_m)
    if place is None or not _is_covered(place[0], normal, radius_m, parts):
        return place
    return _uncovered(normal, rows, place[0], radius_m, needed_m, parts)


def given_suction_point(shape: ObjectShape, cup_radius_m: float, tool_in_object: Pose) -> SuctionPoint | None:
    """Point at which the axis of a tool frame enters a face that supports the lip; None if there is no such face.

    Args:
        shape: The object's shape.
        cup_radius_m: Radius of the cup's lip.
        tool_in_object: Transform of the tool frame to the object's frame, its z axis towards the object.
    """
    towards, origin = np.array(tool_in_object.rotate((0.0, 0.0, 1.0))), np.array(tool_in_object.position_m)
    parts, found = _half_spaces(shape), []
    for normal, rows in _faces(shape):
        slope = float(normal @ towards)
        if slope > -_COS_SQUARE:
            continue
        point = origin - (rows[-1, :3] @ origin + rows[-1, 3]) / slope * towards
        room = -float(np.max(rows[:-1, :3] @ point + rows[:-1, 3]))
        if room >= cup_radius_m and not _is_covered(point, normal, cup_radius_m, parts):
            found.append((float(point @ towards), _point(point, normal, room)))
    return min(found, key=lambda row: row[0])[1] if found else None


def _half_spaces(shape: ObjectShape) -> list[Array]:
    """Half-spaces (n, 4) of each convex part of a mesh of several: inside where a·x + d <= 0."""
    parts = surface_of(shape) if isinstance(shape, MeshShape) and len(shape.parts_m) > 1 else ()
    return [np.array([rows[-1] for _, rows in _polygons(part)]) for part in parts]


def _is_covered(point: Array, normal: Array, radius_m: float, parts: list[Array]) -> bool:
    """True if a part of the object collides with the cup: under its lip, or beside it within its margin."""
    if not parts:
        return False
    first, second = _tangents(normal)
    turns = np.arange(_RIM_POINTS) * 2.0 * np.pi / _RIM_POINTS
    reach_m = radius_m + _MARGIN_M
    ring = np.outer(np.cos(turns), first) + np.outer(np.sin(turns), second)
    disc = np.vstack([np.zeros((1, 3)), *(reach_m * share * ring for share in (0.25, 0.5, 0.75, 1.0))])
    above = np.vstack([point + disc + height * normal for height in (_ABOVE_M, _MARGIN_M, radius_m)])
    return any(bool(np.any(np.all(above @ part[:, :3].T + part[:, 3] < 0.0, axis=1))) for part in parts)


def _uncovered(
    normal: Array, rows: Array, point: Array, radius_m: float, needed_m: float, parts: list[Array]
) -> tuple[Array, float] | None:
    """Grid point of a face with the room that is needed, nearest to a covered point, where no part covers the cup."""
    first, second = _tangents(normal)
    steps = range(-_GRID_STEPS, _GRID_STEPS + 1)
    offsets = sorted((u * u + v * v, u, v) for u in steps for v in steps)
    for _, u, v in offsets:
        tried = point + radius_m * _GRID_SHARE * (u * first + v * second)
        room = -float(np.max(rows[:-1, :3] @ tried + rows[:-1, 3]))
        if room >= needed_m and not _is_covered(tried, normal, radius_m, parts):
            return tried, room
    return None


def _tangents(normal: Array) -> tuple[Array, Array]:
    """Two unit tangents of a normal, perpendicular to each other."""
    first = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)


def _point(point: Array, normal: Array, room_m: float) -> SuctionPoint:
    x, y, z = (float(value) for value in point)
    nx, ny, nz = (float(value) for value in normal)
    return SuctionPoint(position_m=(x, y, z), normal=(nx, ny, nz), room_m=room_m)


def _faces(shape: ObjectShape) -> list[tuple[Array, Array]]:
    """Flat faces, each as its outward normal and its edges' half-planes (n, 4): inside where a·x + d <= 0."""
    if isinstance(shape, (Box, MeshShape)):
        return [face for part in surface_of(shape) for face in _polygons(part)]
    axis = np.array([1.0, 0.0, 0.0] if isinstance(shape, LyingCylinder) else [0.0, 0.0, 1.0])
    solid = shape.upright if isinstance(shape, LyingCylinder) else shape
    return [(sign * axis, _disc(solid, sign * axis)) for sign in (1.0, -1.0)]


def _disc(shape: Cylinder, normal: Array) -> Array:
    """Half-planes of a 64-sided polygon in the end face of a cylinder, and the plane of the face last."""
    first = np.cross(normal, [0.0, 1.0, 0.0])
    second = np.cross(normal, first)
    turns = np.arange(64) * np.pi / 32
    edges = np.outer(np.cos(turns), first) + np.outer(np.sin(turns), second)
    rows = np.hstack([edges, np.full((64, 1), -shape.radius_m * np.cos(np.pi / 64))])
    return np.vstack([rows, [*normal, -shape.half_height_m]])


def _polygons(triangles: Array) -> list[tuple[Array, Array]]:
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    offsets = np.einsum("ij,ij->i", normals, triangles[:, 0])
    left, found = list(range(len(triangles))), []
    while left:
        index = left[0]
        same = [
            one
            for one in left
            if normals[one] @ normals[index] > 1.0 - _COPLANAR and abs(offsets[one] - offsets[index]) < _COPLANAR
        ]
        left = [one for one in left if one not in same]
        corners = np.unique(np.round(triangles[same].reshape(-1, 3), 9), axis=0)
        normal = normals[index]
        middle = corners.mean(axis=0)
        first = corners[0] - middle
        angles = np.arctan2(np.cross(first, corners - middle) @ normal, (corners - middle) @ first)
        ring = corners[np.argsort(angles)]
        sides = np.roll(ring, -1, axis=0) - ring
        outward = np.cross(sides, normal)
        outward /= np.linalg.norm(outward, axis=1)[:, None]
        rows = np.hstack([outward, -np.einsum("ij,ij->i", outward, ring)[:, None]])
        found.append((normal, np.vstack([rows, [*normal, -offsets[index]]])))
    return found


def _place(normal: Array, rows: Array, centre: Array, radius_m: float) -> tuple[Array, float] | None:
    """Point of a face with room for the cup, nearest to the projection of the centre of mass, and the room in m."""
    from scipy.optimize import minimize

    edges, plane = rows[:-1], rows[-1]
    foot = centre - (plane[:3] @ centre + plane[3]) * normal
    room = -float(np.max(edges[:, :3] @ foot + edges[:, 3]))
    if room >= radius_m:
        return foot, room
    frame = np.column_stack(_tangents(normal))
    limits = -edges[:, 3] - edges[:, :3] @ foot - radius_m
    slopes = edges[:, :3] @ frame
    result = minimize(
        lambda uv: float(uv @ uv),
        np.zeros(2),
        jac=lambda uv: 2.0 * uv,
        constraints={"type": "ineq", "fun": lambda uv: limits - slopes @ uv, "jac": lambda _: -slopes},
        method="SLSQP",
    )
    if not result.success or np.min(limits - slopes @ result.x) < -1e-7:
        return None
    point = foot + frame @ result.x
    return point, -float(np.max(edges[:, :3] @ point + edges[:, 3]))
