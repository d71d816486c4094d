"""Surfaces of the shapes of a scene, with half the sizes of the boxes about them."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.physics.solids import Surface, box_surface, cup_surface, cylinder_surface, hull_surface
from rgss.scenes import Box, LyingCylinder, MeshShape, ObjectShape, Pose, Shape


def object_surfaces(shape: ObjectShape) -> list[tuple[Surface, Pose, tuple[float, float, float]]]:
    """Surfaces of the object with their transforms to its frame and half sizes; a cylinder is drawn as a cup."""
    if isinstance(shape, MeshShape):
        return [(hull_surface(part), Pose(), half_extent(part)) for part in shape.parts_m]
    if isinstance(shape, LyingCylinder):
        along_x = Pose.from_roll_pitch_yaw((0.0, 0.0, 0.0), (0.0, math.pi / 2, 0.0))
        return [(cylinder_surface(shape.upright), along_x, half_size(shape.upright))]
    if isinstance(shape, Box):
        return [(box_surface(shape), Pose(), half_size(shape))]
    return [(cup_surface(shape), Pose(), half_size(shape))]


def shape_surface(shape: Shape) -> Surface:
    """Surface of a box or a cylinder in its own frame."""
    return box_surface(shape) if isinstance(shape, Box) else cylinder_surface(shape)


def half_extent(corners: Sequence[tuple[float, float, float]]) -> tuple[float, float, float]:
    """Half sizes of the bounding box about the origin."""
    x, y, z = (max(abs(corner[axis]) for corner in corners) for axis in range(3))
    return x, y, z


def half_size(shape: Shape) -> tuple[float, float, float]:
    """Half sizes of the bounding box of a box or an upright cylinder."""
    if isinstance(shape, Box):
        x, y, z = shape.size_m
        return x / 2, y / 2, z / 2
    return shape.radius_m, shape.radius_m, shape.half_height_m
