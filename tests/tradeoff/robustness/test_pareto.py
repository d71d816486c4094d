"""Pareto fronts and support, against a published front and brute force."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.pareto import Support, pareto_front

FIRST_COST = np.array([[5, 1, 4, 7], [6, 2, 2, 6], [2, 8, 4, 4], [3, 5, 7, 1]])
SECOND_COST = np.array([[3, 6, 4, 2], [1, 3, 8, 3], [5, 2, 2, 3], [4, 2, 3, 5]])


def front_of(values, feasible=None):
    values = np.asarray(values, dtype=float)
    return pareto_front(values, np.ones(len(values), dtype=bool) if feasible is None else np.asarray(feasible))


def test_the_published_front_of_an_assignment_problem():
    """The bi-objective assignment problem that Przybylski, Gandibleux and Ehrgott work through.

    "Two phase algorithms for the bi-objective assignment problem", European Journal of Operational
    Research 185, 2008: of its 24 assignments six are on the front, four of them supported.
    """
    plans = list(itertools.permutations(range(4)))
    costs = np.array([[cost[range(4), plan].sum() for cost in (FIRST_COST, SECOND_COST)] for plan in plans])
    front = front_of(1.0 - costs / costs.max())
    points = {tuple(int(cost) for cost in costs[row]) for row in front.rows}
    unsupported = {tuple(costs[point.row]) for point in front.points if point.support is Support.UNSUPPORTED}

    assert points == {(6, 24), (9, 17), (12, 13), (16, 11), (19, 10), (22, 7)}
    assert points - unsupported == {(6, 24), (9, 17), (12, 13), (22, 7)}
    assert unsupported < points


def test_every_kind_of_support():
    front = front_of(
        [
            [1.0, 0.0, 0.2],  # a corner
            [0.0, 1.0, 0.2],  # a corner
            [0.5, 0.5, 0.2],  # on the edge between them: best for w1 = w2, never alone
            [0.4, 0.5, 0.2],  # behind it
            [0.1, 0.1, 0.9],  # a corner
            [0.3, 0.3, 0.3],  # on the front, behind the face of the corners
        ]
    )

    assert [point.support.value for point in front.points] == [
        "extreme",
        "extreme",
        "supported",
        "dominated",
        "extreme",
        "unsupported",
    ]
    assert front.points[3].dominated_by == 2
    assert front.rows == (0, 1, 2, 4, 5)
    assert front.points[5].shortfall > 0.0
    assert [front.points[row].shortfall for row in (0, 2, 3)] == [0.0, 0.0, None]


def test_weak_support_needs_a_weight_of_zero():
    """The third ties the first two at w = (½, ½, 0); any w3 > 0 favours one of them."""
    front = front_of([[1.0, 0.0, 0.6], [0.0, 1.0, 0.6], [0.5, 0.5, 0.5], [0.4, 0.4, 0.55]])

    assert front.points[2].support is Support.WEAKLY_SUPPORTED
    assert front.points[2].shortfall == 0.0
    assert front.points[3].support is Support.UNSUPPORTED


def test_the_shortfall_is_the_least_loss_over_all_weights():
    """(0.4, 0.4) between (1, 0) and (0, 1) is worth 0.4 where the others are worth at least 0.5."""
    front = front_of([[1.0, 0.0], [0.0, 1.0], [0.4, 0.4]])

    assert front.points[2].support is Support.UNSUPPORTED
    assert front.points[2].shortfall == pytest.approx(0.1)


def test_alternatives_that_are_alike_have_one_place():
    front = front_of([[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]])

    assert [point.support for point in front.points] == [Support.EXTREME] * 3


def test_what_is_not_feasible_is_not_there():
    front = front_of([[1.0, 1.0], [0.3, 0.2], [np.nan, 1.0]], feasible=[False, True, False])

    assert [(point.row, point.support) for point in front.points] == [(1, Support.EXTREME)]
    assert front_of([[1.0]], feasible=[False]).points == ()


def test_one_measure():
    assert [point.support for point in front_of([[0.2], [0.7]]).points] == [Support.DOMINATED, Support.EXTREME]


@pytest.mark.parametrize("seed", range(12))
def test_against_brute_force(seed):
    """On a coarse lattice of values, with ties and duplicates: dominance pair by pair, support by a grid of weights."""
    generator = np.random.default_rng(seed)
    size = 2 + seed % 3
    values = generator.integers(0, 5, size=(25, size)) / 4
    front = front_of(values)
    parts = 24
    grid = np.array([c for c in itertools.product(range(parts + 1), repeat=size) if sum(c) == parts]) / parts
    totals = grid @ values.T
    best = totals >= totals.max(axis=1, keepdims=True) - 1e-12
    for point in front.points:
        mine = values[point.row]
        dominators = np.flatnonzero((values >= mine).all(axis=1) & (values > mine).any(axis=1))
        assert (point.support is Support.DOMINATED) == bool(len(dominators))
        if len(dominators):
            assert point.dominated_by in dominators
        elif point.support is Support.UNSUPPORTED:
            assert not best[:, point.row].any()
            assert (totals.max(axis=1) - totals[:, point.row]).min() >= point.shortfall - 1e-9
        # What a grid of weights finds to be best is supported, for positive weights properly so.
        if best[:, point.row].any() and not len(dominators):
            assert point.support is not Support.UNSUPPORTED
        if best[(grid > 0).all(axis=1), point.row].any() and not len(dominators):
            assert point.support in (Support.EXTREME, Support.SUPPORTED)


def test_a_value_that_is_none():
    with pytest.raises(
        TradeoffError, match=r"the values have nan in row 0, column 0 \(a value is a number from 0 to 1"
    ):
        front_of([[np.nan, 0.1]])
