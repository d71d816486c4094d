"""Convex approximations of a mesh: its hull, the hulls of its parts, or the boxes about its bodies."""

# long file: every use of the reader of meshes, which no other file has.

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.scenes.document import CollisionShapes

Vertices = tuple[tuple[float, float, float], ...]
Array = NDArray[np.float64]

HULL_TOLERANCE_M = 5e-4
"""Tolerance in m of a reduced hull: corners farther outside are added; the hull is then expanded over the others."""

MOST_VERTICES = 160
"""Greatest number of corners of a shape; the time of contact and collision checks is proportional to it."""

_INSIDE = 1e-3
_SUFFIXES = frozenset({".stl", ".obj", ".dae", ".ply"})
_LFS_POINTER = b"version https://git-lfs.github.com/spec/"
_STL_HEADER_BYTES, _STL_FACE_BYTES = 84, 50
_OBJ_WORDS = frozenset(["v", "vt", "vn", "vp", "f", "l", "p", "o", "g", "s", "usemtl", "mtllib"])
_CONCAVITY = 0.05
_MOST_WRITTEN = 16
_EXACT = 1e-9


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshSummary:
    """Properties of a mesh before its convex approximation.

    Attributes:
        is_closed: Whether it encloses a volume.
        bodies: Number of connected components.
        hull_ratio: Volume of its hull divided by its own; 1 for a convex mesh, NaN if it is not closed.
        extent_m: Its extent along the axes of its frame.
    """

    is_closed: bool
    bodies: int
    hull_ratio: float
    extent_m: tuple[float, float, float]


def shapes_of_mesh(
    path: Path, *, sha256: str, scale: tuple[float, float, float], how: CollisionShapes
) -> tuple[Vertices, ...]:
    """Convex shapes of a mesh, each as its corners in m, rounded to 0.1 µm.

    Args:
        path: The mesh's file.
        sha256: Digest of its content, the cache key.
        scale: Factors along its axes.
        how: Kind of the approximation.

    Raises:
        DefinitionError: The file is not a mesh, or has no volume.
    """
    return _shapes_of_content(_MeshContent(sha256=sha256, suffix=path.suffix.lower(), path=path), scale, how)


def write_convex_parts(path: Path, folder: Path, *, scale: tuple[float, float, float]) -> tuple[str, ...]:
    """Write the convex parts of a mesh as meshes of their own; returns the names of the files.

    Args:
        path: The file of the mesh.
        folder: The folder of the parts.
        scale: Factors along its axes, which the parts include.

    Raises:
        DefinitionError: The file is not a mesh with a volume, or CoACD is not installed.
    """
    import trimesh

    parts = _shapes(path, scale, CollisionShapes.DECOMPOSE, _MOST_WRITTEN)
    names = tuple(f"{path.stem}_{index}.stl" for index in range(len(parts)))
    for name, corners in zip(names, parts, strict=True):
        trimesh.Trimesh(corners).convex_hull.export(str(folder / name))
    return names


