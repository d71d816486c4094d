"""Rank reversal, against a published example."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff.robustness import rank_reversal
from rgss.tradeoff.robustness.rank_reversal import RankReversal, rank_reversals, sample_anchored

A, B, C, D = range(4)
PRIORITIES = np.array([[1.0, 9.0, 8.0], [9.0, 1.0, 9.0], [1.0, 1.0, 1.0], [9.0, 1.0, 9.0]])


def normalised(rows):
    """Priorities that sum to 1 in each of three equal criteria, as the analytic hierarchy process has them."""
    here = PRIORITIES[rows]
    return (here / here.sum(axis=0)).mean(axis=1)


def test_the_published_reversal():
    """Belton and Gear ("On a short-coming of Saaty's method", Omega 11, 1983): D is a copy of B.

    Without it B leads with 0.47 to 0.45; with it A leads with 0.37 to 0.29.
    """
    assert normalised(np.array([A, B, C])) == pytest.approx([0.45, 0.47, 0.08], abs=0.005)
    assert normalised(np.array([A, B, C, D])) == pytest.approx([0.37, 0.29, 0.06, 0.29], abs=0.005)

    found = {each.removed: each for each in rank_reversals(4, normalised)}

    assert found[D] == RankReversal(removed=D, best_before=A, best_after=B, swapped=1)
    assert found[B] == RankReversal(removed=B, best_before=A, best_after=D, swapped=1)
    assert set(found) == {B, D}


def test_values_of_the_alternative_alone_never_reverse():
    scores = np.random.default_rng(0).random(30)

    assert rank_reversals(30, lambda rows: scores[rows]) == ()


def test_values_stretched_over_the_sample_reverse():
    """The third makes the first measure's range wide; without it the second's cheapness counts less.

    With all three the first has 0.5 (3/10) + 0.5 = 0.65, the second 0.5 (5/10) + 0.5 (0) ... by hand
    below, in both samples.
    """
    quantities = np.array([[5.0, 1.0], [8.0, 0.4], [0.0, 0.0], [10.0, 0.0]])
    score = sample_anchored(quantities, np.array([True, True]), np.array([0.5, 0.5]))

    assert score(np.arange(4)) == pytest.approx([0.25 + 0.5, 0.4 + 0.2, 0.0, 0.5])
    assert score(np.array([0, 1])) == pytest.approx([0.5, 0.5])
    found = {each.removed: each for each in rank_reversals(4, score)}
    # Without the worst, 5 is worth nothing in the first measure: 0.5 against 0.5 (3/5) + 0.2 = 0.5.
    assert found[2].best_before == 0
    assert found[2].swapped >= 1


def test_less_may_be_better_and_a_level_measure_counts_nothing():
    quantities = np.array([[3.0, 7.0], [1.0, 7.0]])
    score = sample_anchored(quantities, np.array([False, True]), np.array([0.6, 0.4]))

    assert score(np.array([0, 1])) == pytest.approx([0.0, 0.6])


def test_one_alternative_has_nobody_to_swap_with():
    assert rank_reversals(1, lambda rows: np.ones(len(rows))) == ()


def test_of_many_alternatives_the_same_pairs_swap_as_pair_by_pair(monkeypatch):
    generator = np.random.default_rng(4)
    quantities = np.round(generator.random((60, 3)), 2)
    score = sample_anchored(quantities, np.array([True, False, True]), np.array([0.5, 0.3, 0.2]))
    pair_by_pair = rank_reversals(60, score)
    monkeypatch.setattr(rank_reversal, "_PAIRS_UP_TO", 0)
    monkeypatch.setattr(rank_reversal, "_PAIRS_AT_ONCE", 500)

    assert pair_by_pair
    assert rank_reversals(60, score) == pair_by_pair


@pytest.mark.parametrize("seed", range(40))
def test_an_order_is_the_same_if_every_pair_is(seed):
    generator = np.random.default_rng(seed)
    old = np.round(generator.random(12), 1)
    new = old + generator.choice([0.0, 4e-10, -4e-10, 0.05], size=12, p=[0.6, 0.15, 0.15, 0.1])
    every = [np.sign(np.where(np.abs(gap) <= 1e-9, 0.0, gap)) for gap in (old[:, None] - old, new[:, None] - new)]

    assert rank_reversal._same_order(old, new) == np.array_equal(*every)
