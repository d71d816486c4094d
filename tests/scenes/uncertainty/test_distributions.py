"""Quantiles of the distributions against SciPy's cumulative distributions, and draws against both."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from rgss.scenes.uncertainty import (
    Constant,
    Discrete,
    LogNormal,
    Normal,
    TruncatedNormal,
    Uncertainty,
    UncertainValue,
    Uniform,
    draws_of,
)

PAIRS = [
    (Normal(mean=0.002, sd=0.005), stats.norm(0.002, 0.005)),
    (TruncatedNormal(mean=1.0, sd=0.25, low=0.5, high=1.3), stats.truncnorm(-2.0, 1.2, 1.0, 0.25)),
    (Uniform(low=0.2, high=1.2), stats.uniform(0.2, 1.0)),
    (LogNormal(median=0.4, geometric_sd=1.3), stats.lognorm(math.log(1.3), scale=0.4)),
]


@pytest.mark.parametrize(("distribution", "reference"), PAIRS, ids=lambda each: type(each).__name__)
def test_a_share_of_the_draws_lies_below_its_quantile(distribution, reference):
    for share in (1e-9, 0.01, 0.3, 0.5, 0.9, 1 - 1e-9):
        assert reference.cdf(distribution.quantile(share)) == pytest.approx(share, rel=1e-6)


@pytest.mark.parametrize(("distribution", "reference"), PAIRS, ids=lambda each: type(each).__name__)
def test_the_draws_of_many_seeds_have_the_distribution(distribution, reference):
    uncertainty = Uncertainty(values=(UncertainValue(quantity="workpiece.mass", distribution=distribution),))

    draws = [draws_of(uncertainty, seed)["workpiece.mass"] for seed in range(400)]

    assert stats.kstest(draws, reference.cdf).pvalue > 0.01
    # The same seeds against another distribution of the same family fail, so the test above can.
    assert stats.kstest(draws, lambda value: reference.cdf(np.multiply(value, 1.5))).pvalue < 0.01


def test_a_truncated_normal_keeps_its_ends():
    cut = TruncatedNormal(mean=0.0, sd=1.0, low=7.0, high=7.5)

    assert (cut.quantile(2.0**-54), cut.quantile(1 - 2.0**-54)) == pytest.approx((7.0, 7.5))
    assert all(7.0 <= cut.quantile(share) <= 7.5 for share in np.linspace(0.001, 0.999, 50))


def test_quantiles_have_the_nine_digits_of_scipys_own():
    generator = np.random.default_rng(11)
    for _ in range(300):
        mean, sd = generator.uniform(-5.0, 5.0), 10.0 ** generator.uniform(-4.0, 1.0)
        low, high = np.sort(mean + sd * generator.uniform(-6.0, 6.0, 2))
        share = generator.uniform(1e-6, 1.0 - 1e-6)
        weights = generator.random(5)
        found = [
            Normal(mean=mean, sd=sd).quantile(share),
            TruncatedNormal(mean=mean, sd=sd, low=low, high=high).quantile(share),
            LogNormal(median=sd, geometric_sd=1.0 + low**2).quantile(share),
            Discrete(values=(0.0, 1.0, 2.0, 3.0, 4.0), weights=tuple(weights.tolist())).quantile(share),
        ]
        few = stats.rv_discrete(values=(range(5), weights / weights.sum()))
        assert found == pytest.approx(
            [
                stats.norm.ppf(share, mean, sd),
                stats.truncnorm.ppf(share, (low - mean) / sd, (high - mean) / sd, mean, sd),
                stats.lognorm.ppf(share, math.log1p(low**2), scale=sd),
                few.ppf(share),
            ],
            rel=1e-9,
            abs=1e-12,
        )


def test_few_values_are_drawn_by_their_weights():
    three = Discrete(values=(0.1, 0.2, 0.4), weights=(1.0, 2.0, 1.0))

    assert [three.quantile(share) for share in (1e-9, 0.25, 0.2500001, 0.75, 0.7500001, 1 - 1e-9)] == [
        0.1,
        0.1,
        0.2,
        0.2,
        0.4,
        0.4,
    ]
    assert three.support == (0.1, 0.4)


def test_a_constant_is_always_drawn():
    assert {Constant(value=0.2).quantile(share) for share in (1e-9, 0.5, 1 - 1e-9)} == {0.2}
