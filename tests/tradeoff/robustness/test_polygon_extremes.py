"""Polygons and extremes on them, against linear programs and sampling."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import ConvexHull

from rgss.tradeoff.robustness.polygon_extremes import clip, lowest_separable, zonotope


@pytest.mark.parametrize("seed", range(6))
def test_a_zonotope_is_the_hull_of_its_corners(seed):
    generator = np.random.default_rng(seed)
    generators = generator.normal(size=(5, 2))
    corners = np.array(np.meshgrid(*[[-1, 1]] * 5)).reshape(5, -1).T @ generators + [3.0, 4.0]
    hull = corners[ConvexHull(corners).vertices]
    found = zonotope(np.array([3.0, 4.0]), generators)

    assert sorted(map(tuple, np.round(found, 9))) == sorted(map(tuple, np.round(hull, 9)))


def test_zonotopes_without_area():
    assert zonotope(np.array([1.0, 2.0]), np.zeros((3, 2))).tolist() == [[1.0, 2.0]]
    segment = zonotope(np.zeros(2), np.array([[1.0, 1.0], [-2.0, -2.0]]))
    assert sorted(map(tuple, np.unique(segment, axis=0)))[0] == (-3.0, -3.0)
    assert segment.max(axis=0).tolist() == [3.0, 3.0]


def test_clipping():
    square = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]])

    assert sorted(map(tuple, clip(square, 1, 0.5, keep_below=True))) == [(0.0, 0.0), (0.0, 0.5), (2.0, 0.0), (2.0, 0.5)]
    assert sorted(map(tuple, clip(square, 0, 1.5, keep_below=False))) == [
        (1.5, 0.0),
        (1.5, 2.0),
        (2.0, 0.0),
        (2.0, 2.0),
    ]
    assert clip(square, 1, -1.0, keep_below=True).shape == (0, 2)
    assert len(clip(square, 1, 2.0, keep_below=True)) == 4
    assert clip(np.array([[0.0, 0.0], [2.0, 2.0]]), 0, 1.0, keep_below=True).tolist() == [
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 1.0],
    ]


@pytest.mark.parametrize("seed", range(6))
def test_the_least_of_a_sum_against_sampling(seed):
    generator = np.random.default_rng(seed)
    polygon = zonotope(np.zeros(2), generator.normal(size=(4, 2)))
    knots = np.sort(generator.uniform(-3, 3, 3))
    heights = generator.normal(size=(2, 3))
    least, where = lowest_separable(
        polygon, knots, knots, lambda x: np.interp(x, knots, heights[0]), lambda y: np.interp(y, knots, heights[1])
    )
    shares = generator.dirichlet(np.full(len(polygon), 0.3), 40_000)
    points = shares @ polygon
    sampled = np.interp(points[:, 0], knots, heights[0]) + np.interp(points[:, 1], knots, heights[1])

    assert np.interp(where[0], knots, heights[0]) + np.interp(where[1], knots, heights[1]) == pytest.approx(least)
    assert sampled.min() >= least - 1e-9
    assert sampled.min() <= least + 0.15
