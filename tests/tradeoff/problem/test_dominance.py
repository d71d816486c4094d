from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.dominance import nondominated


def by_pairs(values):
    """The definition, pair by pair."""
    at_least = (values[:, None, :] >= values[None, :, :]).all(axis=2)
    more = (values[:, None, :] > values[None, :, :]).any(axis=2)
    return ~(at_least & more).any(axis=0)


@pytest.mark.parametrize("seed", range(20))
def test_against_the_definition(seed):
    rng = np.random.default_rng(seed)
    for _ in range(50):
        shape = (int(rng.integers(1, 120)), int(rng.integers(1, 7)))
        coarse = int(rng.integers(0, 6))
        values = rng.integers(0, coarse + 1, shape).astype(float) if coarse else rng.random(shape)
        values *= 10.0 ** rng.integers(-300, 300)
        np.testing.assert_array_equal(nondominated(values), by_pairs(values))


def test_duplicates_are_all_kept_and_weakly_dominated_are_not():
    values = np.array([[1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, -1.0], [0.0, 1.0]])
    assert nondominated(values).tolist() == [True, True, True, False, True]


def test_one_column_and_no_rows():
    assert nondominated(np.array([[1.0], [3.0], [3.0]])).tolist() == [False, True, True]
    assert nondominated(np.empty((0, 3))).tolist() == []


@pytest.mark.parametrize("values", [np.zeros(3), np.zeros((3, 0)), np.zeros((1, 2, 3))])
def test_no_table(values):
    with pytest.raises(TradeoffError, match="dominance needs a table of alternatives by measures, not one of shape"):
        nondominated(values)


@pytest.mark.parametrize("wrong", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_not_finite(wrong):
    values = np.zeros((4, 3))
    values[2, 1] = wrong
    with pytest.raises(TradeoffError, match=r"dominance needs finite numbers: row 2, column 1 is -?(nan|inf)"):
        nondominated(values)


def test_a_hundred_thousand_that_are_all_undominated():
    """The worst case; pair by pair it would take hours."""
    values = np.random.default_rng(0).dirichlet(np.ones(5), 100_000)
    assert nondominated(values).all()
