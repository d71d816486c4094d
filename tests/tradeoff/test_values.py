from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import ValueFunction, Weighting


@pytest.mark.parametrize(
    ("worst", "best", "quantity", "value"),
    [
        (0.0, 2.0, 0.5, 0.25),
        (0.0, 2.0, -1.0, 0.0),
        (0.0, 2.0, 0.0, 0.0),
        (0.0, 2.0, 2.0, 1.0),
        (0.0, 2.0, 9.0, 1.0),
        (60.0, 20.0, 30.0, 0.75),
        (60.0, 20.0, 61.0, 0.0),
        (60.0, 20.0, 60.0, 0.0),
        (60.0, 20.0, 20.0, 1.0),
        (60.0, 20.0, 19.0, 1.0),
        (-1.0, -3.0, -2.5, 0.75),
    ],
)
def test_linear_value(worst, best, quantity, value):
    assert ValueFunction(measure="m", worst=worst, best=best).value_at(quantity) == pytest.approx(value, abs=1e-15)


@pytest.mark.parametrize(
    ("quantity", "value"), [(0.0, 0.0), (1.0, 0.4), (2.0, 0.8), (3.0, 0.8), (5.0, 0.8), (7.5, 0.9), (10.0, 1.0)]
)
def test_piecewise_value(quantity, value):
    function = ValueFunction(measure="m", worst=0.0, best=10.0, interior=((2.0, 0.8), (5.0, 0.8)))
    assert function.value_at(quantity) == pytest.approx(value, abs=1e-15)


def test_piecewise_value_where_less_is_better():
    function = ValueFunction(measure="m", worst=10.0, best=0.0, interior=((4.0, 0.2),))
    assert [function.value_at(x) for x in (11.0, 7.0, 4.0, 2.0, -1.0)] == pytest.approx([0.0, 0.1, 0.2, 0.6, 1.0])


def test_values_agree_with_interpolation_never_fall_and_stay_in_range(seeded):
    rng = seeded(7)
    for _ in range(200):
        count = rng.randrange(4)
        quantities = sorted(rng.uniform(-5, 5) for _ in range(count + 2))
        values = sorted(rng.random() for _ in range(count))
        if rng.random() < 0.5:
            quantities.reverse()
        function = ValueFunction(
            measure="m",
            worst=quantities[0],
            best=quantities[-1],
            interior=tuple(zip(quantities[1:-1], values, strict=True)),
        )
        towards_best = np.linspace(quantities[0] * 2 - quantities[-1], quantities[-1] * 2 - quantities[0], 50)
        ours = [function.value_at(float(x)) for x in towards_best]
        points = sorted(function.points)
        theirs = np.interp(towards_best, [q for q, _ in points], [v for _, v in points])
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-13)
        assert all(0.0 <= value <= 1.0 for value in ours)
        assert all(later >= value - 1e-15 for value, later in itertools.pairwise(ours))


@pytest.mark.parametrize(("worst", "best"), [(5.0, 5.0), (0.0, 0.0), (0.0, 5e-324)])
def test_no_range(worst, best):
    with pytest.raises(
        TradeoffError, match=r"the value function of 'm' has no range: worst and best are both"
    ) as error:
        ValueFunction(measure="m", worst=worst, best=best)
    assert "threshold and goal" in error.value.hint


@pytest.mark.parametrize(("worst", "best"), [(math.nan, 1.0), (0.0, math.inf), (-1e308, 1e308)])
def test_not_anchored(worst, best):
    with pytest.raises(TradeoffError, match="the value function of 'm' is not anchored") as error:
        ValueFunction(measure="m", worst=worst, best=best)
    assert error.value.hint == "give two finite numbers"


@pytest.mark.parametrize(
    "interior",
    [
        ((0.0, 0.5),),
        ((1.0, 0.5),),
        ((2.0, 0.5),),
        ((0.6, 0.5), (0.4, 0.6)),
        ((0.4, 0.6), (0.6, 0.5)),
        ((0.5, -0.1),),
        ((0.5, 1.1),),
        ((0.5, math.nan),),
        ((math.nan, 0.5),),
        ((math.inf, 0.5),),
    ],
)
def test_points_out_of_order(interior):
    with pytest.raises(TradeoffError, match="the value function of 'm' is out of order at") as error:
        ValueFunction(measure="m", worst=0.0, best=1.0, interior=interior)
    assert "from worst to best" in error.value.hint


@pytest.mark.parametrize("weights", [{"a": 1.0}, {"a": 0.1, "b": 0.2, "c": 0.7}, {"a": 0.0, "b": 1.0 + 5e-10}])
def test_weights(weights):
    weighting = Weighting(weights=weights)
    assert weighting.deciding_measures == tuple(measure for measure in weights if weights[measure])


@pytest.mark.parametrize(
    ("weights", "message", "hint"),
    [
        ({}, "there are no weights", "give a weight to at least one measure"),
        ({"a": -0.1, "b": 1.1}, "the weight of 'a' is -0.1", "a weight is a number from 0 to 1"),
        ({"a": math.nan}, "the weight of 'a' is nan", "a weight is a number from 0 to 1"),
        ({"a": math.inf}, "the weight of 'a' is inf", "a weight is a number from 0 to 1"),
        ({"a": 0.5, "b": 0.4}, "the weights sum to 0.9, not to 1", "change them by +0.1 in all, or divide each by 0.9"),
        ({"a": 1.0 + 3e-9}, "the weights sum to 1.000000003, not to 1", "change them by"),
        ({"a": 0.0}, "the weights sum to 0, not to 1", "give a positive weight to at least one measure"),
    ],
)
def test_bad_weights(weights, message, hint):
    with pytest.raises(TradeoffError) as error:
        Weighting(weights=weights)
    assert error.value.message == message
    assert error.value.hint.startswith(hint)
    assert "\n" not in str(error.value)
