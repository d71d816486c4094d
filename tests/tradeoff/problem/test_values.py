from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import ExponentialValue, PiecewiseValue, TargetValue, Weighting


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
    assert PiecewiseValue(measure="m", worst=worst, best=best).value_at(quantity) == pytest.approx(value, abs=1e-15)


@pytest.mark.parametrize(
    ("quantity", "value"), [(0.0, 0.0), (1.0, 0.4), (2.0, 0.8), (3.0, 0.8), (5.0, 0.8), (7.5, 0.9), (10.0, 1.0)]
)
def test_piecewise_value(quantity, value):
    function = PiecewiseValue(measure="m", worst=0.0, best=10.0, interior=((2.0, 0.8), (5.0, 0.8)))
    assert function.value_at(quantity) == pytest.approx(value, abs=1e-15)


def test_piecewise_value_where_less_is_better():
    function = PiecewiseValue(measure="m", worst=10.0, best=0.0, interior=((4.0, 0.2),))
    assert [function.value_at(x) for x in (11.0, 7.0, 4.0, 2.0, -1.0)] == pytest.approx([0.0, 0.1, 0.2, 0.6, 1.0])


def test_values_agree_with_interpolation_never_fall_and_stay_in_range(seeded):
    rng = seeded(7)
    for _ in range(200):
        count = rng.randrange(4)
        quantities = sorted(rng.uniform(-5, 5) for _ in range(count + 2))
        values = sorted(rng.random() for _ in range(count))
        if rng.random() < 0.5:
            quantities.reverse()
        function = PiecewiseValue(
            measure="m",
            worst=quantities[0],
            best=quantities[-1],
            interior=tuple(zip(quantities[1:-1], values, strict=True)),
        )
        towards_best = np.linspace(quantities[0] * 2 - quantities[-1], quantities[-1] * 2 - quantities[0], 50)
        ours = [function.value_at(float(x)) for x in towards_best]
        points = function.breakpoints
        theirs = np.interp(towards_best, [q for q, _ in points], [v for _, v in points])
        np.testing.assert_allclose(ours, theirs, rtol=0, atol=1e-13)
        assert all(0.0 <= value <= 1.0 for value in ours)
        assert all(later >= value - 1e-15 for value, later in itertools.pairwise(ours))


@pytest.mark.parametrize(("worst", "best"), [(5.0, 5.0), (0.0, 0.0), (0.0, 5e-324)])
def test_no_range(worst, best):
    with pytest.raises(
        TradeoffError, match=r"the value function of 'm' has no range: worst and best are both"
    ) as error:
        PiecewiseValue(measure="m", worst=worst, best=best)
    assert "threshold and goal" in error.value.hint


@pytest.mark.parametrize(("worst", "best"), [(math.nan, 1.0), (0.0, math.inf), (-1e308, 1e308)])
def test_not_anchored(worst, best):
    with pytest.raises(TradeoffError, match="the value function of 'm' is not anchored") as error:
        PiecewiseValue(measure="m", worst=worst, best=best)
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
        PiecewiseValue(measure="m", worst=0.0, best=1.0, interior=interior)
    assert "from worst to best" in error.value.hint


@pytest.mark.parametrize("weights", [{"a": 1.0}, {"a": 0.1, "b": 0.2, "c": 0.7}, {"a": 0.0, "b": 1.0 + 5e-10}])
def test_weights(weights):
    weighting = Weighting(weights=weights)
    assert weighting.deciding_measures == tuple(measure for measure in weights if weights[measure])


@pytest.mark.parametrize(
    ("weights", "message", "hint"),
    [
        ({}, "there are no weights", "give a weight to at least one measure"),
        ({"a": -0.1, "b": 1.1}, "weight of 'a' must be at least 0, got -0.1", "give a number from 0 to 1"),
        ({"a": math.nan}, "weight of 'a' must be at least 0, got nan", "give a number from 0 to 1"),
        ({"a": math.inf}, "weight of 'a' must be at least 0, got inf", "give a number from 0 to 1"),
        ({"a": 0.5, "b": 0.4}, "weights must sum to 1, got 0.9", "change them by +0.1 in all, or divide each by 0.9"),
        ({"a": 1.0 + 3e-9}, "weights must sum to 1, got 1.000000003", "change them by"),
        ({"a": 0.0}, "weights must sum to 1, got 0", "give a positive weight to at least one measure"),
    ],
)
def test_bad_weights(weights, message, hint):
    with pytest.raises(TradeoffError) as error:
        Weighting(weights=weights)
    assert error.value.message == message
    assert error.value.hint.startswith(hint)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("halfway", [0.008, 0.1, 0.25, 0.4999, 0.5, 0.5001, 0.8, 0.992])
