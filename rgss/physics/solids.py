"""Triangulated surfaces of solids for rendering: smooth round an axis, sharp at every edge."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from rgss.physics.hulls import hull_triangles
from rgss.scenes import Box, Cylinder, DrawnMesh

_FACETS = 32
_WALL_SHARE, _BOTTOM_SHARE = 0.90, 0.08

Vector = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Surface:
    """A triangulated surface.

    Attributes:
        vertices_m: Its vertices.
        normals: Outward normal at each vertex.
        indices: Three vertices for each triangle, counter-clockwise seen from outside.
    """

    vertices_m: tuple[Vector, ...]
    normals: tuple[Vector, ...]
    indices: tuple[int, ...]


def box_surface(shape: Box) -> Surface:
    """Surface of a box in its own frame."""
    half = [size / 2 for size in shape.size_m]
    vertices: list[Vector] = []
    normals: list[Vector] = []
    indices: list[int] = []
    for axis in range(3):
        for side in (-1.0, 1.0):
            first = len(vertices)
            # Counter-clockwise from outside: the two other axes in cyclic order, reversed on the negative side.
            for u, v in ((-side, -1.0), (side, -1.0), (side, 1.0), (-side, 1.0)):
                corner, normal = [0.0] * 3, [0.0] * 3
                corner[axis], normal[axis] = side * half[axis], side
                corner[(axis + 1) % 3], corner[(axis + 2) % 3] = u * half[(axis + 1) % 3], v * half[(axis + 2) % 3]
                vertices.append((corner[0], corner[1], corner[2]))
                normals.append((normal[0], normal[1], normal[2]))
            indices += [first, first + 1, first + 2, first, first + 2, first + 3]
    return Surface(vertices_m=tuple(vertices), normals=tuple(normals), indices=tuple(indices))


def hull_surface(corners: Sequence[Vector]) -> Surface:
    """Surface of a convex shape from its corners, with flat faces."""
    vertices: list[Vector] = []
    normals: list[Vector] = []
    for triangle in hull_triangles(corners).tolist():
        a, b, c = (np.array(corners[index]) for index in triangle)
        normal = np.cross(b - a, c - a)
        x, y, z = (normal / np.linalg.norm(normal)).tolist()
        vertices += [corners[index] for index in triangle]
        normals += [(x, y, z)] * 3
    return Surface(vertices_m=tuple(vertices), normals=tuple(normals), indices=tuple(range(len(vertices))))


def mesh_surface(mesh: DrawnMesh) -> Surface:
    """Surface of a visual mesh in its own frame."""
    vertices, normals = ([(x, y, z) for x, y, z in rows.tolist()] for rows in (mesh.vertices_m, mesh.normals))
    return Surface(vertices_m=tuple(vertices), normals=tuple(normals), indices=tuple(mesh.triangles.ravel().tolist()))


def cylinder_surface(shape: Cylinder) -> Surface:
    """Surface of a cylinder in its own frame."""
    r, h = shape.radius_m, shape.half_height_m
    # Long thin oblique triangles are slow to render, so a long side is divided into rings.
    rings = max(1, math.ceil(h / r))
    side = [(r, h * (2 * ring / rings - 1)) for ring in range(rings + 1)]
    return _turned([(0.0, -h), *side, (0.0, h)])


def cup_surface(shape: Cylinder) -> Surface:
    """Surface of a cup with the outline of a cylinder: outside, rim and inside."""
    r, h = shape.radius_m, shape.half_height_m
    inside, bottom = _WALL_SHARE * r, (2 * _BOTTOM_SHARE - 1) * h
    return _turned([(0.0, -h), (r, -h), (r, h), (inside, h), (inside, bottom), (0.0, bottom)])


def _turned(profile: Sequence[tuple[float, float]]) -> Surface:
    """Surface of revolution of a profile (radius, height) about z; the outside is to the right of the profile."""
    vertices: list[Vector] = []
    normals: list[Vector] = []
    indices: list[int] = []
    circle = [(math.cos(angle), math.sin(angle)) for angle in _angles()]
    for (r0, z0), (r1, z1) in pairwise(profile):
        length = math.hypot(r1 - r0, z1 - z0)
        outward, upward = (z1 - z0) / length, (r0 - r1) / length
        first = len(vertices)
        for x, y in circle:
            vertices += [(r0 * x, r0 * y, z0), (r1 * x, r1 * y, z1)]
            normals += [(outward * x, outward * y, upward)] * 2
        for facet in range(_FACETS):
            low = first + 2 * facet
            indices += [low, low + 2, low + 3, low, low + 3, low + 1]
    return Surface(vertices_m=tuple(vertices), normals=tuple(normals), indices=tuple(indices))


def _angles() -> list[float]:
    return [math.tau * facet / _FACETS for facet in range(_FACETS + 1)]
