"""Expected gain of more replicates, compared with closed forms and with a count over draws."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from rgss.tradeoff import ChanceBound, Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.problem.evidence_table import EvidenceTable, Samples
from rgss.tradeoff.robustness import PosteriorOutcomes, replication_gains
from rgss.tradeoff.robustness.drawn_values import evaluated

DRAWS = 100_000


def table_of(samples):
    """One measure with its replicates, shape (n, r)."""
    return EvidenceTable(
        variants=np.arange(1, len(samples) + 1),
        measures=("q",),
        quantities=np.nanmean(samples, axis=1)[:, None],
        samples={"q": Samples(values=samples, ran=np.ones(samples.shape, dtype=bool))},
    )


def problem_of(table, thresholds=(), risks=()):
    """Valued by q itself."""
    return TradeProblem(
        alternatives=table,
        thresholds=thresholds,
        risks=risks,
        value_functions=(PiecewiseValue(measure="q", worst=0.0, best=1.0),),
        weighting=Weighting(weights={"q": 1.0}),
    )


def posterior_of(problem, table, drawn, proportions=()):
    picks = np.random.default_rng(4).integers(0, table.samples["q"].values.shape[1], (len(drawn), 10))
    drawn = {"q": drawn}
    values, feasible = evaluated(problem, table, drawn, picks)
    found = PosteriorOutcomes.of(problem, table, proportions, generator=np.random.default_rng(1), draws=64)
    outcomes = type(found.outcomes)(
        values=values, feasible=feasible, probabilities=np.full(len(values), 1 / len(values)), exact=False
    )
    return PosteriorOutcomes(
        preferences=problem,
        table=table,
        drawn=drawn,
        outcomes=outcomes,
        picks=picks,
        proportions=frozenset(proportions),
    )


def gains_of(found, chosen, more):
    stated = replication_gains(found, chosen, generator=np.random.default_rng(7), more=more)
    return dict(stated.of_more), stated.perfect


def scaled(noise, mean, deviation):
    """Numbers with exactly this mean and this standard deviation."""
    noise = (noise - noise.mean()) / noise.std(ddof=1)
    return mean + deviation * noise


@pytest.mark.parametrize("more", [1, 5, 40])
@pytest.mark.parametrize("lead", [0.0, 0.01, 0.03])
def test_the_gain_of_two_normal_designs_is_that_of_the_closed_form(more, lead):
    """After m more the posterior mean of a difference has the variance s²/n - s²/(n + m)."""
    generator, count, deviation = np.random.default_rng(2), 64, 0.1
    # Of normal form, and without correlation.
    ordered = stats.norm.ppf((np.arange(count) + 0.5) / count)
    noise = np.array([ordered, np.concatenate([ordered[::2], ordered[1::2][::-1]])])
    noise[1] -= noise[0] * (noise[0] @ noise[1]) / (noise[0] @ noise[0])
    samples = np.array([scaled(noise[0], 0.5 + lead, deviation), scaled(noise[1], 0.5, deviation)])
    table = table_of(samples)
    truth = np.array([0.5 + lead, 0.5]) + deviation / math.sqrt(count) * generator.standard_normal((DRAWS, 2))
    found = posterior_of(problem_of(table), table, truth)

    gains, perfect = gains_of(found, 0, (more,))

    def expected(variance):
        spread = math.sqrt(variance)
        return spread * stats.norm.pdf(lead / spread) - lead * stats.norm.sf(lead / spread)

    both = 2.0 * deviation**2
    assert gains[more] == pytest.approx(expected(both / count - both / (count + more)), rel=0.06, abs=1e-4)
    assert perfect == pytest.approx(expected(both / count), rel=0.05)


def test_noise_that_two_designs_have_in_common_is_worth_no_replicate():
    generator = np.random.default_rng(3)
    noise = 0.1 * generator.standard_normal(8)
    table = table_of(np.array([0.55 + noise, 0.5 + noise]))
    truth = np.array([0.55, 0.5]) + 0.05 * generator.standard_normal((DRAWS, 1))
    gains, perfect = gains_of(posterior_of(problem_of(table), table, truth), 0, (1, 10))
    assert (gains, perfect) == ({1: 0.0, 10: 0.0}, 0.0)


def test_further_replicates_weigh_less_beside_what_the_other_designs_show():
    """Of designs that the population draws together a replicate tells less than one of as many as there were."""
    stated, by_moments = [], []
    for seed in (6, 7, 8):
        generator = np.random.default_rng(seed)
        table = table_of(0.5 + 0.1 * generator.standard_normal((30, 4)))
        found = PosteriorOutcomes.of(problem_of(table), table, (), generator=generator)
        stated.append(gains_of(found, int(np.argmax(table.column("q"))), (1,))[0][1])
        worth = found.outcomes.values[:, :, 0]
        narrowed = worth.mean(axis=0) + math.sqrt(1 / 5) * (worth - worth.mean(axis=0))
        by_moments.append(narrowed.max(axis=1).mean() - worth.mean(axis=0).max())
    assert 0.0 < sum(stated) < 0.85 * sum(by_moments)


def test_many_more_replicates_come_near_to_perfect_knowledge():
    generator = np.random.default_rng(8)
    table = table_of(np.clip(0.5 + 0.1 * generator.standard_normal((5, 6)), 0.0, 1.0))
    found = PosteriorOutcomes.of(problem_of(table), table, (), generator=generator)
    gains, perfect = gains_of(found, 0, (1, 10, 2_000))
    assert 0.0 < gains[1] < gains[10] < gains[2_000]
    assert gains[2_000] == pytest.approx(perfect, rel=0.1)


def test_a_design_that_misses_a_share_by_luck_is_gained_as_often_as_one_success_more_shows_it():
    """2 of 4 successes; 3 of 5 meet 0.6. One more is a success with θ, and right where θ is 0.6 or more."""
    samples = np.array([[1.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 1.0]])
    table = table_of(samples)
    limit = Threshold(requirement="R", measure="q", comparison=Comparison.AT_LEAST, value=0.6, unit="1")
    problem = TradeProblem(
        alternatives=EvidenceTable(
            variants=table.variants,
            measures=("q", "w"),
            quantities=np.column_stack([table.column("q"), [0.9, 0.4]]),
            samples=table.samples,
        ),
        thresholds=(limit,),
        value_functions=(PiecewiseValue(measure="w", worst=0.0, best=1.0),),
        weighting=Weighting(weights={"w": 1.0}),
    )
    generator = np.random.default_rng(9)
    truth = np.column_stack([generator.beta(2.5, 2.5, DRAWS), np.ones(DRAWS)])
    found = posterior_of(problem, problem.alternatives, truth, ("q",))
    gains, _ = gains_of(found, 1, (1,))
    theta = truth[:, 0]
    assert gains[1] == pytest.approx(
        max(0.0, np.mean(theta * np.where(theta >= 0.6, 0.9, 0.0) - theta * 0.4)), abs=0.01
    )


def test_what_more_replicates_would_spoil_is_stated_as_zero():
    """The rival is worth nothing by the draws, and may come to look better by a lucky replicate."""
    generator = np.random.default_rng(10)
    table = table_of(np.array([scaled(generator.standard_normal(3), 0.5, 0.001), [0.3, 0.9, 0.28]]))
    truth = np.column_stack([np.full(2_000, 0.5), np.full(2_000, 0.3)])
    gains, perfect = gains_of(posterior_of(problem_of(table), table, truth), 0, (1, 10))
    assert (gains, perfect) == ({1: 0.0, 10: 0.0}, 0.0)


def test_conditions_on_replicates_are_evaluated_on_the_further_ones_too():
    generator = np.random.default_rng(11)
    table = table_of(np.array([np.full(12, 0.5), generator.uniform(0.4, 0.9, 12)]))
    chance = ChanceBound(
        requirement="slow", measure="q", comparison=Comparison.AT_LEAST, value=0.45, probability=0.8, unit="1"
    )
    problem = problem_of(table, risks=(chance,))
    found = PosteriorOutcomes.of(problem, table, (), generator=generator)
    gains, perfect = gains_of(found, 0, (1, 50))
    assert 0.0 <= gains[1] <= gains[50] <= perfect


def test_a_design_without_a_known_value_takes_no_part():
    samples = np.array([[0.5, 0.6, 0.55], [0.5, 0.52, 0.7], [np.nan, np.nan, np.nan]])
    table = EvidenceTable(
        variants=np.arange(1, 4),
        measures=("q",),
        quantities=np.array([[0.55], [0.573], [np.nan]]),
        samples={"q": Samples(values=samples, ran=np.ones(samples.shape, dtype=bool))},
    )
    found = PosteriorOutcomes.of(problem_of(table), table, (), generator=np.random.default_rng(1))
    gains, perfect = gains_of(found, 1, (1, 10))
    assert 0.0 <= gains[1] <= gains[10] <= perfect < 1.0
