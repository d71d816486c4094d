"""Triangulation of convex hulls."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float, float]


def hull_triangles(corners: Sequence[Point]) -> NDArray[np.intp]:
    """Triangles of a convex hull as indices of their corners, counter-clockwise seen from outside, shape (t, 3).

    Args:
        corners: The corners, not all in a plane.
    """
    from scipy.spatial import ConvexHull

    points = np.asarray(corners, dtype=float)
    hull = ConvexHull(points)
    triangles: NDArray[np.intp] = hull.simplices.astype(np.intp)
    first, second, third = (points[triangles[:, corner]] for corner in range(3))
    normals = np.cross(second - first, third - first)
    inward = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    return triangles


def mesh_text(corners: Sequence[Point]) -> str:
    """Convex shape as the text of a Wavefront OBJ file."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in corners]
    lines += ["f " + " ".join(str(corner + 1) for corner in triangle) for triangle in hull_triangles(corners).tolist()]
    return "\n".join(lines) + "\n"
