"""Confidence limits that hold at any number of trials."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.measures import Range, bounded_mean_evidence, proportion_evidence
from rgss.measures.anytime_evidence import anytime_mean_limits, anytime_proportion_limits
from rgss.measures.estimates import TAIL, mean_estimate, proportion_estimate
from rgss.measures.ratio_limits import ratio_limits

NEEDED = math.log(1.0 / TAIL)
LOOKS = range(4, 81, 12)


@pytest.mark.parametrize(("successes", "trials"), [(0, 4), (1, 4), (4, 4), (20, 31), (111, 118), (1, 400)])
def test_a_share_between_the_limits_is_not_rejected_and_one_beyond_is(successes, trials):
    low, high = anytime_proportion_limits(successes, trials, tail=TAIL)
    for share in np.linspace(0.0005, 0.9995, 1000).tolist():
        above = proportion_evidence(successes, trials, share, above=True) >= NEEDED
        below = proportion_evidence(successes, trials, share, above=False) >= NEEDED
        assert (share < low, share > high) == (above, below)


@pytest.mark.parametrize(("least", "most"), [(None, None), (0.0, None), (None, 9.0), (0.0, 9.0), (-2.0, 4.0)])
@pytest.mark.parametrize("count", [2, 7, 60])
def test_a_mean_between_the_limits_is_not_rejected_and_one_beyond_is(least, most, count):
    values = np.random.default_rng(count).uniform(0.5, 4.0, count)
    low, high = anytime_mean_limits(values.tolist(), least=least, most=most, tail=TAIL)
    bounds = {"least": -math.inf if least is None else least, "most": math.inf if most is None else most}
    for mean in np.linspace(-39.0, 39.0, 1999).tolist():
        if abs(mean - low) > 1e-6 and mean < values.mean():
            assert (mean < low) == (bounded_mean_evidence(values, mean, above=True, **bounds) >= NEEDED)
        if abs(mean - high) > 1e-6 and mean > values.mean():
            assert (mean > high) == (bounded_mean_evidence(values, mean, above=False, **bounds) >= NEEDED)


def test_limits_of_the_mean_of_ones_and_zeros_that_cannot_be_told_apart_from_their_bounds():
    assert anytime_proportion_limits(0, 5, tail=TAIL)[0] == 0.0
    assert anytime_proportion_limits(5, 5, tail=TAIL)[1] == 1.0
    assert anytime_mean_limits([3.0], least=None, most=None, tail=TAIL) == (None, None)
    low, high = anytime_mean_limits([3.0], least=0.0, most=4.0, tail=TAIL)
    assert 0.0 < low < 3.0 < high < 4.0
    assert anytime_mean_limits([4.0, 4.0], least=4.0, most=4.0, tail=TAIL) == (4.0, 4.0)
    assert anytime_mean_limits([0.0] * 5, least=None, most=None, tail=TAIL) == (None, None)
    assert bounded_mean_evidence([0.0] * 5, -5.0, above=False) == -math.inf
    assert bounded_mean_evidence([0.0] * 5, 5.0, above=True) == -math.inf
    assert bounded_mean_evidence([0.0] * 5, 5.0, above=False) == -math.inf
    assert bounded_mean_evidence([0.0] * 5, 5.0, above=False, most=4.0) == math.inf
    assert anytime_mean_limits([-1e308, 1e308], least=None, most=None, tail=TAIL) == (None, None)


@given(st.lists(st.floats(0.0, 1.0), min_size=2, max_size=40))
def test_limits_hold_the_mean_and_are_mirrored(values):
    low, high = anytime_mean_limits(values, least=0.0, most=1.0, tail=TAIL)
    assert 0.0 <= low <= math.fsum(values) / len(values) + 1e-12
    assert math.fsum(values) / len(values) - 1e-12 <= high <= 1.0
    mirrored = anytime_mean_limits([-each for each in values], least=-1.0, most=0.0, tail=TAIL)
    assert mirrored == (-high, -low)


@pytest.mark.parametrize("count", [4, 12, 64, 200])
def test_they_are_wider_than_those_of_a_fixed_number(count):
    for successes in {0, 1, count // 2, count - 1, count}:
        fixed, any_number = (proportion_estimate(successes, count, over_looks=each) for each in (False, True))
        assert any_number.low <= fixed.low
        assert any_number.high >= fixed.high
        assert any_number.value == fixed.value
    values = np.random.default_rng(count).normal(10.0, 2.0, count).tolist()
    fixed, any_number = (mean_estimate(values, "s", least=0.0, over_looks=each) for each in (False, True))
    assert any_number.low < fixed.low < fixed.value == any_number.value < fixed.high < any_number.high


@pytest.mark.parametrize("share", [0.5, 0.9])
def test_a_share_is_seldom_ever_outside(share):
    """Exact: the probability that a walk of successes and failures ever leaves the limits, by its distribution."""
    inside, outside = {0: 1.0}, [0.0, 0.0]
    for trials in range(1, 121):
        step: dict[int, float] = {}
        for successes, chance in inside.items():
            step[successes] = step.get(successes, 0.0) + chance * (1.0 - share)
            step[successes + 1] = step.get(successes + 1, 0.0) + chance * share
        inside = {}
        for successes, chance in step.items():
            low, high = anytime_proportion_limits(successes, trials, tail=TAIL)
            if low <= share <= high:
                inside[successes] = chance
            else:
                outside[low > share] += chance
    assert max(outside) <= TAIL
    # The interval of a fixed number, looked at as often, fails more often than it states.
    assert sum(outside) > 0.005


@pytest.mark.parametrize("most", [None, 8.0])
def test_a_skewed_mean_is_seldom_ever_outside(most):
    generator, runs = np.random.default_rng(5), 150
    wrong = np.zeros(2)
    for _ in range(runs):
        values = np.minimum(generator.exponential(1.0, LOOKS[-1]), 8.0)
        limits = [anytime_mean_limits(values[:n].tolist(), least=0.0, most=most, tail=TAIL) for n in LOOKS]
        mean = 1.0 - math.exp(-8.0)
        wrong += [any(low > mean for low, _ in limits), any(high < mean for _, high in limits)]
    assert wrong.max() / runs <= TAIL + 3.0 * math.sqrt(TAIL / runs)


def test_a_ratio_is_rejected_where_its_differences_are():
    generator = np.random.default_rng(3)
    pairs = [(float(generator.random() < 0.8), float(generator.uniform(9.0, 20.0))) for _ in range(40)]
    ranges = {"numerator": Range(low=0.0, high=1.0), "denominator": Range(low=5.0, high=60.0)}
    low, high = ratio_limits(pairs, **ranges, tail=TAIL, over_looks=True)
    fixed = ratio_limits(pairs, **ranges, tail=TAIL)
    assert low < fixed[0] < fixed[1] < high
    for ratio in np.linspace(0.001, 0.2, 400).tolist():
        differences = [a - ratio * b for a, b in pairs]
        below = bounded_mean_evidence(differences, 0.0, above=False, most=1.0 - 5.0 * ratio) >= NEEDED
        above = bounded_mean_evidence(differences, 0.0, above=True, least=-60.0 * ratio) >= NEEDED
        assert (ratio > high, ratio < low) == (below, above)
