"""Outcomes are made when they are read: bounded memory, and the same bits as of all at once."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest

from rgss.tradeoff import Comparison, PiecewiseValue, Threshold, TradeProblem, Weighting
from rgss.tradeoff.problem.evidence_table import EvidenceTable, Samples
from rgss.tradeoff.problem.resampling import bootstrap
from rgss.tradeoff.programs.columns import single_values
from rgss.tradeoff.programs.enumeration import violations
from rgss.tradeoff.robustness import resampled_outcomes
from rgss.tradeoff.robustness.acceptability import Outcomes, smaa2
from rgss.tradeoff.robustness.effects import factorial_effects
from rgss.tradeoff.robustness.resampled_outcomes import ResampledOutcomes, ResampledTables
from rgss.tradeoff.weights.weight_set import WeightSet

MEASURES = ("a", "b", "c")


def problem_of(number, replicates):
    rng = np.random.default_rng(4)
    values = {measure: rng.random((number, replicates)) for measure in MEASURES}
    for replicate_values in values.values():
        replicate_values[rng.random(replicate_values.shape) < 0.1] = np.nan
    ran = np.ones((number, replicates), dtype=bool)
    table = EvidenceTable(
        variants=np.arange(1, number + 1),
        measures=MEASURES,
        quantities=np.stack([np.nanmean(values[measure], axis=1) for measure in MEASURES], axis=1),
        samples={measure: Samples(values=values[measure], ran=ran) for measure in MEASURES},
    )
    return TradeProblem(
        alternatives=table,
        thresholds=(Threshold(requirement="R-1", measure="a", comparison=Comparison.AT_LEAST, value=0.4, unit="1"),),
        value_functions=tuple(PiecewiseValue(measure=measure, worst=-1.0, best=2.0) for measure in MEASURES),
        weighting=Weighting(weights={"a": 0.5, "b": 0.3, "c": 0.2}),
    )


def all_at_once(problem, resamples):
    """Every outcome in arrays, from means over all resamples in one product."""
    table = problem.alternatives
    values, feasible = [], []
    shifts = {
        measure: resamples.means(samples.values) - np.nanmean(samples.values, axis=1)
        for measure, samples in table.samples.items()
    }
    for place, counts in enumerate(resamples.counts):
        draw = np.repeat(np.arange(len(counts)), counts)
        quantities = table.quantities.copy()
        for measure, moved in shifts.items():
            quantities[:, table.measures.index(measure)] += moved[place]
        drawn = EvidenceTable(
            variants=table.variants,
            measures=table.measures,
            quantities=quantities,
            samples={
                measure: Samples(values=one.values[:, draw], ran=one.ran[:, draw])
                for measure, one in table.samples.items()
            },
        )
        values.append(single_values(problem, drawn))
        feasible.append(~violations(problem, drawn).any(axis=1))
    return Outcomes(
        values=np.array(values),
        feasible=np.array(feasible),
        probabilities=resamples.probabilities,
        exact=resamples.exact,
    )


def test_blocks_are_the_bits_of_the_whole(monkeypatch):
    problem = problem_of(300, 10)
    resamples = bootstrap(10, draws=200, generator=np.random.default_rng(1))
    monkeypatch.setattr(resampled_outcomes, "MOST_MEANS_AT_ONCE", 3 * 300 * 7)
    monkeypatch.setattr(resampled_outcomes, "MOST_KEPT", 0)
    whole, streamed = all_at_once(problem, resamples), ResampledOutcomes.of(problem, problem.alternatives, resamples)

    # Up to the summation of the mean, which the reference takes by nanmean.
    for outcome in range(200):
        values, feasible = streamed.at(outcome)
        assert values == pytest.approx(whole.values[outcome], abs=1e-14, nan_ok=True)
        assert (feasible == whole.feasible[outcome]).all()
    in_one = ResampledTables(problem.alternatives, resamples)
    in_one._at_once = 1_000
    assert ResampledTables(problem.alternatives, resamples)._at_once == 7
    for drawn, other in zip(ResampledTables(problem.alternatives, resamples), in_one, strict=True):
        assert drawn.quantities.tobytes() == other.quantities.tobytes()


def test_acceptability_does_not_depend_on_how_outcomes_are_read(monkeypatch):
    problem = problem_of(40, 10)
    resamples = bootstrap(10, draws=100, generator=np.random.default_rng(1))
    monkeypatch.setattr(resampled_outcomes, "MOST_KEPT", 0)
    streamed = ResampledOutcomes.of(problem, problem.alternatives, resamples)
    drawn = [streamed.at(outcome) for outcome in range(100)]
    arrays = Outcomes(
        values=np.array([values for values, _ in drawn]),
        feasible=np.array([feasible for _, feasible in drawn]),
        probabilities=streamed.probabilities,
        exact=False,
    )
    found, same = (
        smaa2(one, WeightSet.simplex(3), iterations=2_000, generator=np.random.default_rng(2))
        for one in (streamed, arrays)
    )

    assert found.ranks.tobytes() == same.ranks.tobytes()
    assert found.confidence.tobytes() == same.confidence.tobytes()


def test_acceptability_of_many_alternatives_takes_little_memory(monkeypatch):
    """2,000 alternatives in 200 outcomes: all their replicates together would be 95 MB."""
    problem = problem_of(2_000, 10)
    resamples = bootstrap(10, draws=200, generator=np.random.default_rng(1))
    monkeypatch.setattr(resampled_outcomes, "MOST_MEANS_AT_ONCE", 3 * 64 * 2_000)
    monkeypatch.setattr(resampled_outcomes, "MOST_KEPT", 0)
    monkeypatch.setattr("rgss.tradeoff.robustness.acceptability._RANKS_AT_ONCE", 100_000)
    tracemalloc.start()
    try:
        outcomes = ResampledOutcomes.of(problem, problem.alternatives, resamples)
        smaa2(outcomes, WeightSet.simplex(3), iterations=200, generator=np.random.default_rng(2))
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()

    assert peak < 20e6


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