def mesh_summary(path: Path, *, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> MeshSummary:
    """Properties of a mesh.

    Args:
        path: Its file.
        scale: Factors along its axes.

    Raises:
        DefinitionError: The file is not a mesh.
    """
    mesh = read_mesh(path, scale)
    closed = _is_closed(mesh)
    x, y, z = (float(value) for value in mesh.extents)
    return MeshSummary(
        is_closed=closed,
        bodies=len(mesh.split(only_watertight=False)),
        hull_ratio=float(mesh.convex_hull.volume / mesh.volume) if closed else float("nan"),
        extent_m=(x, y, z),
    )


def mesh_extent_m(path: Path, *, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> float:
    """Greatest extent of a mesh along an axis of its frame in m; the arguments are those of `mesh_summary`."""
    return float(max(read_mesh(path, scale).extents))


def shapes_volume_m3(shapes: Sequence[Vertices]) -> float:
    """Sum of the volumes of convex shapes."""
    from scipy.spatial import ConvexHull

    return math.fsum(float(ConvexHull(np.array(corners)).volume) for corners in shapes)


def mesh_corners(path: Path, *, scale: tuple[float, float, float] = (1.0, 1.0, 1.0)) -> Array:
    """Corners of a mesh in its frame, shape (k, 3), in m.

    Args:
        path: Its file.
        scale: Factors along its axes.

    Raises:
        DefinitionError: The file is not a mesh, or is flat.
    """
    from scipy.spatial import ConvexHull, QhullError

    points = np.asarray(read_mesh(path, scale).vertices, dtype=float)
    try:
        corners: Array = points[ConvexHull(points).vertices]
    except QhullError:
        raise DefinitionError(f"{path.name} is flat and has no volume", hint="use a mesh with a thickness") from None
    return corners


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshMass:
    """Mass properties of a homogeneous mesh.

    Attributes:
        volume_m3: Its volume.
        centre_m: Its centre of mass.
        gyration_m2: Inertia about the centre of mass divided by the mass, in m²: xx, yy, zz, xy, xz, yz.
    """

    volume_m3: float
    centre_m: tuple[float, float, float]
    gyration_m2: tuple[float, float, float, float, float, float]


def mesh_mass(path: Path, *, scale: float = 1.0) -> MeshMass:
    """Mass properties of a closed homogeneous mesh.

    Args:
        path: Its file.
        scale: Factor of its lengths.

    Raises:
        DefinitionError: The file is not a mesh, or encloses no volume.
    """
    mesh = read_mesh(path, (scale, scale, scale))
    if not _is_closed(mesh) or not mesh.volume > 0.0:
        raise DefinitionError(
            f"{path.name} must be closed for mass properties",
            hint="close the mesh, or give centre_of_mass and inertia",
        )
    x, y, z = (float(value) for value in mesh.center_mass)
    inertia = mesh.moment_inertia / mesh.mass
    entries = [float(inertia[row, column]) for row, column in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    xx, yy, zz, xy, xz, yz = entries
    return MeshMass(volume_m3=float(mesh.volume), centre_m=(x, y, z), gyration_m2=(xx, yy, zz, xy, xz, yz))


@dataclass(frozen=True, slots=True, kw_only=True)
class _MeshContent:
    """Content of a mesh; equal to that of a copy, since projects are copied."""

    sha256: str
    suffix: str
    path: Path = field(compare=False)


@lru_cache(maxsize=256)
def _shapes_of_content(
    content: _MeshContent, scale: tuple[float, float, float], how: CollisionShapes
) -> tuple[Vertices, ...]:
    return _shapes(content.path, scale, how)


def _shapes(
    path: Path, scale: tuple[float, float, float], how: CollisionShapes, most: int = -1
) -> tuple[Vertices, ...]:
    mesh = read_mesh(path, scale)
    if how is CollisionShapes.BOXES:
        return _boxes(mesh)
    if how is CollisionShapes.DECOMPOSE:
        parts = _parts(mesh.split(only_watertight=False), most)
        if parts:
            return tuple(_reduced_hull(part, path) for part in parts)
    return (_reduced_hull(np.asarray(mesh.vertices, dtype=float), path),)


def read_mesh(path: Path, scale: tuple[float, float, float]) -> Any:
    """Mesh of a file, scaled, with the corners merged that differ only in normal or texture.

    Args:
        path: The file.
        scale: Factors along its axes.

    Raises:
        DefinitionError: The file is not a mesh.
    """
    mesh = _loaded(path)
    if len(mesh.vertices) < 4 or not np.all(np.isfinite(mesh.vertices)):
        raise DefinitionError(f"{path.name} is not a mesh with a volume", hint="use STL, OBJ or PLY")
    # Corners that differ only in normal or texture are merged; otherwise no mesh with sharp edges would be closed.
    mesh.merge_vertices(merge_tex=True, merge_norm=True)
    mesh.apply_scale(scale)
    return mesh


def is_empty_mesh(path: Path) -> bool:
    """True if a mesh file has no corners, as exporters write it for a frame.

    Raises:
        DefinitionError: The file is not a mesh.
    """
    return len(_loaded(path).vertices) == 0


def _loaded(path: Path) -> Any:
    import trimesh

    if path.suffix.lower() not in _SUFFIXES:
        raise DefinitionError(f"{path.name} is not a mesh format that can be read", hint="use STL, OBJ or PLY")
    with path.open("rb") as file:
        start = file.read(len(_LFS_POINTER))
    if start == _LFS_POINTER:
        hint = "fetch the content with 'git lfs pull'"
        raise DefinitionError(f"{path.name} is a pointer of Git LFS, and not the mesh", hint=hint)
    if not start:
        raise DefinitionError(f"{path.name} is an empty file", hint="use STL, OBJ or PLY")
    try:
        mesh = trimesh.load_mesh(str(path), process=True)
        if isinstance(mesh, trimesh.Scene):
            mesh = mesh.to_mesh()
        mesh.apply_scale(trimesh.units.unit_conversion(mesh.units or "meters", "meters"))  # COLLADA has a unit
    except ImportError:
        raise DefinitionError(f"{path.name} needs a reader that is not installed", hint="use STL, OBJ or PLY") from None
    except Exception as error:
        # Each reader raises errors of its own, such as those of an XML parser.
        raise DefinitionError(f"{path.name} cannot be read as a mesh: {error}", hint="use STL, OBJ or PLY") from error
    if len(mesh.vertices) == 0 and not _has_form(path):
        suffix = path.suffix.lower().lstrip(".").upper()
        raise DefinitionError(f"{path.name} is not a file of the format {suffix}", hint="export the mesh again")
    return mesh


def _has_form(path: Path) -> bool:
    """True if a file without corners has the form of its format; readers accept any text as an empty STL or OBJ."""
    content, suffix = path.read_bytes(), path.suffix.lower()
    if suffix == ".stl":
        faces = int.from_bytes(content[_STL_HEADER_BYTES - 4 : _STL_HEADER_BYTES], "little")
        whole = _STL_HEADER_BYTES + _STL_FACE_BYTES * faces
        # Some exporters end the file before the number of faces.
        is_binary = len(content) in (whole, _STL_HEADER_BYTES - 4)
        return is_binary or (content.lstrip().startswith(b"solid") and b"endsolid" in content)
    if suffix == ".obj":
        lines = content.decode("utf-8", errors="replace").splitlines()
        return all(word[0] in _OBJ_WORDS or word[0].startswith("#") for line in lines if (word := line.split()))
    return True


def _is_closed(mesh: Any) -> bool:
    """True if a mesh encloses a volume: each edge is passed as often in one direction as in the other.

    Unlike two faces at each edge, this holds for closed bodies that touch each other along an edge or a face.
    """
    edges, corners = np.asarray(mesh.edges, dtype=np.int64), len(mesh.vertices)
    there, back = np.sort(edges @ (corners, 1)), np.sort(edges @ (1, corners))
    return bool(mesh.is_watertight) or bool(np.array_equal(there, back))


def _parts(bodies: Sequence[Any], most: int) -> list[Array]:
    """Convex pieces of the bodies of a mesh; empty if faces without a volume are left over outside of them.

    Separate faces, such as the six of an open box, are taken for one body.
    """
    solid, faces = _bodies_and_faces(bodies)
    parts = [piece for body in solid for piece in _convex_pieces(body, most)]
    if faces is None:
        return parts
    if _has_volume(faces):
        return [*parts, faces]
    return parts if _are_inside(faces, parts) else []


def _are_inside(points: Array, parts: Sequence[Array]) -> bool:
    """True if each point lies in the hull of a part, within a thousandth of the parts' extent."""
    from scipy.spatial import ConvexHull

    if not parts:
        return False
    inside = np.zeros(len(points), dtype=np.bool_)
    for part in parts:
        planes = ConvexHull(part).equations
        room = _INSIDE * float(np.ptp(part, axis=0).max())
        inside |= (points @ planes[:, :3].T + planes[:, 3] <= room).all(axis=1)
    return bool(inside.all())


def _bodies_and_faces(bodies: Sequence[Any]) -> tuple[list[Any], Array | None]:
    """Bodies with a volume, and the corners of the others together; None if there are none."""
    solid = [body for body in bodies if _has_volume(body.vertices)]
    loose = [body.vertices for body in bodies if not _has_volume(body.vertices)]
    return solid, np.vstack(loose) if loose else None


def _boxes(mesh: Any) -> tuple[Vertices, ...]:
    """Boxes about the bodies of a mesh along its axes, without those inside another; separate faces are one body."""
    solid, faces = _bodies_and_faces(mesh.split(only_watertight=False))
    clouds = [np.asarray(body.vertices, dtype=float) for body in solid]
    clouds += [] if faces is None else [np.asarray(faces, dtype=float)]
    bounds = [np.array((cloud.min(axis=0), cloud.max(axis=0))) for cloud in clouds]
    if not bounds or any(np.any(low == high) for low, high in bounds):
        bounds = [np.asarray(mesh.bounds, dtype=float)]
    kept: list[Array] = []
    for box in sorted(bounds, key=lambda one: -float(np.prod(one[1] - one[0]))):
        if not any(np.all(one[0] <= box[0]) and np.all(box[1] <= one[1]) for one in kept):
            kept.append(box)
    return tuple(
        tuple((x, y, z) for x in edges[0] for y in edges[1] for z in edges[2])
        for edges in (box.T.tolist() for box in kept)
    )


def _has_volume(points: Array) -> bool:
    from scipy.spatial import ConvexHull, QhullError

    try:
        ConvexHull(points)
    except (QhullError, ValueError):
        return False
    return True


def _convex_pieces(body: Any, most: int) -> list[Array]:
    if body.is_convex or not body.is_watertight:
        return [np.asarray(body.vertices, dtype=float)]
    try:
        import coacd
    except ImportError:
        raise DefinitionError(
            "collision: decompose needs the package coacd", hint="pip install coacd, or use 'hull'"
        ) from None
    coacd.set_log_level("error")
    mesh = coacd.Mesh(np.asarray(body.vertices, dtype=float), np.asarray(body.faces, dtype=np.int32))
    pieces = coacd.run_coacd(mesh, threshold=_CONCAVITY, max_convex_hull=most, seed=0)
    return [np.asarray(points, dtype=float) for points, _ in pieces]


def _reduced_hull(points: Array, path: Path) -> Vertices:
    """Corners of a shape that contains all points: extreme corners of their hull, expanded over the others."""
    from scipy.spatial import ConvexHull, QhullError

    try:
        corners = points[np.sort(ConvexHull(points).vertices)]
        corners = corners[np.lexsort(corners.T)]
        chosen = _extremes(corners)
        while True:
            normals, offsets = np.split(ConvexHull(corners[chosen]).equations, [3], axis=1)
            outside = np.max(corners @ normals.T + offsets.T, axis=1)
            if len(chosen) >= min(MOST_VERTICES, len(corners)) or np.max(outside) <= HULL_TOLERANCE_M:
                break
            chosen = [*chosen, int(np.argmax(np.round(outside, 9)))]
    except QhullError:
        raise DefinitionError(f"{path.name} is flat and has no volume", hint="use a mesh with a thickness") from None
    centre = np.mean(corners[chosen], axis=0)
    depths = -(normals @ centre + offsets[:, 0])
    growth = float(np.max((corners - centre) @ normals.T / depths))
    kept = centre + (corners[chosen] - centre) * growth if growth > 1.0 + _EXACT else corners[chosen]
    return tuple((float(x), float(y), float(z)) for x, y, z in np.unique(np.round(kept, 7), axis=0))


def _extremes(corners: Array) -> list[int]:
    """Indices of the extreme corners along the axes, edge and space diagonals of a cube."""
    grid = np.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)], dtype=float)
    return sorted({int(np.argmax(np.round(corners @ one, 9))) for one in grid[np.any(grid != 0, axis=1)]})
