"""Convex parts of an arm's concave collision meshes, written as meshes of their own."""

from __future__ import annotations

import copy
import importlib.util
import math
import xml.etree.ElementTree as ET
from collections.abc import Collection
from pathlib import Path

from rgss.scenes import mesh_summary, write_convex_parts
from rgss.studies.robot_project.urdf.reading import Note

INSTALL = "pip install 'rgss[meshes]': concave collision meshes are divided into convex parts then"
LARGEST_HULL_RATIO = 1.25
"""Volume of the hull of a mesh divided by its own above which the mesh counts as concave."""

_PARTS = "convex_parts"


def can_decompose() -> bool:
    """True if the package that divides meshes is installed."""
    return importlib.util.find_spec("coacd") is not None


def has_concave_meshes(root: ET.Element, robots: Path) -> bool:
    """True if the hull of a collision mesh is much larger than the mesh.

    Args:
        root: The URDF; its files are in the folder.
        robots: The folder.
    """
    return any(_is_concave(mesh, robots) for mesh in root.iterfind("link/collision/geometry/mesh"))


def decompose(root: ET.Element, robots: Path, only: Collection[str] | None = None) -> list[Note]:
    """Replace each concave collision mesh by its convex parts, which are written beside the URDF.

    Args:
        root: The URDF; modified in place. Its files are in the folder.
        robots: The folder.
        only: Links whose meshes are divided; all if None.

    Returns:
        What was assumed.

    Raises:
        DefinitionError: A mesh has no volume.
    """
    count, links = 0, []
    for link in root.findall("link"):
        for number, shape in enumerate(link.findall("collision")):
            mesh = shape.find("geometry/mesh")
            is_wanted = only is None or link.get("name", "") in only
            if mesh is None or not is_wanted or not _is_concave(mesh, robots):
                continue
            path = robots / mesh.get("filename", "")
            # Several shapes may have the same mesh at other scales.
            folder = path.parent / _PARTS / f"{link.get('name')}_{number}"
            folder.mkdir(parents=True, exist_ok=True)
            at = list(link).index(shape)
            link.remove(shape)
            parts = write_convex_parts(path, folder, scale=_scale(mesh))
            for name in reversed(parts):
                part = copy.deepcopy(shape)
                of_part = part.find("geometry/mesh")
                if of_part is not None:
                    of_part.attrib = {"filename": (folder / name).relative_to(robots).as_posix()}
                link.insert(at, part)
            count += len(parts)
            links.append(link.get("name", ""))
    if not links:
        return []
    names = ", ".join(dict.fromkeys(links))
    rationale = (
        f"The hulls of its collision meshes did not suit the task. {count} convex parts stand for those of {names}."
    )
    return [Note(about="description", rationale=rationale)]


def _is_concave(mesh: ET.Element, robots: Path) -> bool:
    ratio = mesh_summary(robots / mesh.get("filename", ""), scale=_scale(mesh)).hull_ratio
    return math.isfinite(ratio) and ratio > LARGEST_HULL_RATIO


def _scale(mesh: ET.Element) -> tuple[float, float, float]:
    x, y, z = (float(word) for word in mesh.get("scale", "1 1 1").split())
    return x, y, z
