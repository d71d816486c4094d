from __future__ import annotations

import math
import statistics

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from rgss.measures.estimates import Estimate, mean_estimate, proportion_estimate
from rgss.measures.mean_limits import MOST_EXACT, mean_limits


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize("trials", [1, 2, 3, 5, 20, 50, 400])
def test_the_proportion_agrees_with_scipy(trials: int) -> None:
    for successes in range(trials + 1):
        expected = stats.binomtest(successes, trials).proportion_ci(confidence_level=0.95, method="exact")
        estimate = proportion_estimate(successes, trials)
        assert estimate.value == successes / trials
        assert (estimate.low, estimate.high) == pytest.approx((expected.low, expected.high), abs=1e-10)
        assert estimate.n == trials
        assert estimate.unit == "1"


def test_the_bounds_of_certain_proportions_are_exact() -> None:
    assert proportion_estimate(0, 7).low == 0.0
    assert proportion_estimate(7, 7).high == 1.0


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize("trials", [3, 10, 30])
def test_a_proportion_is_called_met_or_not_met_wrongly_in_at_most_one_of_40(trials: int) -> None:
    """Exactly, by summing the binomial distribution, with the truth at the threshold."""
    counts = np.arange(trials + 1)
    limits = [proportion_estimate(int(count), trials) for count in counts]
    for truth in np.linspace(0.01, 0.99, 197):
        chances = stats.binom.pmf(counts, trials, truth)
        assert chances[[one.low > truth for one in limits]].sum() <= 0.025 + 1e-9
        assert chances[[one.high < truth for one in limits]].sum() <= 0.025 + 1e-9


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize(("successes", "trials"), [(3, 3), (2, 3), (5, 10), (29, 30), (60, MOST_EXACT)])
def test_the_limits_of_the_mean_of_zeros_and_ones_are_those_of_clopper_and_pearson(successes: int, trials: int) -> None:
    values = [1.0] * successes + [0.0] * (trials - successes)
    expected = stats.binomtest(successes, trials).proportion_ci(confidence_level=0.95, method="exact")
    assert mean_limits(values, least=0.0, most=1.0, tail=0.025) == pytest.approx(
        (expected.low, expected.high), abs=1e-8
    )


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize("size", [2, 3, 10, 30, MOST_EXACT, MOST_EXACT + 1, 200])
def test_the_limits_are_quantiles_of_uniform_weights(size: int) -> None:
    """Drawn weights are another way to the same quantiles than the recursion and the saddlepoint."""
    generator = np.random.default_rng(size)
    values = generator.lognormal(size=size)
    low, high = mean_limits(values.tolist(), least=0.0, most=60.0, tail=0.025)
    assert low is not None
    assert high is not None
    weights = generator.dirichlet(np.ones(size + 1), 40_000)
    assert np.mean(weights @ np.append(values, 60.0) > high) == pytest.approx(0.025, abs=0.003)
    assert np.mean(weights @ np.append(values, 0.0) < low) == pytest.approx(0.025, abs=0.003)


def test_equal_values_have_the_limits_of_a_closed_form() -> None:
    low, high = mean_limits([3.0] * 4, least=1.0, most=5.0, tail=0.025)
    share = 1.0 - 0.025**0.25
    assert (low, high) == pytest.approx((3.0 - 2.0 * share, 3.0 + 2.0 * share))


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize("size", [3, 10, 30])
@pytest.mark.parametrize("times", ["normal", "lognormal", "mixture"])
def test_limits_of_times_are_wrong_in_at_most_one_of_40(times: str, size: int) -> None:
    """What benchmarks/calibration.py measures with more repetitions and of more distributions."""
    generator = np.random.default_rng([size, len(times)])
    shape = (400, size)
    drawn, mean = {
        "normal": (generator.normal(10.0, 2.0, shape), 10.0),
        "lognormal": (generator.lognormal(sigma=1.0, size=shape), math.exp(0.5)),
        "mixture": (generator.normal(10.0, 1.0, shape) * np.where(generator.random(shape) < 0.05, 10.0, 1.0), 14.5),
    }[times]
    limits = [mean_limits(row, least=0.0, most=None, tail=0.025) for row in drawn.tolist()]
    # Three standard errors beyond the nominal rate would be 0.048.
    assert np.mean([high < mean for _, high in limits]) <= 0.025
    assert np.mean([low > mean for low, _ in limits]) <= 0.025


def test_one_trial_has_a_value_and_no_interval() -> None:
    assert mean_estimate([3.0], "s") == Estimate(value=3.0, unit="s", low=None, high=None, n=1)


def test_one_trial_between_declared_bounds_has_an_interval() -> None:
    estimate = mean_estimate([3.0], "s", least=0.0, most=4.0)
    assert (estimate.low, estimate.high) == pytest.approx((0.025 * 3.0, 3.0 + 0.975))


def test_a_declared_bound_makes_the_interval_shorter() -> None:
    values = [9.0, 10.0, 12.0]
    wide, short = mean_estimate(values, "s"), mean_estimate(values, "s", least=0.0, most=20.0)
    assert wide.low < short.low < short.high < wide.high


def test_values_whose_bounds_are_beyond_all_numbers_have_no_limits() -> None:
    assert mean_estimate([-1e308, 1e308], "s") == Estimate(value=0.0, unit="s", low=None, high=None, n=2)


@pytest.mark.parametrize("over_looks", [False, True])
def test_values_that_are_all_zero_bound_nothing(over_looks: bool) -> None:
    """Of a count that is 1 in one trial of 50, nine studies of ten see none in three trials: that shows no mean."""
    found = mean_estimate([0.0] * 30, "1", least=0.0, over_looks=over_looks)
    assert (found.value, found.low, found.high) == (0.0, 0.0, None)
    assert (mean_estimate([0.0] * 30, "1", over_looks=over_looks).low) is None
    declared = mean_estimate([0.0] * 30, "1", least=0.0, most=1.0, over_looks=over_looks)
    assert declared.high is not None
    assert declared.high > 0.1


def test_no_trial_gives_nothing() -> None:
    assert mean_estimate([], "s") == Estimate.unknown("s")
    assert proportion_estimate(0, 0) == Estimate.unknown("1")
    assert Estimate.unknown("s") == Estimate(value=None, unit="s", low=None, high=None, n=0)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=8))
def test_the_interval_is_reproducible_and_holds_the_mean(values: list[float]) -> None:
    estimate = mean_estimate(values, "m")
    assert estimate == mean_estimate(list(reversed(values)), "m")
    assert estimate.value == pytest.approx(statistics.fmean(values), abs=1e-9)
    if not any(values):
        assert (estimate.low, estimate.high) == (None, None)
        return
    assert estimate.low is not None
    assert estimate.high is not None
    slack = 1e-8 * max(map(abs, values))
    assert estimate.low - slack <= estimate.value <= estimate.high + slack
