"""Elicited bounds on weights, and the corners of what they leave."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from scipy.optimize import linprog

from rgss.errors import TradeoffError
from rgss.tradeoff import ElicitedInterval, ElicitedOrder, RankRule, WeightBounds, weights_from_ranks
from rgss.tradeoff.programs.weight_vertices import weight_vertices

MEASURES = ("a", "b", "c")


def interval(name, least, most, **more):
    return ElicitedInterval(name=name, measures=more.pop("measures", (name,)), least=least, most=most, **more)


def order(heavier, lighter, times=1.0):
    return ElicitedOrder(
        heavier=heavier, heavier_measures=tuple(heavier), lighter=lighter, lighter_measures=tuple(lighter), times=times
    )


def corners(bounds, measures=MEASURES):
    return weight_vertices(*bounds.system(measures))


def test_without_bounds_the_corners_are_the_measures_themselves():
    assert corners(WeightBounds()).tolist() == [[0, 0, 1], [0, 1, 0], [1, 0, 0]]


def test_the_centre_of_an_order_is_the_rank_order_centroid():
    """Barron and Barrett's reason for these weights."""
    found = corners(WeightBounds(orders=(order("a", "b"), order("b", "c"))))
    weights = weights_from_ranks({"a": 1, "b": 2, "c": 3}, RankRule.RANK_ORDER_CENTROID)
    assert found.mean(axis=0) == pytest.approx(list(weights.values()))


@pytest.mark.parametrize(
    ("bounds", "expected"),
    [
        (
            WeightBounds(intervals=(interval("a", 0.2, 0.5),)),
            {(0.2, 0.8, 0), (0.2, 0, 0.8), (0.5, 0.5, 0), (0.5, 0, 0.5)},
        ),
        (WeightBounds(intervals=(interval("a", 0.4, 0.4),)), {(0.4, 0.6, 0), (0.4, 0, 0.6)}),
        (WeightBounds(orders=(order("a", "b", 3.0),)), {(1, 0, 0), (0.75, 0.25, 0), (0, 0, 1)}),
        # Of the group {a, b}, a is a third.
        (
            WeightBounds(intervals=(interval("a", 1 / 3, 1 / 3, within=("a", "b")),)),
            {(1 / 3, 2 / 3, 0), (0, 0, 1)},
        ),
        (WeightBounds(intervals=(interval("g", 0.7, 1.0, measures=("a", "b")), interval("c", 0.5, 0.6))), set()),
    ],
)
def test_corners(bounds, expected):
    found = {tuple(round(float(weight), 9) for weight in corner) for corner in corners(bounds)}
    assert found == {tuple(round(weight, 9) for weight in corner) for corner in expected}


@pytest.mark.parametrize("seed", range(30))
def test_no_linear_program_finds_a_better_weight_than_the_corners(seed):
    rng = np.random.default_rng(seed)
    count = int(rng.integers(2, 6))
    names = "abcde"[:count]
    weights = rng.dirichlet(np.ones(count))
    spread = rng.random(count) * 0.4
    bounds = WeightBounds(
        intervals=tuple(
            interval(name, max(0.0, weight - width), min(1.0, weight + width))
            for name, weight, width in zip(names, weights, spread, strict=True)
        ),
        orders=tuple(
            order(one, other)
            for one, other in itertools.combinations(sorted(names, key=lambda n: -weights[names.index(n)]), 2)
            if rng.random() < 0.3
        ),
    )
    matrix, limits = bounds.system(names)
    found = corners(bounds, names)
    assert (found @ matrix.T <= limits + 1e-9).all()
    assert found.sum(axis=1) == pytest.approx(np.ones(len(found)))
    for _ in range(20):
        cost = rng.normal(size=count)
        best = linprog(cost, A_ub=matrix, b_ub=limits, A_eq=np.ones((1, count)), b_eq=[1.0], bounds=(0, 1))
        assert (found @ cost).min() == pytest.approx(best.fun, abs=1e-8)


def test_too_many_bounds_are_refused():
    with pytest.raises(TradeoffError, match=r"20 weights with 20 bounds may have \d+ corners") as error:
        weight_vertices(np.eye(20), np.full(20, 0.5))
    assert "fewer measures" in error.value.hint


@pytest.mark.parametrize(
    ("bounds", "message"),
    [
        (
            WeightBounds(intervals=(interval("a", 0.3, 0.5),)),
            "the weight of 'a' is 0.2, outside of its bounds 0.3 to 0.5",
        ),
        (
            WeightBounds(intervals=(interval("b", 0.0, 0.3, within=("b", "c")),)),
            "the weight of 'b' is 0.375, outside of its bounds 0 to 0.3",
        ),
        (WeightBounds(orders=(order("a", "b"),)), "the weight of 'a' is 0.2, below that of 'b', 0.3"),
        (WeightBounds(orders=(order("c", "b", 2.0),)), "the weight of 'c' is 0.5, below 2 times that of 'b', 0.3"),
    ],
)
def test_weights_that_contradict_their_bounds(bounds, message):
    with pytest.raises(TradeoffError) as error:
        bounds.check({"a": 0.2, "b": 0.3, "c": 0.5})
    assert error.value.message == message
    assert error.value.hint


def test_weights_that_agree():
    WeightBounds(
        intervals=(interval("a", 0.2, 0.2), interval("b", 0.375, 0.4, within=("b", "c"))),
        orders=(order("c", "a", 2.5), order("b", "a")),
    ).check({"a": 0.2, "b": 0.3, "c": 0.5})


@pytest.mark.parametrize(("least", "most"), [(0.5, 0.4), (-0.1, 0.5), (0.5, 1.1), (math.nan, 0.5)])
def test_an_interval_that_is_none(least, most):
    with pytest.raises(TradeoffError, match="the weight of 'a' cannot lie between"):
        interval("a", least, most)


@pytest.mark.parametrize("times", [0.0, -1.0, math.inf, math.nan])
def test_an_order_that_is_none(times):
    with pytest.raises(TradeoffError, match=r"'a' cannot weigh .* times 'b'"):
        order("a", "b", times)
