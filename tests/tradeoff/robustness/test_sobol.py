"""Sobol indices from a sample, against those of the whole design space."""

from __future__ import annotations

import numpy as np
import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff.robustness.effects import factorial_effects
from rgss.tradeoff.robustness.sobol import sobol_design, sobol_indices

TABLE = np.random.default_rng(0).normal(size=(2, 3, 4)) + np.array([0.0, 2.0])[:, None, None]


def measure_of(rows):
    return TABLE[tuple(rows.T)]


def test_a_sample_estimates_what_the_whole_space_has():
    generator = np.random.default_rng(1)
    found = sobol_indices(sobol_design(TABLE.shape, 4096, generator), measure_of, resamples=100, generator=generator)
    whole = factorial_effects(TABLE, list("abc"))

    assert found.first_order == pytest.approx(list(whole.first_order.values()), abs=0.05)
    assert found.total_order == pytest.approx(list(whole.total_order.values()), abs=0.05)
    for low, high, truth in (
        (found.first_low, found.first_high, whole.first_order),
        (found.total_low, found.total_high, whole.total_order),
    ):
        assert (low - 0.02 <= list(truth.values())).all()
        assert (high + 0.02 >= list(truth.values())).all()


def test_the_design_mixes_one_factor_at_a_time():
    design = sobol_design([2, 5, 3], 16, np.random.default_rng(2))

    assert design.rows().shape == (16 * 5, 3)
    for factor in range(3):
        others = [other for other in range(3) if other != factor]
        assert (design.mixed[factor][:, others] == design.first[:, others]).all()
        assert (design.mixed[factor][:, factor] == design.second[:, factor]).all()


def test_the_same_seed_gives_the_same_indices():
    def indices():
        generator = np.random.default_rng(3)
        return sobol_indices(sobol_design(TABLE.shape, 64, generator), measure_of, resamples=20, generator=generator)

    assert (indices().first_low == indices().first_low).all()


@pytest.mark.parametrize("samples", [8, 100])
def test_a_number_of_samples_that_will_not_do(samples):
    with pytest.raises(TradeoffError, match=rf"{samples} samples do not do for Sobol indices \(give a power of 2"):
        sobol_design([2, 2], samples, np.random.default_rng(0))


def test_designs_without_a_value():
    design = sobol_design([2, 2], 16, np.random.default_rng(0))

    with pytest.raises(TradeoffError, match="1 of 64 sampled designs have no value"):
        sobol_indices(
            design, lambda rows: np.array([np.nan, *rows[1:, 0]]), resamples=5, generator=np.random.default_rng(0)
        )
    with pytest.raises(TradeoffError, match="all sampled designs have the same value"):
        sobol_indices(design, lambda rows: np.ones(len(rows)), resamples=5, generator=np.random.default_rng(0))
