"""Memory of draws and resamples: it does not grow with draws times alternatives, and blocks change no bit."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from rgss.tradeoff import Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.problem.evidence_table import EvidenceTable, Samples
from rgss.tradeoff.problem.resampling import bootstrap
from rgss.tradeoff.robustness import posterior_outcomes
from rgss.tradeoff.robustness.acceptability import Outcomes
from rgss.tradeoff.robustness.effects import factorial_effects
from rgss.tradeoff.robustness.outcomes import admitted_weights
from rgss.tradeoff.robustness.posterior_outcomes import PosteriorOutcomes

MEASURES = ("a", "b", "c")
MEGABYTE = 1_000_000


def posterior_of(count, draws):
    """Random draws of three measures; the last alternative has none of the first."""
    rng = np.random.default_rng(2)
    drawn = {measure: rng.random((draws, count)) for measure in MEASURES}
    drawn["a"][:, -1] = np.nan
    ran = np.ones((count, 2), dtype=bool)
    table = EvidenceTable(
        variants=np.arange(1, count + 1),
        measures=MEASURES,
        quantities=np.stack([drawn[measure].mean(axis=0) for measure in MEASURES], axis=1),
        samples={measure: Samples(values=drawn[measure][:2].T, ran=ran) for measure in MEASURES},
    )
    problem = TradeProblem(
        alternatives=table,
        thresholds=(Threshold(requirement="R-1", measure="a", comparison=Comparison.AT_LEAST, value=0.2, unit="1"),),
        value_functions=tuple(PiecewiseValue(measure=measure, worst=-1.0, best=2.0) for measure in MEASURES),
        weighting=Weighting(weights={"a": 0.5, "b": 0.3, "c": 0.2}),
    )
    outcomes = Outcomes(
        values=np.broadcast_to(0.5, (draws, count, len(MEASURES))),
        feasible=np.broadcast_to(np.True_, (draws, count)),
        probabilities=np.full(draws, 1.0 / draws),
        exact=False,
    )
    picks = np.zeros((draws, 0), dtype=np.int64)
    return PosteriorOutcomes(
        preferences=problem, table=table, drawn=drawn, outcomes=outcomes, picks=picks, proportions=frozenset()
    )


def peak_of(computed):
    tracemalloc.start()
    try:
        result = computed()
        return result, tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def first_errors(posterior):
    return posterior.first_errors(admitted_weights(posterior.preferences), np.random.default_rng(5))


def test_errors_of_first_ranks_take_no_more_memory_for_more_alternatives(monkeypatch):
    monkeypatch.setattr(posterior_outcomes, "_STUDIES", 2)
    peaks = []
    for count in (1_500, 5_000):
        posterior = posterior_of(count, 64)
        peaks.append(peak_of(lambda posterior=posterior: first_errors(posterior))[1])
    # All values of a study of the larger size are 60 MB.
    assert peaks[1] - peaks[0] < 3 * MEGABYTE
    assert max(peaks) < 40 * MEGABYTE


@pytest.mark.parametrize("at_once", [1, 7 * 40 * 3, 10**9])
def test_blocks_of_another_study_are_the_bits_of_the_whole(monkeypatch, at_once):
    posterior = posterior_of(40, 90)
    expected = first_errors(posterior)
    monkeypatch.setattr(posterior_outcomes, "_VALUES_AT_ONCE", at_once)
    assert first_errors(posterior).tobytes() == expected.tobytes()
    assert expected[:-1].min() >= 0.0
    assert expected.max() > 0.0
    assert expected[-1] == 0.0


@pytest.mark.parametrize("unknown", [False, True])
def test_means_of_resamples_take_less_than_twice_their_own_memory(unknown):
    resamples = bootstrap(10, draws=400, generator=np.random.default_rng(1))
    replicates = np.random.default_rng(6).random((2_000, 10))
    if unknown:
        replicates[::7, :4] = np.nan
        replicates[11] = np.nan
    means, peak = peak_of(lambda: resamples.means(replicates))
    assert peak < 1.9 * means.nbytes
    expected = [
        np.nansum(counts * replicates, axis=1) / (counts * ~np.isnan(replicates)).sum(axis=1).clip(0.5)
        for counts in resamples.counts
    ]
    assert np.isnan(means[:, 11]).all() == unknown
    np.testing.assert_allclose(np.nan_to_num(means), expected, rtol=1e-12)


class Resampled:
    """Means of designs that are made when they are read."""

    def __init__(self, shape, number):
        self.shape, self.number, self.largest = shape, number, 0

    def __len__(self):
        return self.number

    def __getitem__(self, some):
        rows = range(self.number)[some]
        self.largest = max(self.largest, len(rows))
        return np.array([np.random.default_rng(row).random(self.shape) for row in rows])


def test_effects_are_split_block_by_block(monkeypatch):
    estimates = np.random.default_rng(7).random((4, 3, 5))
    source = Resampled(estimates.shape, 50)
    probabilities = np.full(50, 1 / 50)
    whole = factorial_effects(estimates, "abc", resampled=source[:], probabilities=probabilities)
    source.largest = 0
    monkeypatch.setattr("rgss.tradeoff.robustness.effects.MOST_AT_ONCE", 7 * 60)
    parted = factorial_effects(estimates, "abc", resampled=source, probabilities=probabilities)

    assert source.largest == 7
    for one, other in zip(whole.effects, parted.effects, strict=True):
        assert (one.low.tobytes(), one.high.tobytes()) == (other.low.tobytes(), other.high.tobytes())
        assert (one.share_low, one.share_high) == (other.share_low, other.share_high)
