"""The trade-off as arrays, against the decision that is made from its values."""

from __future__ import annotations

import math

import numpy as np
import pytest

from rgss.tradeoff import Alternative, ElicitedInterval, ElicitedOrder, WeightBounds, decide
from rgss.tradeoff.arrays import admitted_weights, resampled_arrays, trade_arrays
from rgss.tradeoff.problem.resampling import bootstrap


def test_arrays_come_to_the_same_choice(payload_and_time):
    arrays = trade_arrays(payload_and_time)
    assert arrays.variants.tolist() == [1, 2, 3, 4, 5]
    assert arrays.measures == ("P", "t")
    assert arrays.quantities[0].tolist() == [1.0, 40.0]
    assert arrays.values[3].tolist() == [0.8, 0.75]
    assert arrays.feasible.tolist() == [True, False, True, False, False]
    assert arrays.requirements == ("R-1", "R-2", "evidence:t")
    totals = np.where(arrays.feasible, arrays.values @ arrays.weights, -1.0)
    assert arrays.variants[totals.argmax()] == decide(payload_and_time).chosen


def test_draws(build_problem):
    alternatives = (
        Alternative(variant=1, measures={"a": 0.5}, samples={"a": (0.3, 0.7)}),
        Alternative(variant=2, measures={"a": None}, samples={"a": (None, None)}),
    )
    problem = build_problem({}, alternatives=alternatives, thresholds=[("R", "a", ">=", 0.4)])
    draws = bootstrap(2, draws=10, generator=np.random.default_rng(0))
    values, feasible = resampled_arrays(problem, draws)
    assert values.shape == (3, 2, 1)
    assert sorted(values[:, 0, 0].tolist()) == pytest.approx([0.3, 0.5, 0.7])
    assert math.isnan(values[0, 1, 0])
    assert (feasible[:, 0] == (values[:, 0, 0] >= 0.4)).all()
    assert not feasible[:, 1].any()


def test_admitted_weights(build_problem):
    names = {"a": (0.0, 1.0), "b": (0.0, 1.0), "c": (0.0, 1.0)}
    order = ElicitedOrder(heavier="b", heavier_measures=("b",), lighter="c", lighter_measures=("c",))
    bounds = WeightBounds(
        intervals=(
            ElicitedInterval(name="a", measures=("a",), least=0.2, most=0.2),
            ElicitedInterval(name="b", measures=("b",), least=0.3, most=0.7),
        ),
        orders=(order,),
    )
    problem = build_problem(
        {1: dict.fromkeys("abc", 0.5)}, values=names, weights={"a": 0.2, "b": 0.5, "c": 0.3}, weight_bounds=bounds
    )
    weights = admitted_weights(problem)
    assert (weights.size, weights.equality.tolist(), weights.equals.tolist()) == (3, [[1.0, 0.0, 0.0]], [0.2])
    for corner in problem.weight_corners():
        assert (weights.inequality @ corner <= weights.limits + 1e-9).all()
        assert weights.equality @ corner == pytest.approx(weights.equals)
