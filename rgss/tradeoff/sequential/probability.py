"""Posterior probability that the choice is right, given the replicates."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.sequential.evidence import Observed, SequentialEvidence

DRAWS = 2_000
"""So often the evidence is drawn anew."""


def probability_of_good_selection(
    evidence: SequentialEvidence, chosen: int | None, *, margin: float, seed: int, draws: int = DRAWS
) -> float:
    """The posterior probability that nothing feasible is worth more than the choice by the margin.

    The Bayesian bootstrap (Rubin, 1981): every seed gets a random weight, the same for all
    alternatives, so that what their trials have in common stays so. A proportion gets half a success
    and half a failure more, as Jeffreys's prior does, so that no failure seen is not no failure ever;
    alternatives none of whose replicates differ share these two.

    Args:
        evidence: The evidence.
        chosen: The choice; None that there is nothing feasible.
        margin: The difference of value that is practically none.
        seed: Seed of the draws.
        draws: How many.

    Returns:
        The share of the draws in which the choice is feasible and good, or nothing is feasible.
    """
    most = int(evidence.replicates.max(initial=0))
    generator = np.random.default_rng(seed)
    weights = generator.standard_gamma(1.0, size=(draws, most))
    groups = _groups(evidence)
    values = np.tile(evidence.fixed_value, (draws, 1))
    feasible = np.tile(evidence.fixed_met, (draws, 1))
    for one in evidence.observed:
        drawn = _drawn(one, weights, groups, generator)
        known = ~np.isnan(drawn)
        if one.function is not None:
            worth = one.function.values_at(np.where(known, drawn, 0.0))
            values += np.where(known, one.weight * worth, np.nan)
        for threshold in one.thresholds.values():
            margins = threshold.comparison.margin(1.0, 0.0) * (drawn - threshold.value)
            feasible &= known & (margins >= -1e-12)
    feasible &= ~np.isnan(values)
    if chosen is None:
        return float(np.mean(~feasible.any(axis=1)))
    row = evidence.table.row_of(chosen)
    best = np.where(feasible, values, -np.inf).max(axis=1)
    return float(np.mean(feasible[:, row] & (values[:, row] >= best - margin)))


def _drawn(
    one: Observed, weights: NDArray[np.float64], groups: NDArray[np.intp], generator: np.random.Generator
) -> NDArray[np.float64]:
    """The measure of every alternative in every draw, shape (draws, n); NaN where it is unknown."""
    known = ~np.isnan(one.values)
    used = weights[:, : one.values.shape[1]]
    total = used @ np.where(known, one.values, 0.0).T
    weight = used @ known.T.astype(np.float64)
    if one.is_proportion:
        extra = generator.standard_gamma(0.5, size=(2, len(weights), int(groups.max(initial=0)) + 1))
        total = total + extra[0][:, groups]
        weight = weight + extra.sum(axis=0)[:, groups]
    drawn: NDArray[np.float64] = np.divide(total, weight, out=np.full_like(total, np.nan), where=weight > 0.0)
    return drawn


def _groups(evidence: SequentialEvidence) -> NDArray[np.intp]:
    """The group of each alternative: those that no replicate of a proportion, and not every mean, tells apart."""
    count = len(evidence.table)
    groups = np.arange(count)
    for row in range(count):
        for first in range(row):
            if groups[first] == first and _alike(evidence, first, row):
                groups[row] = first
                break
    return groups


def _alike(evidence: SequentialEvidence, row: int, other: int) -> bool:
    shared = int(min(evidence.replicates[row], evidence.replicates[other]))
    same = {
        one.measure: np.array_equal(one.values[row, :shared], one.values[other, :shared], equal_nan=True)
        for one in evidence.observed
    }
    means = [one.measure for one in evidence.observed if not one.is_proportion]
    return all(same[one.measure] for one in evidence.observed if one.is_proportion) and any(
        same[measure] for measure in means
    )
