"""Alternatives worth keeping, against a grid of weights."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness import KeptFor, worth_keeping
from rgss.tradeoff.weights import WeightSet

GRID = np.array([w for w in itertools.product(np.arange(41) / 40, repeat=3) if abs(sum(w) - 1.0) < 1e-12])


def found_in(values, *, among=None, margin=0.0, weights=(0.4, 0.3, 0.3), feasible=None):
    values = np.array(values, dtype=float)
    feasible = np.ones(len(values), dtype=bool) if feasible is None else np.array(feasible)
    return worth_keeping(
        values,
        feasible,
        np.array(weights[: values.shape[1]]),
        among=among or WeightSet.simplex(values.shape[1]),
        margin=margin,
    )


@pytest.mark.parametrize("bounded", [False, True])
@pytest.mark.parametrize("seed", range(4))
def test_against_a_grid_of_weights(seed, bounded):
    values = np.random.default_rng(seed).integers(0, 6, (14, 3)) / 5.0
    margin = 0.04
    among, grid = WeightSet.simplex(3), GRID
    if bounded:
        # The first weighs at least as much as the second, and the third at most 0.4.
        among = WeightSet.cut(np.array([[-1.0, 1.0, 0.0], [0.0, 0.0, 1.0]]), np.array([0.0, 0.4]))
        grid = GRID[(GRID[:, 0] >= GRID[:, 1]) & (GRID[:, 2] <= 0.4)]
    totals = values @ grid.T

    for one in found_in(values, among=among, margin=margin):
        behind = totals.max(axis=0) - totals[one.row]
        assert one.behind == pytest.approx((values - values[one.row] @ np.eye(3)).__matmul__([0.4, 0.3, 0.3]).max())
        if one.is_kept:
            lead = ((values - values[one.row]) @ one.weights).max()
            assert lead <= margin + 1e-7
            assert among.conditions()[0] @ one.weights == pytest.approx(
                np.minimum(among.conditions()[0] @ one.weights, among.conditions()[1]), abs=1e-7
            )
            assert behind.min() >= one.shortfall - 1e-9
        elif one.reason is KeptFor.DOMINATED:
            lead = totals[one.beaten_by[0]] - totals[one.row]
            assert lead.min() >= -1e-9
            assert lead.max() > margin
        else:
            some = totals[list(one.beaten_by)].max(axis=0) - totals[one.row]
            assert some.min() > margin
            assert some.min() >= one.shortfall - 1e-6
            singles = totals - totals[one.row]
            assert not ((singles.min(axis=1) >= 0) & (singles.max(axis=1) > margin)).any()


def test_a_point_between_two_is_beaten_by_either():
    kept = found_in([[1.0, 0.0], [0.0, 1.0], [0.4, 0.4]], weights=(0.5, 0.5))

    assert [one.reason for one in kept] == [KeptFor.BEST_AS_STATED, KeptFor.BEST_AS_STATED, KeptFor.MIXTURE]
    assert kept[2].beaten_by == (0, 1)
    assert kept[2].shortfall == pytest.approx(0.1)


def test_a_margin_keeps_it():
    kept = found_in([[1.0, 0.0], [0.0, 1.0], [0.4, 0.4]], weights=(0.5, 0.5), margin=0.1)

    assert kept[2].reason is KeptFor.WITHIN_MARGIN


def test_a_tie_at_the_corner_of_a_flat_measure_keeps_nothing():
    """At all weight on the first measure every alternative ties; the second is worse elsewhere."""
    kept = found_in([[0.5, 0.8], [0.5, 0.2]], weights=(0.5, 0.5), margin=0.01)

    assert [one.reason for one in kept] == [KeptFor.BEST_AS_STATED, KeptFor.DOMINATED]
    assert kept[1].beaten_by == (0,)


def test_one_that_is_never_worse_by_more_than_the_margin_is_kept():
    kept = found_in([[0.5, 0.80], [0.5, 0.79]], weights=(0.5, 0.5), margin=0.01)

    assert kept[1].reason is KeptFor.WITHIN_MARGIN


def test_best_elsewhere_names_the_nearest_weights():
    kept = found_in([[1.0, 0.0], [0.0, 1.0]], weights=(0.7, 0.3))

    assert kept[1].reason is KeptFor.BEST_FOR_SOME
    assert kept[1].weights == pytest.approx([0.5, 0.5])


def test_what_is_not_feasible_is_not_placed():
    kept = found_in([[1.0, np.nan], [0.2, 0.2], [0.1, 0.1]], weights=(0.5, 0.5), feasible=[False, True, True])

    assert [one.row for one in kept] == [1, 2]
    assert kept[1].beaten_by == (1,)
    assert found_in([[0.1, 0.2]], feasible=[False], weights=(0.5, 0.5)) == ()


def test_a_negative_margin():
    with pytest.raises(TradeoffError, match="the margin must be at least 0, got -1"):
        found_in([[0.1, 0.2]], margin=-1.0, weights=(0.5, 0.5))
