"""What a requirement costs, against deciding anew at every threshold."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.prices import changes_of_best, price_list, step_at

PAYLOADS = np.array([0.8, 1.2, 1.0, 1.2, np.nan, 2.0])
TOTALS = np.array([0.9, 0.5, 0.7, 0.5, 0.99, 1.0])
OTHERWISE = np.array([True, True, True, True, True, False])


def test_by_hand():
    steps = price_list(PAYLOADS, TOTALS, OTHERWISE, at_least=True)

    assert [(step.loosest, step.tightest, step.best, step.value, step.feasible, step.leaving) for step in steps] == [
        (-math.inf, 0.8, (0,), 0.9, 4, (0,)),
        (0.8, 1.0, (2,), 0.7, 3, (2,)),
        (1.0, 1.2, (1, 3), 0.5, 2, (1, 3)),
        (1.2, math.inf, (), None, 0, ()),
    ]


def test_an_upper_bound_tightens_downwards():
    costs = np.array([10.0, 20.0, 30.0])
    steps = price_list(costs, np.array([0.1, 0.5, 0.4]), np.ones(3, dtype=bool), at_least=False)

    assert [(step.loosest, step.tightest, step.best) for step in steps] == [
        (math.inf, 30.0, (1,)),
        (30.0, 20.0, (1,)),
        (20.0, 10.0, (0,)),
        (10.0, -math.inf, ()),
    ]
    joined = changes_of_best(steps)
    assert [(step.loosest, step.tightest, step.best, step.feasible, step.leaving) for step in joined] == [
        (math.inf, 20.0, (1,), 3, (1, 2)),
        (20.0, 10.0, (0,), 1, (0,)),
        (10.0, -math.inf, (), 0, ()),
    ]


@pytest.mark.parametrize("at_least", [True, False])
@pytest.mark.parametrize("seed", range(5))
def test_against_deciding_anew(seed, at_least):
    generator = np.random.default_rng(seed)
    quantities = generator.integers(0, 12, 30) / 4
    totals = generator.integers(0, 6, 30) / 5
    otherwise = generator.random(30) > 0.3
    steps = price_list(quantities, totals, otherwise, at_least=at_least)
    joined = changes_of_best(steps)
    values = [step.value for step in steps[:-1]]

    assert values == sorted(values, reverse=True)
    for threshold in np.arange(-0.1, 3.2, 0.05):
        feasible = otherwise & (quantities >= threshold if at_least else quantities <= threshold)
        best = feasible & (totals == totals[feasible].max(initial=-1))
        for some in (steps, joined):
            step = step_at(some, threshold, at_least=at_least)
            assert step.best == tuple(np.flatnonzero(best))
        assert step_at(steps, threshold, at_least=at_least).feasible == feasible.sum()


def test_nothing_is_feasible_otherwise():
    (only,) = price_list(PAYLOADS, TOTALS, np.zeros(6, dtype=bool), at_least=True)

    assert (only.loosest, only.tightest, only.best, only.value) == (-math.inf, math.inf, (), None)


def test_an_unknown_value_of_what_a_threshold_could_admit():
    with pytest.raises(TradeoffError, match="needs the value of every alternative that a threshold could admit"):
        price_list(np.array([1.0]), np.array([np.nan]), np.array([True]), at_least=True)
