"""Problems of the meshes of an arm's description that can be used all the same."""

from __future__ import annotations

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

from rgss.errors import DefinitionError
from rgss.scenes import mesh_extent_m, mesh_summary
from rgss.studies.robot_project.urdf import LARGEST_HULL_RATIO

LARGEST_LENGTH_M = 10.0
"""Length that no part of an arm has."""

_MILLIMETRES = 1000.0
# Between two shapes of one link and a factor of 1000; a cover or a coarse box differs by less.
_LARGEST_RATIO = 100.0
_HINT = 'write scale="0.001 0.001 0.001"'

Problem = tuple[str, str, str, str]


def mesh_problems(root: ET.Element, urdf: Path) -> Iterator[Problem]:
    """Problems of the collision meshes, and visual meshes in millimetres.

    Args:
        root: The URDF.
        urdf: Its file.

    Yields:
        Name of the mesh, rule, message and hint.
    """
    for link in root.findall("link"):
        lengths_m = list(_lengths_of_solids(link))
        for mesh in link.findall("collision/geometry/mesh"):
            path = _path_of(mesh, urdf)
            if path is None:
                continue
            name = mesh.get("filename", "")
            try:
                found = mesh_summary(path, scale=_scale(mesh))
            except DefinitionError as error:
                yield name, "robot.mesh", error.message, error.hint
                continue
            lengths_m.append(max(found.extent_m))
            if max(found.extent_m) > LARGEST_LENGTH_M:
                message = f"the mesh {name} is {max(found.extent_m):g} m long: is it in millimetres?"
                yield name, "robot.units", message, _HINT
            if not found.is_closed:
                yield name, "robot.open-mesh", f"the mesh {name} is not closed", "its hull is simulated all the same"
            elif found.hull_ratio > LARGEST_HULL_RATIO and math.isfinite(found.hull_ratio):
                yield (
                    name,
                    "robot.concave-mesh",
                    f"the mesh {name} is concave: its hull has {found.hull_ratio:.2f} times its volume",
                    "write 'collision: decompose' in the robot file if the arm comes near to itself or to the scene",
                )
        yield from _visual_problems(link, urdf, max(lengths_m, default=None))


def _visual_problems(link: ET.Element, urdf: Path, length_m: float | None) -> Iterator[Problem]:
    """Visual meshes that are longer than any arm, or of another unit than the collision shapes of their link."""
    collision = {_key(mesh) for mesh in link.findall("collision/geometry/mesh")}
    for mesh in link.findall("visual/geometry/mesh"):
        name, path = mesh.get("filename", ""), _path_of(mesh, urdf)
        if path is None or _key(mesh) in collision:
            continue
        try:
            visual_m = mesh_extent_m(path, scale=_scale(mesh))
        except DefinitionError:
            continue
        seen = f"the visual mesh {name} is {visual_m:.3g} m long"
        if visual_m > LARGEST_LENGTH_M:
            yield name, "robot.units", f"{seen}: is it in millimetres?", _HINT
        elif length_m is not None and visual_m * _LARGEST_RATIO < length_m:
            message = f"{seen}, the collision shapes of {link.get('name', '')} {length_m:.3g} m: is its scale right?"
            yield name, "robot.units", message, f"write {_scale_text(mesh, _MILLIMETRES)} if it is in metres"
        elif length_m is not None and visual_m > _LARGEST_RATIO * length_m:
            message = f"{seen}, the collision shapes of {link.get('name', '')} {length_m:.3g} m: is it in millimetres?"
            yield name, "robot.units", message, f"write {_scale_text(mesh, 1.0 / _MILLIMETRES)}"


def _lengths_of_solids(link: ET.Element) -> Iterator[float]:
    """Greatest length of each primitive collision shape of a link."""
    for geometry in link.findall("collision/geometry"):
        box, cylinder, sphere = (geometry.find(tag) for tag in ("box", "cylinder", "sphere"))
        if box is not None:
            yield max((float(word) for word in box.get("size", "").split()), default=0.0)
        if cylinder is not None:
            yield max(float(cylinder.get("length", "0")), 2.0 * float(cylinder.get("radius", "0")))
        if sphere is not None:
            yield 2.0 * float(sphere.get("radius", "0"))


def _scale(mesh: ET.Element) -> tuple[float, float, float]:
    x, y, z = (float(word) for word in mesh.get("scale", "1 1 1").split())
    return (x, y, z)


def _scale_text(mesh: ET.Element, factor: float) -> str:
    return f'scale="{" ".join(f"{value * factor:g}" for value in _scale(mesh))}"'


def _key(mesh: ET.Element) -> tuple[str, tuple[float, float, float]]:
    return mesh.get("filename", ""), _scale(mesh)


def _path_of(mesh: ET.Element, urdf: Path) -> Path | None:
    """The file of a mesh of a checked URDF; None where it is none."""
    name = mesh.get("filename", "")
    rest = name.removeprefix("package://")
    package, _, below = rest.partition("/")
    candidates = [urdf.parent / rest]
    if rest != name:
        for folder in urdf.resolve().parents:
            candidates += [folder / package / below] + ([folder / below] if folder.name == package else [])
    return next((path for path in candidates if path.is_file()), None)
