from __future__ import annotations

import math
import statistics

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from rgss.measures.estimates import Estimate, interval_seed, mean_estimate, proportion_estimate


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize("trials", [1, 2, 3, 5, 20, 50, 400])
def test_the_proportion_agrees_with_scipy(trials: int) -> None:
    for successes in range(trials + 1):
        expected = stats.binomtest(successes, trials).proportion_ci(confidence_level=0.95, method="wilson")
        estimate = proportion_estimate(successes, trials)
        assert estimate.value == successes / trials
        assert (estimate.low, estimate.high) == pytest.approx((expected.low, expected.high), abs=1e-12)
        assert estimate.n == trials
        assert estimate.unit == "1"


def test_the_bounds_of_certain_proportions_are_exact() -> None:
    assert proportion_estimate(0, 7).low == 0.0
    assert proportion_estimate(7, 7).high == 1.0


@pytest.mark.verifies("SYS-037")
@pytest.mark.parametrize("size", [2, 3, 10, 50])
@pytest.mark.parametrize("distribution", ["normal", "lognormal"])
def test_the_bootstrap_interval_agrees_with_scipy(size: int, distribution: str) -> None:
    # Whole numbers, because scipy takes resamples whose sums differ by rounding for no ties.
    sample = np.round(1000 * getattr(np.random.default_rng(size), distribution)(size=size))
    seed = 12345
    # scipy draws the same indices from the same generator, so the intervals are the same, not alike.
    expected = stats.bootstrap(
        (sample,), np.mean, n_resamples=2000, confidence_level=0.95, method="BCa", rng=np.random.default_rng(seed)
    ).confidence_interval
    estimate = mean_estimate([float(entry) for entry in sample], "s", seed=seed)
    assert estimate.value == pytest.approx(sample.mean())
    assert (estimate.low, estimate.high) == pytest.approx((expected.low, expected.high), rel=1e-9)
    assert estimate.n == size


def plain_interval(values: list[float], value: float, seed: int) -> tuple[float, float]:
    """The interval in NumPy's own words: draws each time anew, means of rows, its quantile."""
    deviations = np.asarray(values) - value
    scale = np.abs(deviations).max()
    deviations /= scale
    size = len(values)
    means = deviations[np.random.default_rng(seed).integers(0, size, size=(2000, size))].mean(axis=1)
    below = (np.mean(means < -1e-12) + np.mean(means <= 1e-12)) / 2
    normal = statistics.NormalDist()
    bias = normal.inv_cdf(min(max(below, 1 / 2000), 1 - 1 / 2000))
    acceleration = (deviations**3).sum() / (6 * (deviations**2).sum() ** 1.5)
    shifted = [bias + normal.inv_cdf(tail) for tail in ((1 - 0.95) / 2, (1 + 0.95) / 2)]
    low, high = np.quantile(means, [normal.cdf(bias + z / (1 - acceleration * z)) for z in shifted])
    return value + scale * low, value + scale * high


@pytest.mark.parametrize("size", [2, 3, 7, 8, 16, 17])
def test_the_interval_is_the_plain_one_to_the_last_bit(size: int) -> None:
    """Draws are kept, few trials are added column by column, and quantiles are our own: none of it shows."""
    generator = np.random.default_rng(size)
    for _ in range(20):
        values = (generator.normal(size=size) * 10.0 ** generator.integers(-6, 6)).tolist()
        estimate = mean_estimate(values, "s", seed=9)
        assert estimate.value is not None
        assert (estimate.low, estimate.high) == plain_interval(values, estimate.value, 9)


@pytest.mark.verifies("SYS-037")
def test_the_interval_covers_the_mean_about_as_often_as_it_says() -> None:
    rng = np.random.default_rng(7)
    covered = 0
    for seed in range(300):
        estimate = mean_estimate(rng.normal(size=40).tolist(), "1", seed=seed)
        assert estimate.low is not None
        assert estimate.high is not None
        covered += estimate.low <= 0.0 <= estimate.high
    assert 0.90 <= covered / 300 <= 0.98


def test_one_trial_has_a_value_and_no_interval() -> None:
    assert mean_estimate([3.0], "s", seed=1) == Estimate(value=3.0, unit="s", low=None, high=None, n=1)


def test_equal_trials_have_an_interval_of_no_width() -> None:
    assert mean_estimate([3.0] * 4, "s", seed=1) == Estimate(value=3.0, unit="s", low=3.0, high=3.0, n=4)


def test_no_trial_gives_nothing() -> None:
    assert mean_estimate([], "s", seed=1) == Estimate.unknown("s")
    assert proportion_estimate(0, 0) == Estimate.unknown("1")
    assert Estimate.unknown("s") == Estimate(value=None, unit="s", low=None, high=None, n=0)


@given(st.lists(st.floats(-1e6, 1e6), min_size=2, max_size=8), st.integers(0, 2**64))
def test_the_interval_is_reproducible_and_within_the_sample(values: list[float], seed: int) -> None:
    estimate = mean_estimate(values, "m", seed=seed)
    assert estimate == mean_estimate(values, "m", seed=seed)
    assert estimate.value == pytest.approx(statistics.fmean(values), abs=1e-9)
    assert estimate.low is not None
    assert estimate.high is not None
    slack = 1e-9 * max(1.0, *map(abs, values))
    assert min(values) - slack <= estimate.low <= estimate.high <= max(values) + slack
    assert math.isfinite(estimate.low)


def test_seeds_differ_by_study_and_measure() -> None:
    seeds = {interval_seed(s, m) for s in (1, 2) for m in ("t_e", "t_p")}
    assert len(seeds) == 4
    # The value is part of the evidence, so it must not change from one release to the next.
    assert interval_seed(1, "t_e") == 273913733911641451298865274764331416678