@pytest.mark.parametrize(("worst", "best"), [(0.0, 1.0), (60.0, 20.0), (-2.0, 5e6)])
def test_exponential_value(worst, best, halfway):
    quantity = worst + halfway * (best - worst)
    function = ExponentialValue(measure="m", worst=worst, best=best, halfway=quantity)
    assert function.more_is_better is (best > worst)
    assert function.value_at(worst) == 0.0
    assert function.value_at(best) == 1.0
    assert function.value_at(quantity) == pytest.approx(0.5, abs=1e-12)
    assert function.value_at(worst - (best - worst)) == 0.0
    assert function.value_at(best + (best - worst)) == 1.0
    values = [function.value_at(worst + share * (best - worst)) for share in np.linspace(0.0, 1.0, 50)]
    assert values == sorted(values)
    # Gains shrink or grow by one factor from step to step.
    gains = np.diff(values)
    assert gains[1:] == pytest.approx(gains[:-1] * (gains[1] / gains[0]), abs=1e-9)


def test_exponential_value_by_hand():
    """ρ = ln 9 gives v(1/2) = (1 - 1/3) / (1 - 1/9) = 3/4, so half of the value is at z with 9^-z = 5/9."""
    half = math.log(9 / 5) / math.log(9)
    function = ExponentialValue(measure="m", worst=0.0, best=1.0, halfway=half)
    assert function.exponent == pytest.approx(math.log(9))
    assert function.value_at(0.5) == pytest.approx(0.75)


@pytest.mark.parametrize("halfway", [0.0, 1.0, -3.0, 5.0, 0.001, 0.999, math.nan])
def test_no_half_way(halfway):
    with pytest.raises(TradeoffError, match="the value function of 'm' has no half-way quantity at") as error:
        ExponentialValue(measure="m", worst=0.0, best=1.0, halfway=halfway)
    assert error.value.hint.startswith("name a quantity between 0 and 1")


@pytest.mark.parametrize(
    ("quantity", "value"), [(5.0, 0.0), (10.0, 0.0), (15.0, 0.5), (20.0, 1.0), (30.0, 0.75), (60.0, 0.0), (99.0, 0.0)]
)
def test_target_value(quantity, value):
    function = TargetValue(measure="m", target=20.0, too_low=10.0, too_high=60.0)
    assert function.value_at(quantity) == pytest.approx(value)
    assert function.more_is_better is None


@pytest.mark.parametrize(
    ("target", "low", "high", "message"),
    [
        (5.0, 10.0, 60.0, "the target 5 of 'm' is not between 10 and 60"),
        (20.0, 60.0, 10.0, "the target 20 of 'm' is not between 60 and 10"),
        (10.0, 10.0, 60.0, "the value function of 'm' has no range"),
        (math.nan, 10.0, 60.0, "the value function of 'm' is not anchored"),
    ],
)
def test_target_out_of_order(target, low, high, message):
    with pytest.raises(TradeoffError, match=message):
        TargetValue(measure="m", target=target, too_low=low, too_high=high)


@pytest.mark.parametrize(
    "function",
    [
        PiecewiseValue(measure="m", worst=2.0, best=-1.0, interior=((1.0, 0.25), (0.0, 0.25))),
        ExponentialValue(measure="m", worst=2.0, best=-1.0, halfway=1.5),
        ExponentialValue(measure="m", worst=-1.0, best=2.0, halfway=0.5),
        TargetValue(measure="m", target=0.5, too_low=-1.0, too_high=2.0),
    ],
)
def test_columns_agree_with_single_values(function):
    quantities = np.linspace(-2.0, 3.0, 101)
    expected = [function.value_at(float(quantity)) for quantity in quantities]
    np.testing.assert_allclose(function.values_at(quantities), expected, rtol=0, atol=1e-13)
    assert np.isnan(function.values_at(np.array([math.nan]))).all()
