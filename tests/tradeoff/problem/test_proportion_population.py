from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff.problem import ObservedRows, posterior_means
from rgss.tradeoff.problem.proportion_population import proportion_population


def drawn_proportions(successes, trials, *, draws=2_000, seed=1):
    generator = np.random.default_rng(seed)
    won, tried = np.array(successes, dtype=float), np.array(trials, dtype=float)
    mean, strength = proportion_population(won, tried, draws=draws, generator=generator)
    return generator.beta(mean * strength + won, (1.0 - mean) * strength + tried - won)


@pytest.mark.parametrize(("won", "tried"), [(3, 3), (0, 10), (7, 10)])
def test_of_one_design_the_posterior_is_that_of_its_prior_integrated(won, tried):
    """A beta distribution with a Jeffreys mean and the strength's density 1 / (1 + s)², summed on a finer grid."""
    from scipy.special import betaln

    mean, log = np.meshgrid(np.linspace(0.0025, 0.9975, 400), np.linspace(np.log(0.5), np.log(128.0), 300))
    strength = np.exp(log)
    heights = betaln(mean * strength + won, (1 - mean) * strength + tried - won)
    heights -= betaln(mean * strength, (1 - mean) * strength)
    heights += log - 2 * np.log1p(strength) - 0.5 * np.log(mean * (1 - mean))
    chances = np.exp(heights - heights.max())
    expected = (chances * (mean * strength + won) / (strength + tried)).sum() / chances.sum()
    assert drawn_proportions([won], [tried], draws=20_000).mean() == pytest.approx(expected, abs=0.015)


def test_hopeless_designs_do_not_drag_the_good_ones_down():
    generator = np.random.default_rng(5)
    good, hopeless = generator.binomial(30, 0.96, 18), generator.binomial(30, 0.3, 6)
    drawn = drawn_proportions([*good, *hopeless], [30] * 24)
    assert drawn[:, :18].mean() == pytest.approx(0.96, abs=0.015)
    assert drawn[:, 18:].mean() == pytest.approx(0.3, abs=0.06)
    assert (drawn[:, :18] >= 0.9).mean() > 0.8


def test_designs_that_are_alike_are_known_better_than_each_alone():
    drawn = drawn_proportions([10, 9, 10, 9, 10, 10, 9, 10] * 3, [10] * 24)
    alone = drawn_proportions([9], [10])
    assert drawn[:, 1].std() < 0.7 * alone.std()


def test_intervals_cover_over_populations_of_several_shapes():
    covered = []
    for run in range(12):
        generator = np.random.default_rng([run, 3])
        shape = run % 4
        truth = [
            generator.uniform(0.5, 1.0, 24),
            np.where(generator.random(24) < 0.7, generator.uniform(0.9, 1.0, 24), generator.uniform(0.0, 0.5, 24)),
            generator.beta(8.0, 2.0, 24),
            np.full(24, 0.8),
        ][shape]
        rows = (generator.random((24, 12)) < truth[:, None]).astype(float)
        (drawn,) = posterior_means([ObservedRows(values=rows, is_proportion=True)], draws=400, generator=generator)
        low, high = np.quantile(drawn, [0.05, 0.95], axis=0)
        covered.append(((low <= truth) & (truth <= high)).mean())
    assert 0.85 <= np.mean(covered) <= 0.96
