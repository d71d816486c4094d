"""Rotational symmetry of an object about the vertical."""

from __future__ import annotations

import math

from rgss.scenes import Box, Cylinder, LyingCylinder, ObjectShape

_EQUAL_M = 1e-6


def symmetric_turns(shape: ObjectShape, yaws: int) -> tuple[float, ...]:
    """Rotations in rad about the vertical that leave the shape unchanged, 0 first.

    Args:
        shape: The object's shape.
        yaws: Number of rotations returned for an upright cylinder.
    """
    if isinstance(shape, Cylinder):
        return tuple(math.tau * turn / yaws for turn in range(yaws))
    if isinstance(shape, Box):
        x, y, _ = shape.size_m
        count = 4 if abs(x - y) <= _EQUAL_M else 2
        return tuple(math.tau * turn / count for turn in range(count))
    return (0.0, math.pi) if isinstance(shape, LyingCylinder) else (0.0,)
