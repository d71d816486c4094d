"""The statistics of the guard beside other hands: SciPy, statsmodels, and enumeration."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy import stats
from statsmodels.stats.contingency_tables import mcnemar
from statsmodels.stats.multitest import multipletests

from rgss.errors import DefinitionError
from rgss.regression.error_rates import holm_adjusted, level_of_look
from rgss.regression.mcnemar import discordance_p_value, worsening_below
from rgss.regression.paired import DRAWS, PairedMean


@given(worse=st.integers(0, 30), better=st.integers(0, 30), equal=st.integers(0, 5))
def test_one_variant_is_mcnemars_exact_test(worse, better, equal):
    ours = discordance_p_value([1] * worse + [-1] * better + [0] * equal)
    if worse + better:
        assert ours == pytest.approx(stats.binomtest(worse, worse + better, alternative="greater").pvalue, rel=1e-12)
    else:
        assert ours == 1.0
    # The published test is two-sided: twice the smaller tail, and at most 1.
    both = min(1.0, 2.0 * min(ours, discordance_p_value([-1] * worse + [1] * better)))
    theirs = mcnemar([[equal, better], [worse, 0]], exact=True).pvalue
    assert both == pytest.approx(theirs, rel=1e-12)


@given(st.lists(st.integers(-4, 4), max_size=9))
def test_several_variants_are_every_assignment_of_signs(net):
    reached = [
        sum(sign * abs(each) for sign, each in zip(signs, net, strict=True)) >= sum(net)
        for signs in itertools.product((1, -1), repeat=len(net))
    ]
    assert discordance_p_value(net) == pytest.approx(sum(reached) / len(reached), rel=1e-12)


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
    with pytest.raises(DefinitionError, match=r"one seed tells nothing of noise \(compare at least two\)"):
        PairedMean(np.ones(1), margin=1.0)


def test_the_same_differences_give_the_same_p_value():
    differences = np.random.default_rng(7).normal(size=9)
    assert PairedMean(differences, margin=1.0).above(0.3) == PairedMean(differences.copy(), margin=1.0).above(0.3)
