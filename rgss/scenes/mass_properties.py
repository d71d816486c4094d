"""Mass properties of the object: centre of mass and inertia in the frame of its shape."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.scenes.pose import Pose
from rgss.scenes.shapes import Box, Cylinder, LyingCylinder, ObjectShape

Gyration = tuple[float, float, float, float, float, float]
"""Inertia about the centre of mass divided by the mass, in m²: xx, yy, zz, xy, xz, yz."""

_DIAGONAL = 1e-9


class _Massive(Protocol):
    """Interface of the mass properties of an object."""

    @property
    def shape(self) -> ObjectShape: ...
    @property
    def mass_kg(self) -> float: ...
    @property
    def centre_of_mass_m(self) -> float: ...
    @property
    def centre_of_mass_across_m(self) -> tuple[float, float]: ...
    @property
    def gyration_m2(self) -> Gyration | None: ...


def centre_of_mass(workpiece: _Massive) -> tuple[float, float, float]:
    """Centre of mass in the frame of the shape, in m."""
    x, y = workpiece.centre_of_mass_across_m
    return x, y, workpiece.centre_of_mass_m


def inertia_kg_m2(workpiece: _Massive) -> NDArray[np.float64]:
    """Inertia about the centre of mass along the axes of the shape's frame, shape (3, 3).

    That of the homogeneous shape by default.
    """
    if workpiece.gyration_m2 is None:
        return np.diag(solid_moments(workpiece.shape, workpiece.mass_kg))
    xx, yy, zz, xy, xz, yz = workpiece.gyration_m2
    found: NDArray[np.float64] = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]) * workpiece.mass_kg
    return found


def solid_moments(shape: ObjectShape, mass_kg: float) -> tuple[float, float, float]:
    """Moments of inertia of a homogeneous box or cylinder about its centre, in kg m².

    Args:
        shape: The solid; the mass properties of a mesh are stated instead.
        mass_kg: Its mass.
    """
    if isinstance(shape, Box):
        x, y, z = shape.size_m
        return mass_kg * (y**2 + z**2) / 12, mass_kg * (x**2 + z**2) / 12, mass_kg * (x**2 + y**2) / 12
    if isinstance(shape, Cylinder):
        across = mass_kg * (3 * shape.radius_m**2 + shape.height_m**2) / 12
        return across, across, mass_kg * shape.radius_m**2 / 2
    if isinstance(shape, LyingCylinder):
        across, _, along = solid_moments(shape.upright, mass_kg)
        return along, across, across
    raise AssertionError("the inertia of a mesh is computed as it is read")


def principal_frame(workpiece: _Massive) -> tuple[Pose, tuple[float, float, float]]:
    """Transform of the principal frame at the centre of mass to the shape's frame, and the principal moments in kg m².

    The axes equal those of the shape's frame if the inertia is diagonal there.
    """
    inertia, at = inertia_kg_m2(workpiece), centre_of_mass(workpiece)
    off = inertia - np.diag(np.diag(inertia))
    if np.max(np.abs(off)) <= _DIAGONAL * np.max(np.diag(inertia)):
        xx, yy, zz = (float(value) for value in np.diag(inertia))
        return Pose(position_m=at), (xx, yy, zz)
    moments, axes = np.linalg.eigh(inertia)
    for column in range(3):
        largest = int(np.argmax(np.abs(axes[:, column])))
        axes[:, column] *= np.sign(axes[largest, column])
    if np.linalg.det(axes) < 0.0:
        axes[:, 2] *= -1.0
    xx, yy, zz = (float(value) for value in moments)
    return Pose(position_m=at, quaternion_xyzw=quaternion_of(axes)), (xx, yy, zz)


def quaternion_of(axes: NDArray[np.float64]) -> tuple[float, float, float, float]:
    """Unit quaternion, scalar last and not negative, of a rotation matrix.

    Args:
        axes: The matrix, shape (3, 3).
    """
    from scipy.spatial.transform import Rotation

    x, y, z, w = (float(value) for value in Rotation.from_matrix(axes).as_quat())
    return (x, y, z, w) if w >= 0.0 else (-x, -y, -z, -w)
