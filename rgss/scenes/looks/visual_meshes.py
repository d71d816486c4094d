"""Visual meshes of links: how a robot looks in pictures. Nothing that is simulated depends on them."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.scenes.convex_shapes import origin_of
from rgss.scenes.mesh_shapes import read_mesh
from rgss.scenes.robot import LinkLook

MOST_TRIANGLES = 2500
"""Triangles of a drawn mesh at most: all links of a robot together stay below a megabyte in a page."""

_CREASE_RAD = 0.6
_CELLS, _MOST_SHIFTED = (1000, 400, 200, 100, 60, 40), 0.03
_CAREFUL, _HASTY = 3, 7
_CHANNELS = 4


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DrawnMesh:
    """Triangles of a visual mesh.

    Attributes:
        vertices_m: Vertices, shape (n, 3), each with one normal; a sharp edge has a vertex for each side.
        normals: Outward normals at the vertices, shape (n, 3).
        triangles: Vertices of each triangle, shape (m, 3), counter-clockwise seen from outside.
    """

    vertices_m: NDArray[np.float64]
    normals: NDArray[np.float64]
    triangles: NDArray[np.int64]


def looks_of(root: ET.Element, paths: Mapping[str, Path]) -> tuple[LinkLook, ...]:
    """Visual meshes of a URDF.

    Args:
        root: The URDF, without problems.
        paths: Paths of the files that it names.
    """
    colours = {
        material.get("name", ""): colour
        for material in root.findall("material")
        if (colour := _colour(material)) is not None
    }
    found = []
    for link in root.findall("link"):
        for visual in link.findall("visual"):
            mesh, material = visual.find("geometry/mesh"), visual.find("material")
            if mesh is None or mesh.get("filename", "") not in paths:
                continue
            x, y, z = (float(word) for word in mesh.get("scale", "1 1 1").split())
            colour = None if material is None else _colour(material) or colours.get(material.get("name", ""))
            found.append(
                LinkLook(
                    link=link.get("name", ""),
                    mesh=paths[mesh.get("filename", "")],
                    pose=origin_of(visual),
                    scale=(x, y, z),
                    colour=colour,
                )
            )
    return tuple(found)


def drawn_mesh(look: LinkLook) -> DrawnMesh | None:
    """Triangles of a visual mesh, fewer than the file's if it has many; None if it cannot be read."""
    try:
        return _drawn(look.mesh, look.scale, look.mesh.stat().st_mtime_ns)
    except (DefinitionError, OSError):
        return None


@lru_cache(maxsize=64)
def _drawn(path: Path, scale: tuple[float, float, float], _changed_ns: int) -> DrawnMesh | None:
    """Triangles of a file; a file that changes is read again."""
    import trimesh

    mesh = _simplified(read_mesh(path, scale))
    if len(mesh.faces) == 0:
        return None
    shaded: Any = trimesh.graph.smooth_shade(mesh, angle=_CREASE_RAD)
    return DrawnMesh(
        vertices_m=np.asarray(shaded.vertices, dtype=float),
        normals=np.asarray(shaded.vertex_normals, dtype=float),
        triangles=np.asarray(shaded.faces, dtype=np.int64),
    )


def _simplified(mesh: Any) -> Any:
    """Mesh of at most `MOST_TRIANGLES`, by edge collapse after Garland and Heckbert (1997).

    An edge with a triangle on one side alone is kept, and published meshes have many where their parts do not quite
    meet. Where too many triangles are left, or a corner leaves its place, the vertices are welded first, as finely as
    suffices.
    """
    if len(mesh.faces) <= MOST_TRIANGLES:
        return mesh
    import fast_simplification
    import trimesh

    found, fine = mesh, _welded(mesh, _CELLS[0])
    bounds_m = fine.bounds if len(fine.faces) else mesh.bounds
    for cells, haste in ((0, _CAREFUL), (0, _HASTY), *((cells, _HASTY) for cells in _CELLS)):
        welded = _welded(mesh, cells) if cells else mesh
        if len(welded.faces) <= MOST_TRIANGLES:
            return welded if len(welded.faces) else found
        vertices, faces = fast_simplification.simplify(
            np.asarray(welded.vertices, dtype=np.float32),
            np.asarray(welded.faces, dtype=np.int32),
            target_count=MOST_TRIANGLES,
            agg=haste,
        )
        found = trimesh.Trimesh(vertices=vertices, faces=faces, process=False)
        is_small = 0 < len(found.faces) <= MOST_TRIANGLES
        if is_small and np.max(np.abs(found.bounds - bounds_m)) <= _MOST_SHIFTED * np.max(mesh.extents):
            break
    return found


def _welded(mesh: Any, cells: int) -> Any:
    """Mesh whose vertices within a cell are the first of them, without the triangles that vanish by that."""
    import trimesh

    size_m = float(np.max(mesh.extents)) / cells
    places = np.floor((np.asarray(mesh.vertices) - mesh.bounds[0]) / size_m).astype(np.int64)
    _, first, cell = np.unique(places, axis=0, return_index=True, return_inverse=True)
    faces = cell.reshape(-1)[np.asarray(mesh.faces)]
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    found = trimesh.Trimesh(vertices=np.asarray(mesh.vertices)[first], faces=faces, process=False)
    found.update_faces(found.unique_faces())
    return found


def _colour(material: ET.Element) -> tuple[float, float, float, float] | None:
    element = material.find("color")
    words: Sequence[str] = "" if element is None else element.get("rgba", "").split()
    try:
        values = [min(max(float(word), 0.0), 1.0) for word in words]
    except ValueError:
        return None
    if len(values) != _CHANNELS:
        return None
    red, green, blue, opacity = values
    return red, green, blue, opacity
