"""Elements of MuJoCo's model format: bodies, shapes, inertia and numbers."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.physics.mujoco.robot_links import Capsule, Corners, Solid
from rgss.scenes import Box, Cylinder, Pose


def add_body(parent: ET.Element, name: str, pose: Pose) -> ET.Element:
    """Add a body at a pose relative to its parent.

    Args:
        parent: The element of the parent body, or of the world.
        name: Its name.
        pose: Transform of the body to its parent.
    """
    return ET.SubElement(parent, "body", {"name": name, **_placed(pose)})


def add_inertial(
    body: ET.Element,
    mass_kg: float,
    inertia: NDArray[np.float64],
    centre_m: Sequence[float] = (0.0, 0.0, 0.0),
) -> None:
    """Add mass and inertia to a body.

    Args:
        body: The element of the body.
        mass_kg: The mass.
        inertia: Inertia in kg·m², (3, 3), about the centre of mass in the axes of the body.
        centre_m: The centre of mass in the frame of the body.
    """
    entries = [float(inertia[row, column]) for row, column in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    attributes = {"pos": numbers(centre_m), "mass": number(mass_kg), "fullinertia": numbers(entries)}
    ET.SubElement(body, "inertial", attributes)


def add_geom(parent: ET.Element, name: str, shape: Solid | Corners, pose: Pose, *, touches: tuple[int, int]) -> None:
    """Add a shape to a body.

    Args:
        parent: The element of the body, or of the world.
        name: Its name, which a mesh has in the assets too.
        shape: The shape; a number is the radius (m) of a sphere, points are the corners of a mesh.
        pose: Transform of the shape to the body.
        touches: Bits of the collision filter: its own, and those of the shapes that it collides with.
    """
    if isinstance(shape, Box):
        kind, size = "box", [edge / 2 for edge in shape.size_m]
    elif isinstance(shape, Cylinder):
        kind, size = "cylinder", [shape.radius_m, shape.half_height_m]
    elif isinstance(shape, Capsule):
        kind, size = "capsule", [shape.radius_m, shape.half_length_m]
    elif isinstance(shape, tuple):
        kind, size = "mesh", []
    else:
        kind, size = "sphere", [shape]
    own, others = touches
    extent = {"mesh": name} if kind == "mesh" else {"size": numbers(size)}
    attributes = {"name": name, "type": kind, **extent}
    bits = {"contype": str(own), "conaffinity": str(others)}
    ET.SubElement(parent, "geom", {**attributes, **bits, **_placed(pose)})


def cylinder_inertia(shape: Cylinder, mass_kg: float) -> NDArray[np.float64]:
    """Inertia in kg·m², (3, 3), of a homogeneous cylinder along z."""
    across = mass_kg * (3 * shape.radius_m**2 + shape.height_m**2) / 12
    return np.diag([across, across, mass_kg * shape.radius_m**2 / 2])


def _placed(pose: Pose) -> dict[str, str]:
    x, y, z, w = pose.quaternion_xyzw
    return {"pos": numbers(pose.position_m), "quat": numbers((w, x, y, z))}


def numbers(values: Sequence[float]) -> str:
    """Values as MJCF writes them."""
    return " ".join(number(value) for value in values)


def number(value: float) -> str:
    """Value as MJCF writes it, without rounding."""
    return repr(float(value))
