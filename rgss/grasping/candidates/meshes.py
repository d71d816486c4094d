"""Grasp candidates of a mesh: antipodal points of its surface."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from rgss.grasping.candidates.frames import ToolFrame, Vector3, tool_frame
from rgss.scenes import GripperGeometry, MeshShape, surface_of

Array = NDArray[np.float64]
_SEED = 20240531
_INSIDE = 1e-9


def antipodal_frames(
    shape: MeshShape, *, friction: float, samples: int, yaws: int, geometry: GripperGeometry
) -> Iterator[ToolFrame]:
    """Tool frames at antipodal pairs of surface points of a convex part.

    A point is sampled uniformly on the surface; the line along its normal leaves the part at the other point. A pair is
    antipodal if the line is in the friction cone there as well (Nguyen, 1988).

    Args:
        shape: The mesh.
        friction: Coefficient of the contact.
        samples: Number of sampled points.
        yaws: Number of angles of the tool about the line between the points.
        geometry: The gripper's shape.
    """
    triangles = np.vstack(surface_of(shape))
    owners = np.repeat(np.arange(len(shape.parts_m)), [len(part) for part in surface_of(shape)])
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    areas = np.linalg.norm(normals, axis=1)
    units = normals / areas[:, None]
    generator = np.random.default_rng(_SEED)
    chosen = generator.choice(len(triangles), size=samples, p=areas / np.sum(areas))
    weights = np.sqrt(generator.random(samples)), generator.random(samples)
    least = math.cos(math.atan(friction))
    for number, index in enumerate(chosen.tolist()):
        root, share = weights[0][number], weights[1][number]
        a, b, c = triangles[index]
        point = (1 - root) * a + root * (1 - share) * b + root * share * c
        inward = -units[index]
        mine = owners == owners[index]
        found = _exit(point, inward, triangles[mine], units[mine])
        if found is None or float(inward @ found[1]) < least:
            continue
        middle = (point + found[0]) / 2
        for turn, towards in enumerate(_turns(inward, yaws)):
            yield tool_frame(
                f"antipodal:{number}:{turn}",
                (float(middle[0]), float(middle[1]), float(middle[2])),
                towards=towards,
                closing=(float(-inward[0]), float(-inward[1]), float(-inward[2])),
                azimuth_rad=geometry.azimuths_rad[0],
            )


def _exit(point: Array, direction: Array, triangles: Array, normals: Array) -> tuple[Array, Array] | None:
    """Exit point of a line from the surface of a convex part, and the outward normal there."""
    slopes = normals @ direction
    leaving = slopes > _INSIDE
    if not np.any(leaving):
        return None
    lengths = np.einsum("ij,ij->i", normals[leaving], triangles[leaving, 0] - point) / slopes[leaving]
    nearest = int(np.argmin(lengths))
    if lengths[nearest] <= _INSIDE:
        return None
    return point + lengths[nearest] * direction, normals[leaving][nearest]


def _turns(axis: Array, yaws: int) -> list[Vector3]:
    """Directions perpendicular to an axis, evenly spaced, from the one that points down the most."""
    down = np.array([0.0, 0.0, -1.0])
    first = down - (down @ axis) * axis
    if np.linalg.norm(first) < 1e-3:
        first = np.array([1.0, 0.0, 0.0]) - axis[0] * axis
    first = first / np.linalg.norm(first)
    second = np.cross(axis, first)
    found = [
        math.cos(math.tau * turn / yaws) * first + math.sin(math.tau * turn / yaws) * second for turn in range(yaws)
    ]
    return [(float(one[0]), float(one[1]), float(one[2])) for one in found]
