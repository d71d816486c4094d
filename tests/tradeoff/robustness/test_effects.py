"""Factorial effects, against a published analysis of variance, statsmodels and theory."""

from __future__ import annotations

import itertools

import numpy as np
import pandas as pd
import pytest
from scipy.stats import sobol_indices

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.resampling import bootstrap
from rgss.tradeoff.robustness.complete_block import largest_complete_block
from rgss.tradeoff.robustness.effects import factorial_effects

BATTERY = np.array(
    [
        [[130, 155, 74, 180], [34, 40, 80, 75], [20, 70, 82, 58]],
        [[150, 188, 159, 126], [136, 122, 106, 115], [25, 70, 58, 45]],
        [[138, 110, 168, 160], [174, 120, 150, 139], [96, 104, 82, 60]],
    ],
    dtype=float,
)
"""Life of a battery by material, temperature and replicate: the battery design experiment of Montgomery."""


def by_term(analysis):
    return {effect.factors: effect for effect in analysis.effects}


def test_the_published_analysis_of_variance():
    """Montgomery, "Design and Analysis of Experiments", chapter 5; sums of squares of the 36 lives."""
    found = by_term(factorial_effects(BATTERY.mean(axis=2), ["material", "temperature"]))

    assert 4 * found["material",].sum_of_squares == pytest.approx(10683.72, abs=0.005)
    assert 4 * found["temperature",].sum_of_squares == pytest.approx(39118.72, abs=0.005)
    assert 4 * found["material", "temperature"].sum_of_squares == pytest.approx(9613.78, abs=0.005)
    assert [effect.degrees_of_freedom for effect in found.values()] == [2, 2, 4]
    assert found["temperature",].levels == pytest.approx(BATTERY.mean(axis=(0, 2)) - BATTERY.mean())


def test_against_statsmodels():
    """Four factors of 2, 3, 2 and 3 levels with three replicates, all terms up to three factors."""
    from statsmodels.formula.api import ols
    from statsmodels.stats.anova import anova_lm

    values = np.random.default_rng(0).normal(size=(2, 3, 2, 3, 3))
    frame = pd.DataFrame([(*place, values[place]) for place in np.ndindex(*values.shape)], columns=[*"abcd", "r", "y"])
    table = anova_lm(ols("y ~ (C(a) + C(b) + C(c) + C(d)) ** 3", frame).fit())
    analysis = factorial_effects(values.mean(axis=4), list("abcd"), order=3)

    for term, effect in by_term(analysis).items():
        row = ":".join(f"C({factor})" for factor in term)
        assert 3 * effect.sum_of_squares == pytest.approx(table.loc[row, "sum_sq"])
        assert effect.degrees_of_freedom == table.loc[row, "df"]
    assert sum(effect.share for effect in analysis.effects) + analysis.rest == pytest.approx(1.0)


def test_effects_rebuild_the_measure():
    """Mean, main effects and all interactions sum to every estimate, and to 0 along every axis."""
    values = np.random.default_rng(1).normal(size=(2, 3, 4))
    analysis = factorial_effects(values, list("abc"), order=3)
    terms = by_term(analysis)

    for place in np.ndindex(*values.shape):
        level = dict(zip("abc", place, strict=True))
        rebuilt = analysis.mean + sum(e.levels[tuple(level[f] for f in term)] for term, e in terms.items())
        assert rebuilt == pytest.approx(values[place])
    for term, effect in terms.items():
        for axis in range(len(term)):
            assert effect.levels.sum(axis=axis) == pytest.approx(0.0, abs=1e-12)
    assert analysis.rest == pytest.approx(0.0)


def test_indices_of_the_ishigami_function():
    """On a fine grid the indices are those of theory (Ishigami and Homma 1990): a = 7, b = 0.1."""
    points = (np.arange(60) + 0.5) / 60 * 2 * np.pi - np.pi
    x, y, z = np.meshgrid(points, points, points, indexing="ij")
    analysis = factorial_effects(np.sin(x) + 7 * np.sin(y) ** 2 + 0.1 * z**4 * np.sin(x), list("xyz"))

    assert analysis.first_order == pytest.approx({"x": 0.3139, "y": 0.4424, "z": 0.0}, abs=1e-3)
    assert analysis.total_order == pytest.approx({"x": 0.5576, "y": 0.4424, "z": 0.2437}, abs=1e-3)


def test_intervals_are_those_of_the_effects_in_every_resample():
    """Each resample analysed on its own; three replicates, so ten resamples with their probabilities."""
    replicates = np.random.default_rng(2).normal(size=(2, 3, 3))
    resamples = bootstrap(3, draws=1, generator=np.random.default_rng(0))
    found = factorial_effects(
        replicates.mean(axis=2),
        list("ab"),
        resampled=resamples.means(replicates),
        probabilities=resamples.probabilities,
    )
    alone = []
    for counts, probability in zip(resamples.counts, resamples.probabilities, strict=True):
        estimates = (replicates * counts).sum(axis=2) / 3
        alone.append((estimates.mean(axis=1)[0] - estimates.mean(), probability))
    alone.sort()
    below = np.cumsum([probability for _, probability in alone])
    effect = by_term(found)["a",]

    assert effect.low[0] == pytest.approx(next(v for (v, _), b in zip(alone, below, strict=True) if b >= 0.025))
    assert effect.high[0] == pytest.approx(next(v for (v, _), b in zip(alone, below, strict=True) if b >= 0.975))
    assert effect.share_low <= effect.share_high
    assert found.used == pytest.approx(1.0)


