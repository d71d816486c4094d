"""Shapes of bodies and objects, common to all engines."""

from __future__ import annotations

import math
from dataclasses import dataclass

Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True, kw_only=True)
class Box:
    """A box centred in its frame.

    Attributes:
        size_m: Full edge lengths along x, y, z.
    """

    size_m: tuple[float, float, float]

    @property
    def half_height_m(self) -> float:
        """Half the extent along z."""
        return self.size_m[2] / 2


@dataclass(frozen=True, slots=True, kw_only=True)
class Cylinder:
    """A cylinder centred in its frame, its axis along z."""

    radius_m: float
    height_m: float

    @property
    def half_height_m(self) -> float:
        """Half the extent along z."""
        return self.height_m / 2


@dataclass(frozen=True, slots=True, kw_only=True)
class LyingCylinder:
    """A cylinder centred in its frame, its axis along x: the resting pose of a lying cylinder, with z up."""

    radius_m: float
    length_m: float

    @property
    def half_height_m(self) -> float:
        """Half the extent along z."""
        return self.radius_m

    @property
    def upright(self) -> Cylinder:
        """The same solid with its axis along z."""
        return Cylinder(radius_m=self.radius_m, height_m=self.length_m)


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshShape:
    """Convex parts of a mesh, in a frame whose origin is the centre of their bounding box.

    Attributes:
        parts_m: Corners of each part.
        sha256: Digest of the file's content.
    """

    parts_m: tuple[tuple[Point, ...], ...]
    sha256: str

    @property
    def half_height_m(self) -> float:
        """Half the extent along z."""
        return max(z for part in self.parts_m for _, _, z in part)


Shape = Box | Cylinder
"""A solid of a fixed body or a gripper."""

ObjectShape = Box | Cylinder | LyingCylinder | MeshShape
"""Solid of an object, which rests with its frame's z axis up."""


def corners_of(shape: ObjectShape, *, facets: int = 64) -> tuple[tuple[Point, ...], ...]:
    """Corners of the convex parts of a shape; a cylinder is approximated by a circumscribed prism.

    Args:
        shape: The shape.
        facets: Number of sides of the prism.
    """
    if isinstance(shape, MeshShape):
        return shape.parts_m
    if isinstance(shape, Box):
        x, y, z = (size / 2 for size in shape.size_m)
        return (tuple((a * x, b * y, c * z) for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)),)
    length_m = shape.length_m if isinstance(shape, LyingCylinder) else shape.height_m
    radius_m = shape.radius_m / math.cos(math.pi / facets)
    turns = [math.tau * (place + 0.5) / facets for place in range(facets)]
    rim = [(radius_m * math.cos(turn), radius_m * math.sin(turn)) for turn in turns]
    ends = (-length_m / 2, length_m / 2)
    if isinstance(shape, LyingCylinder):
        return (tuple((end, y, z) for y, z in rim for end in ends),)
    return (tuple((x, y, end) for x, y in rim for end in ends),)


def half_extents_m(shape: ObjectShape) -> Point:
    """Half the extents along the axes of the shape's frame."""
    if isinstance(shape, Box):
        x, y, z = shape.size_m
        return x / 2, y / 2, z / 2
    if isinstance(shape, Cylinder):
        return shape.radius_m, shape.radius_m, shape.half_height_m
    if isinstance(shape, LyingCylinder):
        return shape.length_m / 2, shape.radius_m, shape.radius_m
    x, y, z = (max(abs(corner[axis]) for part in shape.parts_m for corner in part) for axis in range(3))
    return x, y, z


def girth_radius_m(shape: ObjectShape) -> float:
    """Greatest distance in m of the solid from the vertical through its centre; the radius of an upright cylinder.

    It serves as the characteristic length, the divisor of torques in comparisons with forces.
    """
    if isinstance(shape, Cylinder):
        return shape.radius_m
    if isinstance(shape, MeshShape):
        return max(math.hypot(x, y) for part in shape.parts_m for x, y, _ in part)
    x, y, _ = half_extents_m(shape)
    return math.hypot(x, y)


def least_height_m(shape: ObjectShape, up: Point) -> float:
    """Least coordinate in m of the solid along a direction, relative to its centre; negative.

    Args:
        shape: The solid.
        up: Unit direction in its frame.
    """
    if isinstance(shape, Box):
        return -math.fsum(size / 2 * abs(along) for size, along in zip(shape.size_m, up, strict=True))
    if isinstance(shape, MeshShape):
        return min(x * up[0] + y * up[1] + z * up[2] for part in shape.parts_m for x, y, z in part)
    half_m, along = (shape.half_height_m, up[2]) if isinstance(shape, Cylinder) else (shape.length_m / 2, up[0])
    return -(half_m * abs(along) + shape.radius_m * math.sqrt(max(0.0, 1.0 - along * along)))
