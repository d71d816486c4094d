"""Paired differences by joint sign flips: against SciPy, by hand, and how often luck is taken for more."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.stats import permutation_test

from rgss.regression.sign_flips import FEWEST_SEEDS, adjusted_p_values


@pytest.mark.parametrize("seeds", [2, 5, 9])
def test_one_difference_has_the_p_value_of_the_paired_permutation_test(seeds):
    rng = np.random.default_rng(seeds)
    for _ in range(20):
        row = rng.normal(0.5, 1.0, seeds)
        expected = permutation_test(
            (row,), lambda x: abs(x.mean()), permutation_type="samples", alternative="greater", n_resamples=np.inf
        )
        assert adjusted_p_values({"t": row.tolist()}) == {"t": pytest.approx(expected.pvalue)}


def test_what_has_one_sign_everywhere_is_as_rare_as_can_be():
    for seeds in range(2, 11):
        assert adjusted_p_values({"t": [0.3] * seeds}) == {"t": 2.0 ** (1 - seeds)}
    assert 2.0 ** (1 - FEWEST_SEEDS) < 0.05 < 2.0 ** (2 - FEWEST_SEEDS)


def test_what_is_the_same_everywhere_has_not_moved():
    assert adjusted_p_values({}) == {}
    assert adjusted_p_values({"a": [0.0] * 8, "b": [0.0] * 8}) == {"a": 1.0, "b": 1.0}
    assert adjusted_p_values({"a": [0.0] * 8, "b": [1.0] * 8})["a"] == 1.0


def test_many_seeds_are_drawn_and_the_draws_are_always_the_same():
    shifted = {"t": [1.0 + 0.1 * place for place in range(30)]}

    assert adjusted_p_values(shifted) == {"t": 1 / 4096}
    assert adjusted_p_values(shifted) == adjusted_p_values(shifted)


@pytest.mark.parametrize("seeds", [6, 8, 16])
def test_luck_is_taken_for_more_no_more_often_than_said(seeds):
    """40 observations a seed that share much of their luck, some of them seldom anything but zero."""
    rng = np.random.default_rng(11)
    false, found, runs = 0, 0, 400
    for _ in range(runs):
        shared = rng.normal(size=(seeds, 1))
        noise = shared + rng.normal(size=(seeds, 40))
        noise[:, 20:] = np.where(noise[:, 20:] > 2.0, 1.0, 0.0) - np.where(noise[:, 20:] < -2.0, 1.0, 0.0)
        rows = {str(item): noise[:, item].tolist() for item in range(40)}
        false += min(adjusted_p_values(rows).values()) <= 0.05
        rows["moved"] = (6.0 + noise[:, 0]).tolist()
        found += adjusted_p_values(rows)["moved"] <= 0.05
    # The bound is three standard deviations above the rate.
    assert false / runs <= 0.05 + 3 * (0.05 * 0.95 / runs) ** 0.5
    assert found / runs > 0.5
