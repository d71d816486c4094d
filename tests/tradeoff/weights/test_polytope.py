"""Polytopes of weights, against geometry that is known in closed form."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.milp.linear import solve_linear
from rgss.tradeoff.weights.polytope import Polytope
from rgss.tradeoff.weights.weight_set import WeightSet


@pytest.mark.parametrize("size", [2, 3, 4, 5, 6])
def test_the_simplex(size):
    """Its volume is √m / (m - 1)!, its inradius 1 / √(m (m - 1)), its corners the axes."""
    whole = Polytope.of(WeightSet.simplex(size))
    centre, radius = whole.largest_ball()
    vertices = whole.vertices(centre)
    low, high = whole.extent()

    assert centre == pytest.approx(np.full(size, 1 / size))
    assert radius == pytest.approx(1 / math.sqrt(size * (size - 1)))
    assert sorted(map(tuple, vertices.round(12))) == sorted(map(tuple, np.eye(size)))
    assert whole.volume(vertices) == pytest.approx(math.sqrt(size) / math.factorial(size - 1))
    assert (low, high) == (pytest.approx(np.zeros(size), abs=1e-8), pytest.approx(np.ones(size), abs=1e-8))


def test_a_row_that_is_the_same_for_all_weights():
    """Equal coefficients say nothing about weights that sum to 1, or that there are none."""
    flat = np.ones((1, 3))
    idle = Polytope.of(WeightSet.simplex(3), flat, np.array([1.0]))
    impossible = Polytope.of(WeightSet.simplex(3), flat, np.array([0.5]))

    assert len(idle.rows) == 3
    assert impossible.largest_ball() is None
    assert impossible.nearest(np.full(3, 1 / 3)) is impossible.nearest_in_sum(np.full(3, 1 / 3)) is None


def test_nothing_is_left():
    empty = Polytope.of(WeightSet.simplex(2), np.eye(2), np.array([0.3, 0.3]))

    assert empty.largest_ball() is None
    assert empty.nearest(np.array([0.5, 0.5])) is None
    assert empty.nearest_in_sum(np.array([0.5, 0.5])) is None
    with pytest.raises(TradeoffError, match="a region of weights is empty where it was not"):
        empty.extent()


def test_weights_that_are_inside_stay():
    region = Polytope.of(WeightSet.simplex(3), np.eye(3)[:1], np.array([0.5]))
    weights = np.array([0.2, 0.3, 0.5])

    assert region.nearest(weights).tolist() == region.nearest_in_sum(weights).tolist() == weights.tolist()


def test_one_point_has_no_volume_to_lack():
    point = Polytope.of(WeightSet.simplex(1))

    assert point.largest_ball()[0].tolist() == [1.0]
    assert point.volume(point.vertices(np.ones(1))) == 1.0


def test_a_program_without_an_optimum():
    nothing = np.zeros((0, 1))
    with pytest.raises(TradeoffError, match=r"a linear program over weights ended without an optimum: .+ \(only a pro"):
        solve_linear(-np.ones(1), nothing, np.zeros(0), nothing, np.zeros(0), [(0.0, None)])
