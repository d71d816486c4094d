from __future__ import annotations

import numpy as np
import pytest

from rgss.tradeoff.problem import ObservedRows, posterior_means
from rgss.tradeoff.problem.posterior import alike_groups


def draws_of(*observed: ObservedRows, seed: int = 1, draws: int = 4_000):
    return posterior_means(observed, draws=draws, generator=np.random.default_rng(seed))


def proportion(rows) -> ObservedRows:
    return ObservedRows(values=np.array(rows, dtype=float), is_proportion=True)


def mean(rows) -> ObservedRows:
    return ObservedRows(values=np.array(rows, dtype=float), is_proportion=False)


def test_nothing_observed_has_no_draws():
    assert draws_of() == []


def test_draws_of_a_proportion_with_many_trials_lie_about_its_share():
    (drawn,) = draws_of(proportion([np.repeat([1.0, 0.0], [180, 20]), np.repeat([1.0, 0.0], [60, 140])]))
    assert drawn.mean(axis=0) == pytest.approx([0.9, 0.3], abs=0.01)
    # The standard deviation of a beta distribution of these counts.
    assert drawn.std(axis=0) == pytest.approx(np.sqrt([0.9 * 0.1 / 201, 0.3 * 0.7 / 201]), rel=0.1)


def test_a_proportion_borrows_from_the_population():
    """Three successes say more where all designs succeed than where most fail."""
    good, bad = [[1.0] * 3] * 20, [[0.0] * 3] * 19
    (among_good,) = draws_of(proportion(good))
    (among_bad,) = draws_of(proportion([*bad, [1.0] * 3]))
    assert among_good[:, -1].mean() > among_bad[:, -1].mean() + 0.03


def test_alternatives_whose_trials_are_the_same_have_the_same_draws():
    successes, times = [[1.0, 1.0, 0.0, 1.0]] * 2, [[3.0, 4.0, np.nan, 5.0]] * 2
    share, time = draws_of(proportion(successes), mean(times))
    assert np.array_equal(time[:, 0], time[:, 1])
    # What no seed told apart may differ in seeds to come, but hardly.
    assert share[:, 0].mean() == pytest.approx(share[:, 1].mean(), abs=0.01)
    assert 0.0 < np.abs(share[:, 0] - share[:, 1]).mean() < 0.5 * share[:, 0].std()


def test_what_no_seed_told_apart_differs_the_less_the_more_seeds_there_are():
    def apart(seeds):
        (drawn,) = draws_of(proportion([[1.0] * seeds] * 2))
        return drawn

    def difference(seeds):
        times = np.arange(1.0, seeds + 1.0).tolist()
        drawn, _ = draws_of(proportion([[1.0, 0.0] * (seeds // 2)] * 2), mean([times] * 2))
        return float((drawn[:, 0] - drawn[:, 1]).std())

    assert difference(40) < 0.6 * difference(10)
    # Without a mean that is the same they are not alike at all.
    assert float((apart(10)[:, 0] - apart(10)[:, 1]).std()) > difference(10)


def test_proportions_that_are_equal_by_chance_make_no_group():
    assert alike_groups([proportion([[1.0, 1.0]] * 2)]).tolist() == [0, 1]
    assert alike_groups([proportion([[1.0, 1.0]] * 2), mean([[3.0, 4.0], [3.0, 5.0]])]).tolist() == [0, 1]


def test_designs_that_share_their_noise_keep_their_order():
    generator = np.random.default_rng(3)
    noise = generator.lognormal(sigma=0.5, size=5)
    (drawn,) = draws_of(mean([10.0 * noise, 11.0 * noise]))
    assert (drawn[:, 0] < drawn[:, 1]).mean() > 0.95


def test_noise_that_a_design_does_not_show_yet_is_that_of_the_others():
    generator = np.random.default_rng(4)
    rows = [10.0 * generator.lognormal(sigma=0.5, size=4) for _ in range(30)]
    (drawn,) = draws_of(mean([[10.0] * 4, *rows]))
    assert drawn[:, 0].std() > 0.3


def test_an_alternative_without_a_value_stays_unknown():
    (drawn,) = draws_of(mean([[np.nan, np.nan], [1.0, 2.0]]))
    assert np.isnan(drawn[:, 0]).all()
    assert np.isfinite(drawn[:, 1]).all()


def test_values_of_both_signs_are_drawn_as_differences():
    (drawn,) = draws_of(mean([[-1.0, 1.0, 0.5, -0.5], [9.0, 11.0, 10.5, 9.5]]))
    assert drawn.mean(axis=0) == pytest.approx([0.0, 10.0], abs=0.5)


def test_the_same_generator_gives_the_same_draws():
    rows = mean(np.random.default_rng(5).lognormal(size=(3, 4)))
    assert np.array_equal(draws_of(rows, draws=50)[0], draws_of(rows, draws=50)[0])


@pytest.mark.parametrize("sigma", [0.2, 1.0])
def test_intervals_of_means_cover_the_truth_over_a_population(sigma):
    """Nine of ten of the middle 90 % of draws, over 60 populations of 12 designs with 6 replicates."""
    covered = []
    for run in range(60):
        generator = np.random.default_rng([run, 9])
        truth = generator.uniform(8.0, 14.0, 12)
        rows = truth[:, None] * generator.lognormal(-(sigma**2) / 2.0, sigma, (12, 6))
        (drawn,) = draws_of(mean(rows), seed=run, draws=400)
        low, high = np.quantile(drawn, [0.05, 0.95], axis=0)
        covered.append(((low <= truth) & (truth <= high)).mean())
    assert 0.84 <= np.mean(covered) <= 0.97


def test_luck_that_all_share_draws_the_best_less_to_the_population():
    # The same successes, once nested seed by seed and once in seeds of their own.
    nested = np.array([[1.0] * won + [0.0] * (16 - won) for won in range(4, 16)])
    generator = np.random.default_rng(5)
    apart = np.array([generator.permutation(row) for row in nested])

    def best(values):
        rows = [ObservedRows(values=values, is_proportion=True)]
        (found,) = posterior_means(rows, draws=4_000, generator=np.random.default_rng(6))
        return float(found[:, -1].mean())

    assert best(apart) + 0.02 < best(nested) < 15 / 16
