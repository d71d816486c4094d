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
_CELLS, _FEWEST_CELLS, _COARSER = 96, 6, 0.8
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
    """Triangles of a visual mesh, fewer than the file's if it has many; None if it cannot be read.

    Args:
        look: The visual mesh.
    """
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
    """Mesh of at most `MOST_TRIANGLES`, by the finest grid that suffices: vertices of a cell are merged at their mean.

    Vertex clustering after Rossignac and Borrel (1993).
    """
    import trimesh

    cells = float(_CELLS)
    found = mesh
    while len(found.faces) > MOST_TRIANGLES and cells >= _FEWEST_CELLS:
        size_m = float(np.max(mesh.extents)) / cells
        places = np.floor((np.asarray(mesh.vertices) - mesh.bounds[0]) / size_m).astype(np.int64)
        _, cell = np.unique(places, axis=0, return_inverse=True)
        cell = cell.reshape(-1)
        means = _sums(cell, np.asarray(mesh.vertices)) / np.bincount(cell)[:, np.newaxis]
        faces = cell[np.asarray(mesh.faces)]
        a, b, c = faces.T
        faces = faces[(a != b) & (b != c) & (c != a)]
        found = trimesh.Trimesh(vertices=means, faces=faces, process=False)
        # A triangle that is folded over looks the other way than the vertices that were merged.
        outward = _sums(cell, np.asarray(mesh.vertex_normals))[faces].sum(axis=1)
        found.update_faces(found.unique_faces() & (np.einsum("ij,ij->i", found.face_normals, outward) >= 0.0))
        cells *= _COARSER
    return found


def _sums(cell: NDArray[np.int64], rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Sum of the rows of each cell."""
    sums = np.zeros((int(cell.max()) + 1, rows.shape[1]))
    np.add.at(sums, cell, rows)
    return sums


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
