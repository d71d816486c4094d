"""Volume, centre of mass and inertia of a link's shapes, for a URDF without masses."""

from __future__ import annotations

import hashlib
import math
import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError
from rgss.scenes.convex_shapes import origin_of
from rgss.scenes.mesh_shapes import mesh_corners

Array = NDArray[np.float64]
FindFile = Callable[[str], Path | None]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinkSolid:
    """Link as a homogeneous body of density 1.

    Attributes:
        volume_m3: Its volume; overlaps count twice.
        centre_m: Its centre of mass in the link's frame, shape (3,).
        inertia_m5: Inertia about that centre divided by the density, along the axes of the link's frame, shape (3, 3).
    """

    volume_m3: float
    centre_m: Array
    inertia_m5: Array


def link_solid(link: ET.Element, find: FindFile) -> LinkSolid | None:
    """Body of a link's collision shapes, else of its visual ones; a mesh is replaced by its convex hull.

    Args:
        link: The link's element.
        find: Function that returns the file of a mesh by name, or None.

    Returns:
        The body; None if the link has no shape with a volume.
    """
    for kind in ("collision", "visual"):
        parts = [part for shape in link.findall(kind) if (part := _part(shape, find)) is not None]
        if parts:
            return _joined(parts)
    return None


def _part(shape: ET.Element, find: FindFile) -> LinkSolid | None:
    geometry = shape.find("geometry")
    found = None if geometry is None else _solid(geometry, find)
    if found is None or not found.volume_m3 > 0.0:
        return None
    pose = origin_of(shape)
    turn = np.array([pose.rotate(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]).T
    return LinkSolid(
        volume_m3=found.volume_m3,
        centre_m=np.array(pose.position_m) + turn @ found.centre_m,
        inertia_m5=turn @ found.inertia_m5 @ turn.T,
    )


def _solid(geometry: ET.Element, find: FindFile) -> LinkSolid | None:
    box, cylinder, sphere, mesh = (geometry.find(kind) for kind in ("box", "cylinder", "sphere", "mesh"))
    if box is not None:
        x, y, z = (float(word) for word in box.get("size", "0 0 0").split())
        volume = x * y * z
        return _about_origin(volume, [volume * (a**2 + b**2) / 12 for a, b in ((y, z), (x, z), (x, y))])
    if cylinder is not None:
        radius, length = float(cylinder.get("radius", "0")), float(cylinder.get("length", "0"))
        volume = math.pi * radius**2 * length
        across = volume * (3 * radius**2 + length**2) / 12
        return _about_origin(volume, [across, across, volume * radius**2 / 2])
    if sphere is not None:
        radius = float(sphere.get("radius", "0"))
        volume = 4 / 3 * math.pi * radius**3
        return _about_origin(volume, [0.4 * volume * radius**2] * 3)
    path = None if mesh is None else find(mesh.get("filename", ""))
    if mesh is None or path is None:
        return None
    x, y, z = (float(word) for word in mesh.get("scale", "1 1 1").split())
    return _hull(path, (x, y, z))


def _about_origin(volume: float, moments: list[float]) -> LinkSolid:
    return LinkSolid(volume_m3=volume, centre_m=np.zeros(3), inertia_m5=np.diag(moments))


@dataclass(frozen=True, slots=True, kw_only=True)
class _ScaledMesh:
    """Mesh with factors along its axes; equal to that of a copy, since a draft is made from copies of its files."""

    sha256: str
    suffix: str
    scale: tuple[float, float, float]
    path: Path = field(compare=False)


def _hull(path: Path, scale: tuple[float, float, float]) -> LinkSolid | None:
    sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
    return _hull_of(_ScaledMesh(sha256=sha256, suffix=path.suffix.lower(), scale=scale, path=path))


@lru_cache(maxsize=64)
def _hull_of(mesh: _ScaledMesh) -> LinkSolid | None:
    try:
        corners = mesh_corners(mesh.path, scale=mesh.scale)
    except DefinitionError:
        return None
    import trimesh

    hull: Any = trimesh.convex.convex_hull(corners)
    return LinkSolid(
        volume_m3=float(hull.volume),
        centre_m=np.array(hull.center_mass, dtype=float),
        inertia_m5=np.array(hull.moment_inertia, dtype=float),
    )


def _joined(parts: list[LinkSolid]) -> LinkSolid:
    volume = sum(part.volume_m3 for part in parts)
    centre = np.sum([part.volume_m3 * part.centre_m for part in parts], axis=0) / volume
    inertia = np.zeros((3, 3))
    for part in parts:
        away = part.centre_m - centre
        inertia += part.inertia_m5 + part.volume_m3 * (away @ away * np.eye(3) - np.outer(away, away))
    return LinkSolid(volume_m3=volume, centre_m=centre, inertia_m5=inertia)
