from __future__ import annotations

import itertools

import numpy as np
import pytest

from rgss.tradeoff.problem import ObservedRows, posterior_means
from rgss.tradeoff.problem.population import MOST_JOINT, drawn_with_population


def by_integration(places, variances):
    """Posterior mean and standard deviation of each place, by a grid over the population's variance."""
    scale = variances.mean() * (1.0 - 1.0 / len(places))
    ratios = np.exp(np.linspace(-14.0, 14.0, 2_001))
    heights, means, squares = [], [], []
    for ratio in ratios:
        between = ratio * scale
        precision = 1.0 / (between + variances)
        centre = (precision * places).sum() / precision.sum()
        heights.append(
            0.5 * np.log(precision).sum()
            - 0.5 * np.log(precision.sum())
            - 0.5 * (precision * (places - centre) ** 2).sum()
            + np.log(ratio)
            - 2.0 * np.log1p(ratio)
        )
        share = between / (between + variances)
        mean = centre + share * (places - centre)
        means.append(mean)
        squares.append(share * variances + (1.0 - share) ** 2 / precision.sum() + mean**2)
    chances = np.exp(np.array(heights) - max(heights))
    chances /= chances.sum()
    mean = chances @ np.array(means)
    return mean, np.sqrt(chances @ np.array(squares) - mean**2)


@pytest.mark.parametrize("count", [8, MOST_JOINT + 10])
def test_draws_of_one_population_are_those_of_numerical_integration(count):
    generator = np.random.default_rng(2)
    places, sizes = generator.normal(0.0, 1.5, count), generator.uniform(0.5, 1.5, count)
    flat = places + sizes * generator.standard_normal((20_000, count))
    drawn = drawn_with_population(flat, np.arange(count), None, seeds=10_000, generator=generator)
    mean, spread = by_integration(flat.mean(axis=0), sizes**2)
    assert drawn.mean(axis=0) == pytest.approx(mean, abs=0.08)
    assert drawn.std(axis=0) == pytest.approx(spread, rel=0.1)


def designs_of(planners, others, seeds, *, sigma=0.35, seed=3):
    """Times of planners by eight designs each, in common seeds, with their levels and true means."""
    generator = np.random.default_rng(seed)
    levels = np.array(list(itertools.product(range(len(planners)), range(others))))
    luck = generator.lognormal(-(sigma**2) / 2.0, sigma, (len(planners), seeds))
    rest = generator.lognormal(-0.005, 0.1, (len(levels), seeds))
    truth = np.array(planners)[levels[:, 0]]
    return truth[:, None] * luck[levels[:, 0]] * rest, levels, truth


def test_a_planner_that_is_slow_is_not_drawn_to_the_quick_ones():
    errors = {True: [], False: []}
    for seed in range(6):
        values, levels, truth = designs_of([2.4, 2.4, 3.6], 8, 16, seed=seed)
        for known in (True, False):
            (drawn,) = posterior_means(
                [ObservedRows(values=values, is_proportion=False)],
                draws=400,
                generator=np.random.default_rng(seed),
                levels=levels if known else None,
            )
            errors[known].append((drawn.mean(axis=0) - truth)[16:].mean())
    assert abs(np.mean(errors[True])) < 0.2
    assert np.mean(errors[False]) < np.mean(errors[True])


def test_a_factor_that_does_nothing_is_pooled():
    values, levels, _ = designs_of([3.0, 3.0, 3.0], 8, 6, sigma=0.01)
    rows = [ObservedRows(values=values, is_proportion=False)]
    (drawn,) = posterior_means(rows, draws=1_000, generator=np.random.default_rng(1), levels=levels)
    assert drawn.mean(axis=0).std() < 0.5 * values.mean(axis=1).std()


def test_levels_of_any_name_give_the_same_draws():
    values, levels, _ = designs_of([2.4, 3.6], 3, 5)
    rows = [ObservedRows(values=values, is_proportion=False)]
    one, other = (
        posterior_means(rows, draws=50, generator=np.random.default_rng(1), levels=each)[0]
        for each in (levels, 7 - 3 * levels)
    )
    assert one == pytest.approx(other, rel=1e-9)


def test_alternatives_of_other_levels_whose_values_are_the_same_keep_the_same_draws():
    values, levels, _ = designs_of([2.4, 3.6], 3, 5)
    values[1] = values[0]
    rows = [ObservedRows(values=values, is_proportion=False)]
    (drawn,) = posterior_means(rows, draws=50, generator=np.random.default_rng(1), levels=levels)
    assert np.array_equal(drawn[:, 0], drawn[:, 1])


def test_unequal_numbers_of_replicates_are_weighed_by_their_number():
    generator = np.random.default_rng(4)
    values = np.full((12, 40), np.nan)
    values[:, :4] = generator.lognormal(1.0, 0.5, (12, 4))
    values[0] = generator.lognormal(2.0, 0.5, 40)
    (drawn,) = posterior_means(
        [ObservedRows(values=values, is_proportion=False)], draws=1_000, generator=np.random.default_rng(1)
    )
    assert drawn[:, 0].mean() == pytest.approx(values[0].mean(), rel=0.1)
    assert np.log(drawn).std(axis=0)[0] < np.log(drawn).std(axis=0)[1:].min()
