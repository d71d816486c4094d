"""Grasp polygons: angles, centroids, and where they fail to be polygons."""

from __future__ import annotations

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial import ConvexHull, Delaunay

from rgss.errors import DefinitionError
from rgss.grasping import ContactPoint, Grasp, grasp_polygon, q_diff_m, q_gpri
from rgss.grasping.polygon import internal_angles, worst_deviation

X, Z = (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)
COORDINATE = st.floats(-1.0, 1.0)
POINTS = st.lists(st.tuples(COORDINATE, COORDINATE), min_size=3, max_size=8)


def grasp_at(points, **details):
    contacts = [ContactPoint(position_m=(*map(float, point), 0.0)[:3], normal=X, **details) for point in points]
    return Grasp.of(contacts, (0.0, 0.0, 0.0), 1.0)


def polygon_at(points, axis=Z):
    return grasp_polygon(grasp_at(points), axis)


@pytest.mark.parametrize("count", range(3, 9))
def test_regular_polygons(ring, grasp_of, count):
    polygon = grasp_polygon(grasp_of(ring(count)), Z)

    assert internal_angles(polygon.corners_m) == pytest.approx(np.full(count, math.pi * (count - 2) / count))
    assert q_gpri(polygon) == pytest.approx(0.0, abs=1e-12)
    assert q_diff_m(polygon) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        # Angles 90°, 45°, 45° off 60° make 60° of the worst 240°.
        ([(0, 0), (1, 0), (0, 1)], 0.25),
        # A rectangle has the angles of a square.
        ([(0, 0), (3, 0), (3, 1), (0, 1)], 0.0),
        # A corner in the middle of an edge: 60°, 60°, 60°, 180° off 90° make 180° of the worst 360°.
        ([(-1, 0), (0, 0), (1, 0), (0, math.sqrt(3))], 0.5),
        ([(0, 0), (1, 1), (2, 2)], 1.0),
        ([(-2, 0), (-1, 0), (1, 0), (2, 0)], 1.0),
        # An arrowhead with angles of 3°, 35°, 315° and 6°, off by more than any convex polygon.
        ([(3, 2), (9, 3), (-9, 4), (2, 3)], 1.0),
        ([(0, 0), (1, 0)], None),
        ([(0.5, 0.5)], None),
        ([(0, 0), (1, 0), (1, 0), (0, 0)], None),
    ],
)
def test_regularity(points, expected):
    assert q_gpri(polygon_at(points)) == (None if expected is None else pytest.approx(expected, abs=1e-9))


@pytest.mark.parametrize("corners", range(3, 9))
def test_the_worst_polygon_is_pressed_into_a_line(corners):
    # Nearly in a line: the ends have angles near 0, the others near π.
    along = np.linspace(-1.0, 1.0, corners)
    polygon = polygon_at(np.column_stack([along, 1e-5 * (1.0 - along**2)]))

    assert not polygon.is_flat
    assert q_gpri(polygon) == pytest.approx(1.0, abs=1e-4)
    mean = math.pi * (corners - 2) / corners
    assert worst_deviation(corners) == pytest.approx((corners - 2) * (math.pi - mean) + 2 * mean)


@given(POINTS)
def test_regularity_is_between_0_and_1_and_angles_sum_up(points):
    polygon = polygon_at(points)
    value = q_gpri(polygon)

    assert value is None or 0.0 <= value <= 1.0
    if not polygon.is_flat and value is not None and len(np.unique(np.round(points, 3), axis=0)) == len(points):
        total = float(np.sum(internal_angles(polygon.corners_m)))
        assert total / math.pi == pytest.approx(len(polygon.corners_m) - 2, abs=1e-3)


def test_convex_polygons_against_their_hulls():
    rng = np.random.default_rng(6)
    for _ in range(100):
        angles = np.sort(rng.uniform(0.0, 2 * math.pi, int(rng.integers(3, 8))))
        points = np.column_stack([2.0 * np.cos(angles), np.sin(angles)]) + rng.normal(size=2)
        corners = points[ConvexHull(points).vertices]
        back, ahead = np.roll(corners, 1, axis=0) - corners, np.roll(corners, -1, axis=0) - corners
        cosines = np.sum(back * ahead, axis=1) / np.linalg.norm(back, axis=1) / np.linalg.norm(ahead, axis=1)
        count = len(points)
        deviation = np.sum(np.abs(np.arccos(np.clip(cosines, -1.0, 1.0)) - math.pi * (count - 2) / count))
        polygon = polygon_at(rng.permutation(points))
        assert q_gpri(polygon) == pytest.approx(deviation / (4 * math.pi * (count - 2) / count), abs=1e-6)
        triangles = points[Delaunay(points).simplices]
        edges = triangles[:, 1:] - triangles[:, :1]
        areas = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
        centroid = areas @ triangles.mean(axis=1) / areas.sum()
        assert q_diff_m(polygon) == pytest.approx(np.linalg.norm(centroid), abs=1e-9)


