"""The admitted weights, and drawing from them."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.weights.hit_and_run import walked_weights
from rgss.tradeoff.weights.polytope import Polytope
from rgss.tradeoff.weights.sampling import Drawing, sample_weights
from rgss.tradeoff.weights.weight_set import WeightSet

ORDERED = WeightSet.cut(np.array([[-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]]), np.zeros(2))
"""w1 >= w2 >= w3."""


@pytest.mark.parametrize("size", [1, 2, 3, 5, 8])
def test_directions_are_orthonormal_and_keep_the_sum(size):
    directions = WeightSet.simplex(size).directions()

    assert directions.shape == (size, size - 1)
    assert directions.T @ directions == pytest.approx(np.eye(size - 1))
    assert directions.sum(axis=0) == pytest.approx(np.zeros(size - 1), abs=1e-12)


def test_a_fixed_weight_takes_no_room():
    fixed = WeightSet.cut(np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]]), np.array([0.4, -0.4]))

    assert fixed.directions().shape == (3, 1)
    assert fixed.directions()[0] == pytest.approx([0.0], abs=1e-12)
    drawn = sample_weights(fixed, 1000, np.random.default_rng(0)).weights
    assert drawn[:, 0] == pytest.approx(np.full(1000, 0.4))
    assert drawn[:, 1].min() == pytest.approx(0.0, abs=0.01)
    assert drawn[:, 1].max() == pytest.approx(0.6, abs=0.01)


def test_bounds_that_leave_one_point():
    """Both lower bounds sum to 1: no weight can move."""
    point = WeightSet.cut(-np.eye(2), np.array([-0.3, -0.7]))

    assert point.directions().shape == (2, 0)
    assert sample_weights(point, 3, np.random.default_rng(0)).weights == pytest.approx(np.array([[0.3, 0.7]] * 3))


def test_bounds_that_contradict_each_other():
    with pytest.raises(TradeoffError) as caught:
        WeightSet.cut(-np.eye(2), np.array([-0.6, -0.7]))
    assert str(caught.value) == (
        "no weights satisfy all the elicited bounds and orders (widen a bound, or drop an order)"
    )


def test_the_simplex_is_drawn_uniformly():
    """The moments of the flat Dirichlet distribution: mean 1/m, variance (m - 1) / (m² (m + 1))."""
    drawn = sample_weights(WeightSet.simplex(4), 200_000, np.random.default_rng(1)).weights

    assert drawn.sum(axis=1) == pytest.approx(np.ones(200_000))
    assert drawn.mean(axis=0) == pytest.approx(np.full(4, 0.25), abs=2e-3)
    assert drawn.var(axis=0) == pytest.approx(np.full(4, 3 / 80), abs=5e-4)


def test_ordered_weights_have_the_centroid_of_ranks():
    """The mean of w1 >= w2 >= w3 is (11, 5, 2) / 18 (Barron and Barrett 1996)."""
    drawn = sample_weights(ORDERED, 100_000, np.random.default_rng(2)).weights

    assert (drawn[:, 0] >= drawn[:, 1] - 1e-12).all()
    assert (drawn[:, 1] >= drawn[:, 2] - 1e-12).all()
    assert drawn.mean(axis=0) == pytest.approx(np.array([11, 5, 2]) / 18, abs=2e-3)


@pytest.mark.parametrize("size", [3, 7])
def test_drawing_from_a_cut_set_is_drawing_from_the_simplex_and_rejecting(size):
    """By triangulation for three weights, by rejection for seven."""
    rows = np.vstack([np.eye(size)[0], -np.eye(size)[1]])
    cut = WeightSet.cut(rows, np.array([0.3, -0.05]))
    whole = sample_weights(WeightSet.simplex(size), 400_000, np.random.default_rng(3)).weights
    kept = whole[(whole[:, 0] <= 0.3) & (whole[:, 1] >= 0.05)]
    drawn = sample_weights(cut, 100_000, np.random.default_rng(4)).weights

    assert drawn[:, 0].max() <= 0.3 + 1e-12
    assert drawn[:, 1].min() >= 0.05 - 1e-12
    assert drawn.mean(axis=0) == pytest.approx(kept.mean(axis=0), abs=3e-3)
    assert drawn.std(axis=0) == pytest.approx(kept.std(axis=0), abs=3e-3)


def test_the_same_seed_draws_the_same_weights():
    first, second = (sample_weights(ORDERED, 100, np.random.default_rng(5)).weights for _ in range(2))

    assert (first == second).all()


def test_a_set_too_thin_for_rejection_is_walked():
    """What is left above the lower bounds is a small simplex, whose moments are known (Dirichlet)."""
    thin = WeightSet.cut(-np.eye(8), np.full(8, -0.1249))
    drawn = sample_weights(thin, 20_000, np.random.default_rng(0))
    shares = (drawn.weights - 0.1249) / (1.0 - 8 * 0.1249)

    assert drawn.drawn_by is Drawing.HIT_AND_RUN
    assert shares.sum(axis=1) == pytest.approx(np.ones(20_000), abs=1e-6)
    assert shares.min() > -1e-6
    assert shares.mean(axis=0) == pytest.approx(np.full(8, 1 / 8), abs=0.004)
    assert np.cov(shares.T) == pytest.approx(np.cov(_dirichlet(8).T), abs=8e-4)
    for at in (0.05, 0.25, 0.5):
        assert (shares > at).mean(axis=0) == pytest.approx(np.full(8, (1 - at) ** 7), abs=0.015)


def test_many_weights_of_which_one_is_fixed_are_walked():
    rows = np.vstack([np.eye(8)[0], -np.eye(8)[0]])
    drawn = sample_weights(WeightSet.cut(rows, np.array([0.4, -0.4])), 20_000, np.random.default_rng(0))

    assert drawn.drawn_by is Drawing.HIT_AND_RUN
    assert drawn.weights[:, 0] == pytest.approx(np.full(20_000, 0.4))
    assert np.cov(drawn.weights[:, 1:].T / 0.6) == pytest.approx(np.cov(_dirichlet(7).T), abs=1e-3)


@pytest.mark.parametrize("size", [9, 20])
def test_a_walk_agrees_with_rejection(size):
    """The order of two weights keeps half of the simplex: both ways of drawing give the same distribution."""
    order = WeightSet.cut(np.eye(size)[1:2] - np.eye(size)[0:1], np.zeros(1))
    exact = sample_weights(order, 20_000, np.random.default_rng(0))
    polytope = Polytope.of(order)
    centre, _ = polytope.largest_ball()
    walked = walked_weights(polytope, centre, 20_000, np.random.default_rng(1))

    assert exact.drawn_by is Drawing.INDEPENDENT
    assert (walked[:, 1] <= walked[:, 0] + 1e-9).all()
    assert walked.mean(axis=0) == pytest.approx(exact.weights.mean(axis=0), abs=0.005)
    quantiles = [np.quantile(one, [0.1, 0.5, 0.9, 0.99], axis=0) for one in (walked, exact.weights)]
    assert quantiles[0] == pytest.approx(quantiles[1], abs=0.015)


def _dirichlet(size):
    return np.random.default_rng(9).dirichlet(np.ones(size), 100_000)
