"""Widths of the noise of alternatives, from few replicates each."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff.problem import ObservedRows, posterior_means
from rgss.tradeoff.problem.noise_widths import noise_widths


def found(widths, count, *, seed=0):
    values = np.asarray(widths)[:, None] * np.random.default_rng(seed).standard_normal((len(widths), count))
    noise = values - values.mean(axis=1, keepdims=True)
    return noise, noise_widths(noise, np.full(len(widths), count), np.arange(len(widths)))


def test_equal_noise_has_one_width_unless_the_estimates_scatter_by_chance():
    pooled = 0
    for seed in range(8):
        noise, widths = found(np.full(40, 3.0), 8, seed=seed)
        assert np.abs(np.log(widths / 3.0)).max() < 0.45
        if np.ptp(widths) == 0.0:
            pooled += 1
            assert widths[0] == pytest.approx(np.sqrt((noise**2).sum() / (40 * 7)))
    assert pooled >= 2


def test_variances_of_the_assumed_kind_are_estimated_better_than_each_alone():
    """Truth and estimate of a prior with 6 degrees of freedom about 1."""
    generator = np.random.default_rng(2)
    true = np.sqrt(6.0 / generator.chisquare(6, 400))
    noise, widths = found(true, 4, seed=3)
    alone = np.sqrt((noise**2).sum(axis=1) / 3.0)
    error, error_alone = (np.square(np.log(each / true)).mean() for each in (widths, alone))
    assert error < 0.5 * error_alone
    assert np.log(widths / true).mean() == pytest.approx(0.0, abs=0.1)


def test_one_noisy_alternative_keeps_its_noise_and_the_others_theirs():
    _, widths = found([0.02] * 11 + [0.3], 10, seed=4)
    assert widths[:11].max() < 0.05
    assert widths[11] > 0.15


def test_a_single_replicate_has_the_width_that_the_others_suggest_and_none_varies_by_default():
    generator = np.random.default_rng(5)
    noise = generator.standard_normal((20, 6)) * np.r_[np.full(10, 0.1), np.full(10, 1.0)][:, None]
    noise -= noise.mean(axis=1, keepdims=True)
    noise = np.vstack([noise, np.zeros(6)])
    widths = noise_widths(noise, np.r_[np.full(20, 6), 1], np.arange(21))
    assert 0.1 < widths[20] < 1.0
    assert noise_widths(np.zeros((3, 4)), np.full(3, 4), np.arange(3)).tolist() == [1.0] * 3


def test_the_probability_of_being_the_best_is_as_often_right_for_a_noisy_design_as_it_says():
    """Twelve designs of which one scatters by 30 % and the others by 2 %, in random order of their truths."""
    reported, right = [], []
    for run in range(120):
        generator = np.random.default_rng(run)
        true = generator.permutation(np.linspace(10.0, 11.0, 12))
        spread = np.sqrt(np.log1p(np.r_[np.full(11, 0.02), 0.3] ** 2))[:, None]
        values = true[:, None] * np.exp(spread * generator.standard_normal((12, 10)) - spread**2 / 2.0)
        chosen = int(values.mean(axis=1).argmin())
        if chosen == 11:
            rows = ObservedRows(values=values, is_proportion=False)
            (draws,) = posterior_means([rows], draws=400, generator=np.random.default_rng(1))
            reported.append(float((draws.argmin(axis=1) == chosen).mean()))
            right.append(true[chosen] == true.min())
    assert len(reported) > 20
    assert np.mean(reported) == pytest.approx(np.mean(right), abs=0.2)
