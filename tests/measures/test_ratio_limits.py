"""Confidence limits of a ratio of means."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.errors import DefinitionError
from rgss.measures import Estimate, MeasureSet, Range, evaluate
from rgss.measures.ratio_limits import ratio_limits

Loader = Callable[..., MeasureSet]
Writer = Callable[..., str]

TAIL = 0.025
SHARE, TIME = Range(low=0.0, high=1.0), Range(low=0.0)
RATE = "{statistic: ratio, over: all}"


def estimate(measures: MeasureSet, *trials: tuple[float, float]) -> Estimate:
    rows = [{"share": share, "task_time_s": time_s} for share, time_s in trials]
    return evaluate(measures, fixed={"design.d2": 1.0, "design.d7": 1.0}, trials=rows, variant=1)["rate"]


@pytest.fixture
def rate(load_entries: Loader, entry: Writer) -> Callable[..., MeasureSet]:
    """Makes the measure of a share over a time with the ranges of both, in 1/h."""

    def make(rule: str = RATE, time: Range = TIME) -> MeasureSet:
        measures = load_entries(entry("rate", "share / time", "1/h", estimate=rule))
        return replace(measures, metric_ranges={"share": SHARE, "task_time_s": time})

    return make


def test_equal_trials_have_the_limits_of_a_closed_form() -> None:
    """Of n equal values and a bound the limit is where (1 - w) v + w bound is 0, with (1 - w)^n the tail."""
    low, high = ratio_limits([(1.0, 12.0)] * 3, numerator=SHARE, denominator=Range(low=5.0, high=60.0), tail=TAIL)
    weight = 1.0 - TAIL ** (1 / 3)
    # Upper: (1 - w)(1 - 12 r) + w (1 - 5 r) = 0. Lower: (1 - w)(1 - 12 r) + w (0 - 60 r) = 0.
    assert high == pytest.approx(1.0 / ((1.0 - weight) * 12.0 + weight * 5.0), rel=1e-8)
    assert low == pytest.approx((1.0 - weight) / ((1.0 - weight) * 12.0 + weight * 60.0), rel=1e-8)


@pytest.mark.parametrize("over_looks", [False, True])
def test_numerators_that_are_all_zero_bound_nothing(over_looks: bool) -> None:
    pairs = [(0.0, 1.0 + 0.01 * number) for number in range(30)]
    unbounded, times = Range(low=0.0, high=math.inf), Range(low=0.0, high=2.0)
    low, high = ratio_limits(pairs, numerator=unbounded, denominator=times, tail=0.025, over_looks=over_looks)
    assert (low, high) == (0.0, None)
    low, high = ratio_limits(pairs, numerator=times, denominator=times, tail=0.025, over_looks=over_looks)
    assert low == 0.0
    assert high > 0.1


@pytest.mark.parametrize("size", [3, 10, 30])
@pytest.mark.parametrize("success", [0.3, 0.9])
def test_limits_of_a_rate_are_wrong_in_at_most_one_of_40(size: int, success: float) -> None:
    generator = np.random.default_rng([size, round(10 * success)])
    shape = (300, size)
    picks, times = generator.random(shape) < success, generator.lognormal(mean=2.0, sigma=0.5, size=shape)
    times = np.where(picks, times, 2.0 * times)  # a failure takes longer
    true = success / (math.exp(2.125) * (success + 2.0 * (1.0 - success)))
    limits = [
        ratio_limits(list(zip(map(float, a), map(float, b), strict=True)), numerator=SHARE, denominator=TIME, tail=TAIL)
        for a, b in zip(picks, times, strict=True)
    ]
    assert np.mean([high < true for _, high in limits]) <= 0.025
    assert np.mean([low > true for low, _ in limits]) <= 0.025


@given(st.lists(st.tuples(st.floats(0.0, 1.0), st.floats(0.1, 100.0)), min_size=2, max_size=70))
def test_the_limits_hold_the_ratio_and_stay_within_what_is_possible(pairs: list[tuple[float, float]]) -> None:
    low, high = ratio_limits(pairs, numerator=SHARE, denominator=Range(low=0.1, high=100.0), tail=TAIL)
    ratio = math.fsum(a for a, _ in pairs) / math.fsum(b for _, b in pairs)
    assert 0.0 <= low <= ratio * (1 + 1e-9)
    assert ratio * (1 - 1e-9) <= high <= 10.0 * (1 + 1e-8)
    mirrored = [(-a, -b) for a, b in pairs]
    ranges = {"numerator": SHARE.negated(), "denominator": Range(low=-100.0, high=-0.1)}
    assert ratio_limits(mirrored, **ranges, tail=TAIL) == (low, high)


def test_three_picks_leave_an_interval_of_possible_rates(rate: Callable[..., MeasureSet]) -> None:
    found = estimate(rate(), (1.0, 12.0), (1.0, 12.5), (1.0, 12.7))
    assert found.value == pytest.approx(3 * 3600 / 37.2)
    assert 0.0 < found.low < found.value < found.high
    # The example of docs/measures.md.
    equal = estimate(rate(), *[(1.0, 12.4)] * 3)
    assert (equal.low, equal.value, equal.high) == pytest.approx((11.5, 290.3, 993.0), rel=2e-3)


def test_no_success_leaves_a_rate_above_zero(rate: Callable[..., MeasureSet]) -> None:
    found = estimate(rate(), (0.0, 40.0), (0.0, 41.0))
    assert (found.value, found.low) == (0.0, 0.0)
    assert found.high > 0.0


def test_a_denominator_of_either_sign_gives_the_linearised_limits_within_what_is_declared(
    rate: Callable[..., MeasureSet],
) -> None:
    """Without a range of the time the linearised values of these trials have limits below zero."""
    trials = [(1.0, 10.0), (1.0, 11.0), (0.0, 12.0)]
    free = estimate(rate(time=Range()), *trials)
    assert free.low < 0.0
    bounded = estimate(rate("{statistic: ratio, over: all, least: 0 h^-1, most: 500 h^-1}", Range()), *trials)
    assert (bounded.low, bounded.high) == (0.0, 500.0)
    assert bounded.value == free.value


def test_declared_bounds_are_those_of_the_quotient_of_a_trial(rate: Callable[..., MeasureSet]) -> None:
    """The linearised value of the failure is negative, its quotient is 0."""
    rule = "{statistic: ratio, over: all, least: 0 h^-1, most: 400 h^-1}"
    found = estimate(rate(rule), (1.0, 10.0), (1.0, 14.0), (0.0, 40.0))
    assert 0.0 <= found.low < found.value < found.high <= 400.0
    one = estimate(rate(rule), (1.0, 10.0))
    assert (one.low, one.value, one.high) == (0.0, pytest.approx(360.0), 400.0)
    with pytest.raises(DefinitionError, match=r"a trial of variant 1 gives rate = 450 1/h, outside the bounds"):
        estimate(rate(rule), (1.0, 10.0), (1.0, 8.0))
