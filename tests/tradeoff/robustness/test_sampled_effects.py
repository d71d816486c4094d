"""Shares of factors from samples of designs, against theory."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import qmc

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.effects import factorial_effects
from rgss.tradeoff.robustness.sampled_effects import classes_of, first_order_indices


def indices_of(classes, values, seed=0, resamples=200):
    return first_order_indices(classes, values, resamples=resamples, generator=np.random.default_rng(seed))


def test_the_ishigami_function():
    """First-order indices 0.3139, 0.4424 and 0 (Ishigami and Homma 1990), from 4,096 points in 32 classes."""
    points = 2 * np.pi * qmc.LatinHypercube(3, rng=1).random(4096) - np.pi
    values = np.sin(points[:, 0]) + 7 * np.sin(points[:, 1]) ** 2 + 0.1 * points[:, 2] ** 4 * np.sin(points[:, 0])
    found = indices_of(np.stack([classes_of(column) for column in points.T], axis=1), values)

    assert [one.share for one in found] == pytest.approx([0.3139, 0.4424, 0.0], abs=0.03)
    for one in found:
        assert one.low <= one.share <= one.high


def test_a_sample_of_a_table_estimates_the_whole_table():
    table = np.random.default_rng(2).normal(size=(2, 3, 4)) + np.array([0.0, 1.0])[:, None, None]
    rows = np.random.default_rng(3).integers(0, table.shape, size=(3000, 3))
    found = indices_of(rows, table[tuple(rows.T)])
    whole = factorial_effects(table, list("abc"))

    assert [one.share for one in found] == pytest.approx(list(whole.first_order.values()), abs=0.04)


def test_what_is_there_by_chance_is_taken_out():
    """Without any effect the mean of the estimate is 0, though that of the plain ratio is (k - 1) / (n - 1)."""
    generator = np.random.default_rng(4)
    shares = [
        indices_of(generator.integers(0, 5, size=(40, 1)), generator.normal(size=40), seed, resamples=1)[0].share
        for seed in range(80)
    ]

    assert np.mean(shares) == pytest.approx(0.0, abs=0.03)


def test_classes_are_of_one_size_and_keep_equals_together():
    assert np.bincount(classes_of(np.linspace(0, 1, 80))).tolist() == [10] * 8
    assert np.bincount(classes_of(np.linspace(0, 1, 9))).tolist() in ([5, 4], [4, 5])
    assert classes_of(np.repeat([3.0, 1.0, 2.0], 20)).reshape(3, 20).tolist() == [[2] * 20, [0] * 20, [1] * 20]


def test_a_measure_that_is_level():
    assert [one.share for one in indices_of(np.arange(20)[:, None] % 2, np.full(20, 0.1 + 0.2))] == [0.0]


@pytest.mark.parametrize("values", [np.ones(7), np.full(20, np.nan)])
def test_too_few_designs_or_values(values):
    with pytest.raises(TradeoffError, match=r"do not do for shares of the variance \(leave out designs without a val"):
        indices_of(np.zeros((len(values), 1), dtype=np.int64), values)


def test_a_factor_without_effect_is_seldom_told_from_chance():
    """Two factors and their product make the values, three do nothing; before, two of five of these had a share."""
    named, excluded = [], []
    for seed in range(30):
        points = qmc.LatinHypercube(5, rng=seed).random(32)
        values = (2.0 + (points[:, 0] > 0.5)) * (5.0 + 8.0 * points[:, 1])
        classes = np.stack([points[:, 0] > 0.5, *map(classes_of, points[:, 1:].T)], axis=1).astype(np.int64)
        found = indices_of(classes, values, seed, resamples=100)
        assert found[1].share > found[1].by_chance
        named += [one.share > one.by_chance for one in found[2:]]
        excluded += [one.low > 0.0 for one in found[2:]]

    assert np.mean(named) < 0.12
    assert np.mean(excluded) < 0.06
