"""The surfaces of solids are closed and face outward."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.physics.solids import box_surface, cup_surface, cylinder_surface
from rgss.scenes import Box, Cylinder

CAN = Cylinder(radius_m=0.04, height_m=0.5)


def triangles(surface):
    return np.array(surface.vertices_m)[np.array(surface.indices).reshape(-1, 3)]


def volume(surface):
    """By the divergence theorem; right only for a closed surface whose triangles turn one way."""
    a, b, c = np.moveaxis(triangles(surface), 1, 0)
    return float(np.einsum("ni,ni->", a, np.cross(b, c)) / 6)


def polygon_share(facets=32):
    """The area of a regular polygon over that of its circle."""
    return facets * math.sin(math.tau / facets) / math.tau


def test_volume_of_a_box():
    assert volume(box_surface(Box(size_m=(0.2, 0.3, 0.5)))) == pytest.approx(0.2 * 0.3 * 0.5)


@pytest.mark.parametrize("height", [0.002, 0.08, 0.5])
def test_volume_of_a_cylinder(height):
    surface = cylinder_surface(Cylinder(radius_m=0.04, height_m=height))

    assert volume(surface) == pytest.approx(polygon_share() * math.pi * 0.04**2 * height)


def test_a_cup_is_hollow_and_within_its_cylinder():
    surface = cup_surface(CAN)
    corners = np.array(surface.vertices_m)

    assert 0.1 * volume(cylinder_surface(CAN)) < volume(surface) < 0.3 * volume(cylinder_surface(CAN))
    assert np.hypot(corners[:, 0], corners[:, 1]).max() == pytest.approx(CAN.radius_m)
    assert np.abs(corners[:, 2]).max() == pytest.approx(CAN.half_height_m)


@pytest.mark.parametrize("surface", [box_surface(Box(size_m=(0.2, 0.3, 0.5))), cylinder_surface(CAN), cup_surface(CAN)])
def test_normals_are_of_unit_length_and_on_the_side_of_the_face(surface):
    a, b, c = np.moveaxis(triangles(surface), 1, 0)
    faces = np.cross(b - a, c - a)
    normals = np.array(surface.normals)

    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0)
    for corner in np.array(surface.indices).reshape(-1, 3).T:
        along = np.einsum("ni,ni->n", normals[corner], faces)
        assert (along >= 0.0).all()
        # Where a triangle has shrunk to a line on the axis, it faces nowhere.
        assert ((along > 0.0) | (np.linalg.norm(faces, axis=1) < 1e-12)).all()
