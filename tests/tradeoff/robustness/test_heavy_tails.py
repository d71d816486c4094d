"""Measures with rare great values are named while replicates are few, and others are not."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from rgss.tradeoff.robustness.heavy_tails import heavy_tailed_measures


def table(values):
    return SimpleNamespace(samples={"t": SimpleNamespace(values=values)})


def times(kind, generator, count=10):
    shape = (10, count)
    if kind == "outliers":
        return (1.0 + 0.1 * generator.standard_normal(shape)) * np.where(generator.random(shape) < 0.05, 10.0, 1.0)
    if kind == "exponential":
        return generator.exponential(size=shape)
    return 1.0 + 0.2 * generator.standard_normal(shape)


@pytest.mark.parametrize(
    ("kind", "least", "most"), [("outliers", 0.9, 1.0), ("exponential", 0.0, 0.05), ("", 0.0, 0.0)]
)
def test_outliers_are_named_and_common_scatter_is_not(kind, least, most):
    generator = np.random.default_rng(4)
    named = [bool(heavy_tailed_measures(table(times(kind, generator)), ["t"], np.array([10, 12]))) for _ in range(100)]

    assert least <= np.mean(named) <= most


def test_with_enough_replicates_of_all_that_are_tied_nothing_is_named():
    found = table(times("outliers", np.random.default_rng(1), count=40))

    assert heavy_tailed_measures(found, ["t", "of the design"], np.array([40, 29])) == ("t",)
    assert heavy_tailed_measures(found, ["t"], np.array([40, 30])) == ()


def test_missing_trials_and_equal_values_have_no_tail():
    values = np.full((3, 5), 2.0)
    values[1, 2:] = np.nan
    values[2] = np.nan

    assert heavy_tailed_measures(table(values), ["t"], np.array([2])) == ()
