"""Weights from ranks and points, against published tables and against what they stand for."""

from __future__ import annotations

import math

import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import RankRule, Weighting, weights_from_points, weights_from_ranks

# Barron and Barrett (1996), table 1, and Stillwell, Seaver and Edwards (1981), for four and five attributes.
PUBLISHED = [
    (RankRule.RANK_ORDER_CENTROID, [0.5208, 0.2708, 0.1458, 0.0625]),
    (RankRule.RANK_ORDER_CENTROID, [0.4567, 0.2567, 0.1567, 0.0900, 0.0400]),
    (RankRule.RANK_SUM, [0.4, 0.3, 0.2, 0.1]),
    (RankRule.RANK_SUM, [0.3333, 0.2667, 0.2000, 0.1333, 0.0667]),
    (RankRule.RANK_RECIPROCAL, [0.48, 0.24, 0.16, 0.12]),
    (RankRule.RANK_RECIPROCAL, [0.4380, 0.2190, 0.1460, 0.1095, 0.0876]),
]


@pytest.mark.parametrize(("rule", "weights"), PUBLISHED)
def test_published_weights(rule, weights):
    ranks = {f"m{place}": place for place in range(1, len(weights) + 1)}
    assert list(weights_from_ranks(ranks, rule).values()) == pytest.approx(weights, abs=5e-5)


@pytest.mark.parametrize("rule", list(RankRule))
@pytest.mark.parametrize("count", [1, 2, 7, 40])
def test_they_sum_to_one_and_fall(rule, count):
    weights = list(weights_from_ranks({f"m{place}": place for place in range(1, count + 1)}, rule).values())
    assert math.fsum(weights) == pytest.approx(1.0, abs=1e-12)
    assert weights == sorted(weights, reverse=True)
    Weighting(weights={str(place): weight for place, weight in enumerate(weights)})


def test_equal_ranks_share_their_places():
    weights = weights_from_ranks({"a": 2, "b": 1, "c": 2, "d": 4}, RankRule.RANK_SUM)
    assert weights == pytest.approx({"a": 0.25, "b": 0.4, "c": 0.25, "d": 0.1})


@pytest.mark.parametrize(
    ("ranks", "message"),
    [
        ({}, "there are no ranks"),
        ({"a": 1, "b": 3}, "rank of 'b' must be 2, got 3"),
        ({"a": 0, "b": 1}, "rank of 'a' must be 1, got 0"),
        ({"a": 1, "b": 1, "c": 2}, "rank of 'c' must be 3, got 2"),
    ],
)
def test_ranks_that_are_none(ranks, message):
    with pytest.raises(TradeoffError) as error:
        weights_from_ranks(ranks, RankRule.RANK_SUM)
    assert error.value.message == message
    assert error.value.hint


def test_points_are_shares():
    assert weights_from_points({"a": 100.0, "b": 60.0, "c": 40.0, "d": 0.0}) == pytest.approx(
        {"a": 0.5, "b": 0.3, "c": 0.2, "d": 0.0}
    )


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ({}, "points must sum to more than 0, got 0"),
        ({"a": 0.0}, "points must sum to more than 0, got 0"),
        ({"a": -5.0, "b": 10.0}, "points of 'a' must be at least 0, got -5"),
        ({"a": math.nan}, "points of 'a' must be at least 0, got nan"),
        ({"a": 1e308, "b": 1e308}, "points must sum to more than 0, got inf"),
    ],
)
def test_points_that_are_none(points, message):
    with pytest.raises(TradeoffError) as error:
        weights_from_points(points)
    assert error.value.message == message
    assert error.value.hint
