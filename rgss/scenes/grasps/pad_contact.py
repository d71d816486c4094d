"""Contact of flat pads with an object: opening and contact patch of each pad.

The pad of a finger is a rectangle perpendicular to the finger's direction of travel, and sweeps a column. It stops at
the outermost point of the object inside the column. The surface of each convex part is clipped to the column; the part
of it at that distance is the patch: a face, an edge or a point.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.scenes.gripper import GripperGeometry
from rgss.scenes.pose import Pose
from rgss.scenes.shapes import Cylinder, LyingCylinder, ObjectShape, corners_of

Array = NDArray[np.float64]
_FLAT_M = 2.0e-5
_PARALLEL = 1e-6
_LOOKS = 12
_EVEN_M = 1.0e-5


@dataclass(frozen=True, slots=True, kw_only=True)
class PadPatch:
    """Contact patch of a finger's pad, in the frame of the pad.

    Attributes:
        opening_m: Distance of the pad from the gripper's axis.
        across_m: Least and greatest coordinate along the finger's width.
        along_m: The same along the gripper's axis, from the grasp centre, positive away from the flange.
        slope: Greatest cosine of the angle between the touched surface and the pad; 1 if they are parallel.
        is_on_rim: Whether only the rim of the pad touches.
    """

    opening_m: float
    across_m: tuple[float, float]
    along_m: tuple[float, float]
    slope: float
    is_on_rim: bool

    @property
    def corners_m(self) -> tuple[tuple[float, float], ...]:
        """Distinct corners of the patch, as coordinates across and along."""
        found = {(across, along) for across in self.across_m for along in self.along_m}
        return tuple(sorted(found))


def pad_patches(shape: ObjectShape, tool_in_object: Pose, geometry: GripperGeometry) -> tuple[PadPatch, ...] | None:
    """Contact patches of the fingers' pads closed on an object.

    Args:
        shape: The object's solid.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        geometry: The gripper's shape.

    Returns:
        One patch for each finger; None if a finger would close without contact.
    """
    return _patches(shape, tool_in_object, geometry)


@lru_cache(maxsize=512)
def _patches(shape: ObjectShape, tool_in_object: Pose, geometry: GripperGeometry) -> tuple[PadPatch, ...] | None:
    found = []
    to_tool = tool_in_object.inverse()
    for azimuth in geometry.azimuths_rad:
        frame = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, 0.0, azimuth)).inverse() @ to_tool
        patch = _round_patch(shape, frame, geometry) or _flat_patch(shape, frame, geometry)
        if patch is None:
            return None
        found.append(patch)
    return tuple(found)


def even_shift_m(patches: Sequence[PadPatch], geometry: GripperGeometry) -> tuple[float, float]:
    """Displacement of the grasp centre perpendicular to the gripper's axis that equalises the pads' openings, in m.

    Args:
        patches: Present contact patch of each pad.
        geometry: The gripper's shape.
    """
    directions = np.array([(math.cos(azimuth), math.sin(azimuth), 1.0) for azimuth in geometry.azimuths_rad])
    solution = np.linalg.lstsq(directions, np.array([patch.opening_m for patch in patches]), rcond=None)[0]
    return float(solution[0]), float(solution[1])


def settled_grasp(
    shape: ObjectShape, tool_in_object: Pose, geometry: GripperGeometry
) -> tuple[Pose, tuple[PadPatch, ...]] | None:
    """Grasp shifted perpendicular to the gripper's axis until all pads touch at the same opening.

    Args:
        shape: The object's solid.
        tool_in_object: Transform of the grasp-centre frame to the object's frame.
        geometry: The gripper's shape.

    Returns:
        The grasp and the contact patches; None if there is no such grasp.
    """
    for _ in range(_LOOKS):
        patches = pad_patches(shape, tool_in_object, geometry)
        if patches is None:
            return None
        openings = [patch.opening_m for patch in patches]
        if max(openings) - min(openings) <= _EVEN_M:
            return tool_in_object, patches
        x, y = even_shift_m(patches, geometry)
        tool_in_object = tool_in_object @ Pose(position_m=(x, y, 0.0))
    return None


def _window(geometry: GripperGeometry) -> tuple[float, float, float, float]:
    """Bounds of a pad: least and greatest coordinate across, then along from the grasp centre."""
    _, width_m, length_m = geometry.finger.size_m
    start = geometry.base.height_m - geometry.grasp_depth_m
    return -width_m / 2, width_m / 2, start, start + length_m


def _round_patch(shape: ObjectShape, to_pad: Pose, geometry: GripperGeometry) -> PadPatch | None:
    """Line patch on the wall of a cylinder whose axis is along the pad or across it."""
    if isinstance(shape, Cylinder):
        axis, half_m = (0.0, 0.0, 1.0), shape.half_height_m
    elif isinstance(shape, LyingCylinder):
        axis, half_m = (1.0, 0.0, 0.0), shape.length_m / 2
    else:
        return None
    radial, across, along = (abs(value) for value in to_pad.rotate(axis))
    if radial > _PARALLEL or min(across, along) > _PARALLEL:
        return None
    x, y, z = to_pad.position_m
    low_y, high_y, low_z, high_z = _window(geometry)
    if along > across:
        span = max(low_z, z - half_m), min(high_z, z + half_m)
        found = (y, y), span
        inside = low_y <= y <= high_y and span[1] > span[0]
    else:
        span = max(low_y, y - half_m), min(high_y, y + half_m)
        found = span, (z, z)
        inside = low_z <= z <= high_z and span[1] > span[0]
    if not inside:
        return None
    return PadPatch(opening_m=x + shape.radius_m, across_m=found[0], along_m=found[1], slope=1.0, is_on_rim=False)


def _flat_patch(shape: ObjectShape, to_pad: Pose, geometry: GripperGeometry) -> PadPatch | None:
    window = _window(geometry)
    pieces: list[tuple[Array, float]] = []
    opening_m = -math.inf
    for part in surface_of(shape):
        corners = (part.reshape(-1, 3) @ rotation_of(to_pad).T + np.array(to_pad.position_m)).reshape(-1, 3, 3)
        normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        sizes = np.linalg.norm(normals, axis=1)
        low, high = np.min(corners, axis=1), np.max(corners, axis=1)
        facing = normals[:, 0] > 1e-9 * sizes
        facing &= (low[:, 1] <= window[1]) & (high[:, 1] >= window[0])
        facing &= (low[:, 2] <= window[3]) & (high[:, 2] >= window[2])
        indices = np.flatnonzero(facing)
        # The farthest triangles first: those that do not reach as far as what is found touch no pad.
        for index in indices[np.argsort(-high[indices, 0], kind="stable")].tolist():
            if high[index, 0] < opening_m - _FLAT_M:
                break
            kept = _clipped(corners[index], window)
            if len(kept):
                pieces.append((kept, float(normals[index, 0] / sizes[index])))
                opening_m = max(opening_m, float(np.max(kept[:, 0])))
    if not pieces:
        return None
    touching = [(kept[kept[:, 0] >= opening_m - _FLAT_M], slope) for kept, slope in pieces]
    points = np.vstack([kept for kept, _ in touching])
    slope = max(slope for kept, slope in touching if len(kept))
    across = float(np.min(points[:, 1])), float(np.max(points[:, 1]))
    along = float(np.min(points[:, 2])), float(np.max(points[:, 2]))
    return PadPatch(
        opening_m=opening_m, across_m=across, along_m=along, slope=slope, is_on_rim=_is_on_rim(across, along, window)
    )


def _is_on_rim(
    across: tuple[float, float], along: tuple[float, float], window: tuple[float, float, float, float]
) -> bool:
    """True if a patch is thin in a direction and lies at the end of the pad in that direction."""
    thin = 2.0 * _FLAT_M
    return any(
        high - low <= thin and min(abs(low - first), abs(high - last)) <= thin
        for (low, high), (first, last) in ((across, window[:2]), (along, window[2:]))
    )


def _clipped(triangle: Array, window: tuple[float, float, float, float]) -> Array:
    """Corners of the part of a triangle inside the column of a pad, shape (n, 3)."""
    polygon = triangle
    for axis, limit, sign in ((1, window[0], 1.0), (1, window[1], -1.0), (2, window[2], 1.0), (2, window[3], -1.0)):
        if not len(polygon):
            break
        inside = sign * (polygon[:, axis] - limit)
        if np.all(inside >= 0.0):
            continue
        kept = []
        for index in range(len(polygon)):
            here, there = inside[index - 1], inside[index]
            if (here >= 0.0) != (there >= 0.0):
                kept.append(polygon[index - 1] + (polygon[index] - polygon[index - 1]) * (here / (here - there)))
            if there >= 0.0:
                kept.append(polygon[index])
        polygon = np.array(kept) if kept else np.zeros((0, 3))
    return polygon


def rotation_of(pose: Pose) -> Array:
    """Rotation matrix of a pose, shape (3, 3)."""
    columns = [pose.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    axes: Array = np.array(columns).T
    return axes


@lru_cache(maxsize=64)
def surface_of(shape: ObjectShape) -> tuple[Array, ...]:
    """Triangles of the convex parts of a shape, counter-clockwise from outside, shape (t, 3, 3) each.

    Args:
        shape: The shape.
    """
    from scipy.spatial import ConvexHull

    found = []
    for part in corners_of(shape):
        points = np.asarray(part, dtype=float)
        hull = ConvexHull(points)
        triangles = points[hull.simplices]
        normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
        inward = np.einsum("ij,ij->i", normals, hull.equations[:, :3]) < 0.0
        triangles[inward] = triangles[inward][:, ::-1]
        triangles.setflags(write=False)
        found.append(triangles)
    return tuple(found)
