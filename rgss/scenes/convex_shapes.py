"""Convex collision shapes of a robot, stored in its URDF as points, so that all engines use the same ones.

Standard URDF supports convex shapes only as mesh files. Internally each mesh is replaced by ``<convex vertices="x y z
…"/>``: a robot is one text, its digest covers the shapes, and no engine reads a user's file.
"""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

from rgss.scenes.pose import Pose

Point = tuple[float, float, float]

CONVEX = "convex"
_DECIMALS = 7


@dataclass(frozen=True, slots=True, kw_only=True)
class ConvexPart:
    """One convex collision shape of a link.

    Attributes:
        link: The link.
        pose: Transform of the shape's frame to the link.
        vertices_m: Its corners.
    """

    link: str
    pose: Pose
    vertices_m: tuple[Point, ...]


def convex_element(vertices_m: tuple[Point, ...]) -> ET.Element:
    """Element of a convex shape."""
    numbers = (f"{value:.{_DECIMALS}f}" for point in vertices_m for value in point)
    return ET.Element(CONVEX, {"vertices": " ".join(numbers)})


def vertices_of(element: ET.Element) -> tuple[Point, ...]:
    """Corners of a convex shape."""
    numbers = [float(word) for word in element.get("vertices", "").split()]
    return tuple(zip(numbers[::3], numbers[1::3], numbers[2::3], strict=True))


@lru_cache(maxsize=16)
def convex_parts(urdf: str) -> tuple[str, tuple[ConvexPart, ...]]:
    """Extract the convex shapes of a URDF.

    Args:
        urdf: A robot's URDF.

    Returns:
        The URDF without them, unchanged if there are none, and the shapes in document order.
    """
    if f"<{CONVEX}" not in urdf:
        return urdf, ()
    root = ET.fromstring(urdf)  # noqa: S314 - entities and document types were refused on reading
    parts = []
    for link in root.findall("link"):
        for tag in ("collision", "visual"):
            for shape in link.findall(tag):
                found = shape.find(f"geometry/{CONVEX}")
                if found is None:
                    continue
                link.remove(shape)
                if tag == "collision":
                    parts.append(
                        ConvexPart(link=link.get("name", ""), pose=origin_of(shape), vertices_m=vertices_of(found))
                    )
    return ET.tostring(root, encoding="unicode"), tuple(parts)


def with_mesh_files(urdf: str, write: Callable[[int, tuple[Point, ...]], str]) -> str:
    """URDF in which each convex shape is a mesh file, for an engine that reads only files.

    Args:
        urdf: A robot's URDF; returned unchanged if it has no convex shapes.
        write: Callback that writes the points of a shape from its number and returns the file's name.
    """
    if f"<{CONVEX}" not in urdf:
        return urdf
    root = ET.fromstring(urdf)  # noqa: S314 - entities and document types were refused on reading
    names: dict[str, str] = {}
    for geometry in root.iter("geometry"):
        found = geometry.find(CONVEX)
        if found is None:
            continue
        text = found.get("vertices", "")
        if text not in names:
            names[text] = write(len(names), vertices_of(found))
        geometry.remove(found)
        ET.SubElement(geometry, "mesh", {"filename": names[text]})
    return ET.tostring(root, encoding="unicode")


def origin_of(element: ET.Element) -> Pose:
    """Pose of an element's ``<origin>``.

    Args:
        element: A joint or a shape.
    """
    origin = element.find("origin")
    if origin is None:
        return Pose()
    (x, y, z), (roll, pitch, yaw) = (
        [float(value) for value in origin.get(key, "0 0 0").split()] for key in ("xyz", "rpy")
    )
    return Pose.from_roll_pitch_yaw((x, y, z), (roll, pitch, yaw))
