"""The bootstrap of replicates, against enumeration of all ordered resamples."""

from __future__ import annotations

import itertools
from collections import Counter

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.problem.resampling import bootstrap, interval


@pytest.mark.parametrize("replicates", [2, 3, 5])
def test_few_replicates_are_enumerated(replicates):
    found = bootstrap(replicates, draws=10, generator=np.random.default_rng(0))
    ordered = Counter(
        tuple(np.bincount(draw, minlength=replicates))
        for draw in itertools.product(range(replicates), repeat=replicates)
    )

    assert found.exact
    assert {tuple(row): p for row, p in zip(found.counts, found.probabilities, strict=True)} == {
        row: pytest.approx(count / replicates**replicates) for row, count in ordered.items()
    }


def test_many_replicates_are_drawn():
    found = bootstrap(20, draws=500, generator=np.random.default_rng(0))

    assert not found.exact
    assert found.counts.shape == (500, 20)
    assert (found.counts.sum(axis=1) == 20).all()
    assert found.probabilities.sum() == pytest.approx(1.0)
    assert found.counts.mean(axis=0) == pytest.approx(np.ones(20), abs=0.2)


def test_means_pass_over_what_is_unknown():
    found = bootstrap(2, draws=1, generator=np.random.default_rng(0))
    means = found.means(np.array([[4.0, 8.0], [np.nan, 6.0]]))

    by_counts = {tuple(row): mean for row, mean in zip(found.counts, means, strict=True)}
    assert by_counts[1, 1] == pytest.approx([6.0, 6.0])
    assert by_counts[0, 2] == pytest.approx([8.0, 6.0])
    assert by_counts[2, 0][0] == 4.0
    assert np.isnan(by_counts[2, 0][1])


def test_what_replicates_share_stays_in_the_differences():
    """Two variants that differ by 1 in every replicate differ by 1 in every resample."""
    values = np.random.default_rng(1).normal(size=6)
    found = bootstrap(6, draws=1, generator=np.random.default_rng(0))
    first, second = found.means(np.array([values, values + 1.0])).T

    assert second - first == pytest.approx(np.ones(len(first)))


@pytest.mark.parametrize(("replicates", "word"), [(1, "1 replicate of each"), (0, "0 replicates of each")])
def test_too_few_replicates(replicates, word):
    with pytest.raises(TradeoffError) as caught:
        bootstrap(replicates, draws=10, generator=np.random.default_rng(0))
    assert str(caught.value) == (
        f"noise cannot be estimated from {word} variant (run 'rgss sweep' with at least 2 replicates)"
    )


def test_an_interval_counts_probability_and_not_rows():
    values = np.array([[3.0, 30.0], [1.0, 10.0], [2.0, 20.0]])
    low, high = interval(values, np.array([0.05, 0.05, 0.9]), confidence=0.8)

    assert low.tolist() == high.tolist() == [2.0, 20.0]
    low, high = interval(values, np.array([0.3, 0.3, 0.4]), confidence=0.8)
    assert (low.tolist(), high.tolist()) == ([1.0, 10.0], [3.0, 30.0])


def test_an_interval_of_equal_probabilities_is_the_inverted_distribution():
    values = np.random.default_rng(2).normal(size=400)
    low, high = interval(values, np.full(400, 1 / 400), confidence=0.95)

    assert [float(low), float(high)] == np.quantile(values, [0.025, 0.975], method="inverted_cdf").tolist()
