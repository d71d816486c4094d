"""The statistics of the guard beside other hands: SciPy, statsmodels, and enumeration."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from statsmodels.stats.contingency_tables import mcnemar
from statsmodels.stats.multitest import multipletests

from rgss.errors import DefinitionError
from rgss.regression.error_rates import holm_adjusted, level_of_look
from rgss.regression.mcnemar import critical_worsenings, discordance_p_value, worsening_below
from rgss.regression.paired import DRAWS, PairedMean


@cache
def _mid_p(worse, better):
    if worse + better == 0:
        return 1.0
    law = stats.binom(worse + better, 0.5)
    return law.sf(worse) + 0.5 * law.pmf(worse)


@settings(max_examples=40, deadline=None)
@given(worse=st.integers(0, 9), better=st.integers(0, 9), equal=st.integers(0, 9))
def test_the_p_value_is_the_greatest_probability_of_what_is_as_extreme(worse, better, equal):
    """Each outcome of the seeds by itself, at many probabilities of a discordant one."""
    seeds = worse + better + equal
    ours = discordance_p_value(worse, better, seeds)
    if worse + better == 0:
        assert ours == 1.0
        return
    outcomes = [(b, c) for b in range(seeds + 1) for c in range(seeds + 1 - b)]
    extreme = [(b, c) for b, c in outcomes if _mid_p(b, c) <= _mid_p(worse, better) * (1 + 1e-9)]
    rows = np.array([(b, c, seeds - b - c) for b, c in extreme])
    rates = np.linspace(0.01, 1, 100)[:, None]
    chances = np.stack([rates / 2, rates / 2, 1 - rates], axis=-1)
    greatest = stats.multinomial.pmf(rows, seeds, chances).sum(axis=1).max()
    assert ours == pytest.approx(greatest, abs=2e-4)
    assert ours >= greatest - 1e-9


@given(worse=st.integers(0, 30), better=st.integers(0, 30), equal=st.integers(0, 30))
def test_it_rejects_at_least_where_twice_mcnemars_exact_test_does(worse, better, equal):
    # The published test is two-sided: twice the smaller tail.
    theirs = mcnemar([[equal, better], [worse, 0]], exact=True).pvalue if worse + better else 1.0
    ours = discordance_p_value(worse, better, worse + better + equal)
    assert 0.0 < ours <= 1.0
    if worse > better:
        assert ours <= theirs + 1e-9


@pytest.mark.parametrize("seeds", [4, 12, 16, 40, 64])
@pytest.mark.parametrize("level", [0.05, 0.0075, 0.001])
def test_the_test_of_success_keeps_its_level_whatever_share_of_seeds_differs(seeds, level):
    """Exact size by enumeration: no probability of a discordant seed makes it exceed the level."""
    rejected = [
        (b, c) for b in range(seeds + 1) for c in range(seeds + 1 - b) if discordance_p_value(b, c, seeds) <= level
    ]
    critical = critical_worsenings(seeds, level)
    assert {(b, c) for b, c in rejected} == {
        (b, d - b) for d in range(seeds + 1) for b in range(int(critical[d]), d + 1)
    }
    rows = np.array([(b, c, seeds - b - c) for b, c in rejected])
    sizes = [
        stats.multinomial.pmf(rows, seeds, [rate / 2, rate / 2, 1 - rate]).sum() if len(rows) else 0.0
        for rate in np.linspace(0.003, 1, 150)
    ]
    assert max(sizes) <= level * 1.001
    # It uses most of what the conditional test leaves unused.
    if seeds >= 16 and level == 0.05:
        assert max(sizes) > 0.04


@given(worse=st.integers(0, 40), more=st.integers(0, 40), margin=st.floats(0.01, 0.99))
def test_few_worsenings_are_the_lower_tail_of_a_binomial(worse, more, margin):
    ours = worsening_below(worse, worse + more, margin)
    assert ours == pytest.approx(stats.binom.cdf(worse, worse + more, margin), rel=1e-9)


@pytest.mark.parametrize("margin", [0.0, 1.0, -0.1, math.nan])
def test_the_margin_of_a_success_is_a_share(margin):
    with pytest.raises(DefinitionError, match=r"the margin of a success is .*\(give a share between 0 and 1"):
        worsening_below(0, 3, margin)


# The other hand collects garbage on every call.
@settings(max_examples=15)
@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=30))
def test_holm_is_that_of_statsmodels(p_values):
    assert holm_adjusted(p_values) == pytest.approx(multipletests(p_values, method="holm")[1].tolist(), abs=1e-15)


@given(st.lists(st.tuples(st.floats(0.0, 1.0), st.integers(1, 5)), min_size=1, max_size=12), st.floats(0.01, 0.2))
def test_weighted_holm_is_the_closure_of_weighted_bonferroni(pairs, level):
    """A hypothesis is rejected where every intersection that holds it is, by weighted Bonferroni."""
    p_values, weights = zip(*pairs, strict=True)
    adjusted = holm_adjusted(p_values, weights)
    # Step down by hand: reject the least p/w while p <= w / (what is left) * level.
    left, rejected = set(range(len(p_values))), set()
    while left:
        least = min(left, key=lambda place: p_values[place] / weights[place])
        if p_values[least] > weights[least] / sum(weights[place] for place in left) * level:
            break
        rejected.add(least)
        left.remove(least)
    for place, value in enumerate(adjusted):
        if abs(value - level) > 1e-12:
            assert (value <= level) == (place in rejected)


def test_a_comparison_without_weight_is_never_rejected_and_costs_nothing():
    assert holm_adjusted([0.0, 0.01, 0.02], [0.0, 1.0, 1.0]) == (1.0, 0.02, 0.02)


def test_nothing_to_adjust_is_nothing():
    assert holm_adjusted([]) == ()


@given(looks=st.integers(1, 20), level=st.floats(0.001, 0.4))
def test_looks_spend_the_error_rate_and_no_more(looks, level):
    parts = [level_of_look(look, looks, level) for look in range(1, looks + 1)]
    assert math.fsum(parts) == pytest.approx(level, rel=1e-12)
    assert parts == sorted(parts)
    assert min(parts) > 0.0


def test_a_claim_needs_both_the_bootstrap_and_student():
    differences = np.random.default_rng(3).exponential(size=14)
    mean_of = PairedMean(differences, margin=0.1)
    for limit in np.quantile(differences, [0.3, 0.5, 0.8]):
        student = stats.ttest_1samp(differences, limit, alternative="greater").pvalue
        drawn = np.random.default_rng(4).choice(differences, size=(200_000, 14)).mean(axis=1)
        assert mean_of.above(limit) >= student * (1.0 - 1e-12)
        assert mean_of.above(limit) == pytest.approx(max(student, float(np.mean(drawn <= limit))), abs=0.01)
        assert mean_of.below(limit) == pytest.approx(PairedMean(-differences, margin=0.1).above(-limit), abs=1e-12)


def test_the_interval_holds_both_intervals():
    differences = np.random.default_rng(5).lognormal(size=10)
    low, high = PairedMean(differences, margin=1.0).interval()
    student = stats.ttest_1samp(differences, 0.0).confidence_interval(0.95)
    drawn = stats.bootstrap((differences,), np.mean, method="percentile", n_resamples=50_000, rng=6)
    assert low <= student.low + 1e-12
    assert high >= student.high - 1e-12
    assert low <= drawn.confidence_interval.low + 0.02
    assert high >= drawn.confidence_interval.high - 0.02


def test_equal_differences_prove_much_but_not_everything():
    few, more = (PairedMean(np.full(count, 2.0), margin=1.0).above(1.0) for count in (2, 6))
    assert 1.0 / (DRAWS + 1) <= more < few < 0.01
    assert PairedMean(np.zeros(3), margin=1.0).below(1.0) < 0.001
    assert PairedMean(np.full(3, 1.0), margin=1.0).below(1.0) > 0.4


def test_one_seed_tells_nothing():
    with pytest.raises(DefinitionError, match=r"one seed shows nothing of noise \(compare at least two\)"):
        PairedMean(np.ones(1), margin=1.0)


def test_the_same_differences_give_the_same_p_value():
    differences = np.random.default_rng(7).normal(size=9)
    assert PairedMean(differences, margin=1.0).above(0.3) == PairedMean(differences.copy(), margin=1.0).above(0.3)
