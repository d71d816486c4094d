"""Points at which a suction cup holds an object: on flat faces that bear the whole cup."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.grasping.candidates.hand import SuctionHand
from rgss.scenes import Box, Cylinder, LyingCylinder, MeshShape, ObjectShape, surface_of

Array = NDArray[np.float64]
Vector3 = tuple[float, float, float]
_COPLANAR = 1e-6


@dataclass(frozen=True, slots=True, kw_only=True)
class SuctionPoint:
    """A place of a suction cup.

    Attributes:
        position_m: Middle of the cup on the object, in the object's frame.
        normal: Unit normal of the face, out of the object.
        room_m: Distance to the nearest edge of the face.
    """

    position_m: Vector3
    normal: Vector3
    room_m: float


def suction_points(shape: ObjectShape, hand: SuctionHand, centre_of_mass_m: Vector3) -> tuple[SuctionPoint, ...]:
    """The suction points of an object, one for each flat face that bears the cup, the nearest to the centre of mass.

    Ordered by the distance of the cup's axis from the centre of mass, which bends the cup, then by the normal from the
    top down.

    Args:
        shape: The object's shape; the wall of a cylinder bears no cup.
        hand: The hand.
        centre_of_mass_m: The object's centre of mass.
    """
    found = []
    for normal, edges in _faces(shape):
        centre = np.array(centre_of_mass_m)
        place = _place(normal, edges, centre, hand.cup_radius_m)
        if place is not None:
            point, room = place
            arm = float(np.linalg.norm(np.cross(point - centre, normal)))
            found.append((round(arm, 9), tuple(np.round(-normal[::-1], 9)), _point(point, normal, room)))
    return tuple(one for _, _, one in sorted(found, key=lambda row: row[:2]))


def _point(point: Array, normal: Array, room_m: float) -> SuctionPoint:
    x, y, z = (float(value) for value in point)
    nx, ny, nz = (float(value) for value in normal)
    return SuctionPoint(position_m=(x, y, z), normal=(nx, ny, nz), room_m=room_m)


def _faces(shape: ObjectShape) -> list[tuple[Array, Array]]:
    """Each flat face as its outward normal and its edges' half-planes (n, 4): inside where a·x + d <= 0."""
    if isinstance(shape, (Box, MeshShape)):
        return [face for part in surface_of(shape) for face in _polygons(part)]
    axis = np.array([1.0, 0.0, 0.0] if isinstance(shape, LyingCylinder) else [0.0, 0.0, 1.0])
    solid = shape.upright if isinstance(shape, LyingCylinder) else shape
    return [(sign * axis, _disc(solid, sign * axis)) for sign in (1.0, -1.0)]


def _disc(shape: Cylinder, normal: Array) -> Array:
    """The half-planes of a face of 64 sides in the end of a cylinder, and the plane of the end itself last."""
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
    """The point of a face at which the cup has room, nearest to the foot of the centre of mass; with its room."""
    from scipy.optimize import minimize

    edges, plane = rows[:-1], rows[-1]
    foot = centre - (plane[:3] @ centre + plane[3]) * normal
    room = -float(np.max(edges[:, :3] @ foot + edges[:, 3]))
    if room >= radius_m:
        return foot, room
    first = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
    first /= np.linalg.norm(first)
    frame = np.column_stack([first, np.cross(normal, first)])
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