def test_the_centroid_is_that_of_the_area():
    # A trapezoid with parallel sides of 2 and 1, a height of 1 and a right angle.
    polygon = polygon_at([(0, 0), (2, 0), (1, 1), (0, 1)])

    assert polygon.centroid_m == pytest.approx([7 / 9, 4 / 9, 0.0])


def test_the_centroid_of_a_line_is_its_middle():
    assert polygon_at([(0, 0), (1, 1), (4, 4)]).centroid_m == pytest.approx([2.0, 2.0, 0.0])
    assert polygon_at([(0, 2), (1, 3), (4, 6)]).centroid_m == pytest.approx([2.0, 4.0, 0.0])
    assert polygon_at([(1, 0), (3, 0)]).centroid_m == pytest.approx([2.0, 0.0, 0.0])
    assert polygon_at([(1, 2)]).centroid_m == pytest.approx([1.0, 2.0, 0.0])


def test_contacts_above_the_centre_of_mass_are_off_it(ring, grasp_of):
    for axis in (Z, (0.0, 0.0, -7.0), None):
        assert q_diff_m(grasp_polygon(grasp_of(ring(3, height_m=0.02)), axis)) == pytest.approx(0.02)
    assert q_diff_m(grasp_polygon(grasp_of(ring(2, height_m=0.02)))) == pytest.approx(0.02)
    assert q_diff_m(grasp_polygon(grasp_of(ring(2)), X)) == pytest.approx(0.0, abs=1e-12)


def test_an_axis_is_fitted(ring, grasp_of, moved, random_rotation):
    rng = np.random.default_rng(7)
    contacts = moved(ring(5), random_rotation(rng), np.zeros(3))

    assert q_gpri(grasp_polygon(grasp_of(contacts))) == pytest.approx(0.0, abs=1e-9)


def test_the_points_of_a_finger_make_one_corner(ring, grasp_of):
    contacts = [
        replace(contact, finger=finger, normal_force_n=force)
        for height, force in ((0.0, 1.0), (0.04, 3.0))
        for finger, contact in enumerate(ring(3, height_m=height))
    ]
    polygon = grasp_polygon(grasp_of(contacts), Z)

    assert polygon.corners_m.shape == (3, 2)
    assert q_gpri(polygon) == pytest.approx(0.0, abs=1e-12)
    assert polygon.centroid_m == pytest.approx([0.0, 0.0, 0.03])
    unpressed = [replace(contact, normal_force_n=0.0) for contact in contacts]
    assert grasp_polygon(grasp_of(unpressed), Z).centroid_m == pytest.approx([0.0, 0.0, 0.02])


def test_the_length_of_an_axis_does_not_matter():
    points = [(0, 0), (2, 0), (1, 1), (0, 1)]
    one, other = (polygon_at(points, axis) for axis in ((0.48, 0.36, 0.8), (2.4, 1.8, 4.0)))

    assert other.corners_m == pytest.approx(one.corners_m)
    # What is seen of an area is its share across the axis.
    triangles = one.corners_m - one.corners_m[0]
    area = sum(a[0] * b[1] - a[1] * b[0] for a, b in itertools.pairwise(triangles)) / 2
    assert area == pytest.approx(0.8 * 1.5)


@pytest.mark.parametrize("axis", [(0.0, 0.0, 0.0), (math.nan, 0.0, 0.0), (math.inf, 0.0, 0.0)])
def test_an_axis_without_direction(ring, grasp_of, axis):
    with pytest.raises(DefinitionError) as caught:
        grasp_polygon(grasp_of(ring(3)), axis)

    assert (
        str(caught.value)
        == f"the axis of a grasp must be a finite, non-zero vector, got {axis} (give three finite numbers)"
    )