def test_noise_that_all_designs_share_moves_no_effect():
    """Every design gains the same in each replicate: effects are certain, though the means are not."""
    effects = np.array([[0.0, 1.0], [2.0, 5.0]])
    replicates = effects[:, :, None] + np.random.default_rng(3).normal(size=4)
    resamples = bootstrap(4, draws=1, generator=np.random.default_rng(0))
    found = factorial_effects(
        replicates.mean(axis=2),
        list("ab"),
        resampled=resamples.means(replicates),
        probabilities=resamples.probabilities,
    )

    for effect in found.effects:
        assert effect.low == pytest.approx(effect.levels)
        assert effect.high == pytest.approx(effect.levels)


def test_resamples_without_an_estimate_are_counted():
    """One design is known in one of two replicates alone: of three resamples one has nothing of it."""
    replicates = np.array([[[1.0, np.nan], [2.0, 2.0]], [[3.0, 3.0], [4.0, 5.0]]])
    resamples = bootstrap(2, draws=1, generator=np.random.default_rng(0))
    found = factorial_effects(
        np.array([[1.0, 2.0], [3.0, 4.5]]),
        list("ab"),
        resampled=resamples.means(replicates),
        probabilities=resamples.probabilities,
    )

    assert found.used == pytest.approx(0.75)
    # The two that remain are too few: with others the interval would be another.
    assert (found.effects[0].low, found.effects[0].share_low) == (None, None)


def test_intervals_are_given_where_nearly_all_resamples_have_estimates():
    """A design that lacks k of six replicates has an estimate in 1 - (k / 6)^6 of the resamples."""
    replicates = np.full((2, 2, 6), 2.0) + np.arange(6)
    replicates[1, 1, :2] = np.nan
    resamples = bootstrap(6, draws=2000, generator=np.random.default_rng(0))
    found = factorial_effects(
        np.nanmean(replicates, axis=2),
        list("ab"),
        resampled=resamples.means(replicates),
        probabilities=resamples.probabilities,
    )

    assert found.used == pytest.approx(1 - (2 / 6) ** 6, abs=0.02)
    assert found.effects[0].low is not None
    sparse = replicates.copy()
    sparse[1, 1, :5] = np.nan
    few = factorial_effects(
        np.nanmean(sparse, axis=2),
        list("ab"),
        resampled=resamples.means(sparse),
        probabilities=resamples.probabilities,
    )
    assert few.used == pytest.approx(1 - (5 / 6) ** 6, abs=0.02)
    assert few.effects[0].low is None


def test_a_measure_that_is_level():
    """A measure with no range has no shares, and divides by nothing."""
    found = factorial_effects(np.full((2, 3), 0.1 + 0.2), list("ab"))

    assert [effect.share for effect in found.effects] == [0.0, 0.0, 0.0]
    assert found.total_order == {"a": 0.0, "b": 0.0}


def test_without_replicates_there_are_no_intervals():
    found = factorial_effects(np.array([1.0, 2.0]), ["a"])

    assert (found.effects[0].low, found.effects[0].share_low, found.used) == (None, None, 0.0)


@pytest.mark.parametrize(
    ("estimates", "factors", "message"),
    [
        ([[1.0, np.nan], [2.0, 3.0]], ["a", "b"], r"1 of 4 designs have no estimate, so effects would be confounded"),
        ([[1.0, 2.0]], ["a", "b"], "factor 'a' has one level and no effect"),
        ([1.0, 2.0], ["a", "b"], "2 factors do not fit a design with 1 axes"),
    ],
)
def test_designs_that_have_no_effects(estimates, factors, message):
    with pytest.raises(TradeoffError, match=message):
        factorial_effects(np.array(estimates), factors)


@pytest.mark.parametrize("seed", range(5))
def test_the_largest_complete_block_against_all_blocks(seed):
    known = np.random.default_rng(seed).random((2, 3, 3)) > 0.25
    choices = [[c for n in range(1, k + 1) for c in itertools.combinations(range(k), n)] for k in known.shape]
    sizes = [
        np.prod([len(levels) for levels in kept]) for kept in itertools.product(*choices) if known[np.ix_(*kept)].all()
    ]
    found = largest_complete_block(known)

    assert known[np.ix_(*found)].all()
    assert np.prod([len(levels) for levels in found]) == max(sizes)


def test_no_block_is_complete():
    assert largest_complete_block(np.array([[True, False], [False, False]])) is None


def test_effects_of_the_whole_space_are_those_that_a_sample_estimates():
    """Saltelli's estimator as the oracle: levels drawn at random, one factor mixed at a time."""
    generator = np.random.default_rng(1)
    table = generator.normal(size=(2, 3, 4)) + np.array([0.0, 2.0])[:, None, None]
    first, second = (generator.integers(0, table.shape, size=(8192, table.ndim)) for _ in range(2))
    mixed = np.repeat(first[None], table.ndim, axis=0)
    for factor in range(table.ndim):
        mixed[factor, :, factor] = second[:, factor]
    values = [table[tuple(np.moveaxis(rows, -1, 0))] for rows in (first, second, mixed)]
    sampled = sobol_indices(
        func={"f_A": values[0][None], "f_B": values[1][None], "f_AB": values[2][:, None, :]}, n=len(first)
    )
    whole = factorial_effects(table, list("abc"))

    assert np.ravel(sampled.first_order) == pytest.approx(list(whole.first_order.values()), abs=0.05)
    assert np.ravel(sampled.total_order) == pytest.approx(list(whole.total_order.values()), abs=0.05)
