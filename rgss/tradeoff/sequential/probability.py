"""Posterior probability that the choice is right, given the replicates."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import ObservedRows, posterior_means
from rgss.tradeoff.sequential.evidence import SequentialEvidence

_TIE = 1e-9

DRAWS = 2_000
"""So often the evidence is drawn anew."""


def probability_of_good_selection(
    evidence: SequentialEvidence,
    chosen: int | None,
    *,
    margin: float,
    seed: int,
    draws: int = DRAWS,
) -> float:
    """Posterior probability of good selection: no feasible alternative is better than the choice by the margin.

    The draws are those of `rgss.tradeoff.problem.posterior_means`: the alternatives are a population whose spread is
    estimated from them, factor by factor, noise is pooled, and the correlation of trials with the same seed is
    preserved.

    Args:
        evidence: The evidence.
        chosen: The choice; None for the claim that nothing is feasible.
        margin: The practically irrelevant difference of value.
        seed: Seed of the draws.
        draws: Number of draws.

    Returns:
        The share of the draws in which the choice is feasible, within the tolerance, and good, or nothing is.
    """
    values, feasible = _posterior(evidence, draws=draws, seed=seed)
    if chosen is None:
        return float(np.mean(~feasible.any(axis=1)))
    row = evidence.table.row_of(chosen)
    best = np.where(feasible, values, -np.inf).max(axis=1)
    return float(np.mean(feasible[:, row] & (values[:, row] >= best - margin)))


def probabilities_of_loss(
    evidence: SequentialEvidence, chosen: int | None, *, margin: float, seed: int, draws: int = DRAWS
) -> NDArray[np.float64]:
    """Posterior probability that each alternative is the best while the choice is not good, shape (n,).

    The choice is good if it is feasible and within the margin of the best; alternatives tied with it in every draw have
    probability 0. Equal best alternatives share a draw evenly.

    Args:
        evidence: The evidence.
        chosen: The choice; None if nothing is feasible by the estimates, which is never good.
        margin: The practically irrelevant difference of value.
        seed: Seed of the draws.
        draws: Number of draws.
    """
    values, feasible = _posterior(evidence, draws=draws, seed=seed)
    worth = np.where(feasible, values, -np.inf)
    highest = worth.max(axis=1, keepdims=True)
    lost: NDArray[np.bool_] = np.asarray(feasible.any(axis=1))
    if chosen is not None:
        row = evidence.table.row_of(chosen)
        lost = lost & ~(feasible[:, row] & (worth[:, row] >= highest[:, 0] - margin))
    first = (worth >= highest - _TIE) & lost[:, None]
    return np.asarray((first / np.maximum(first.sum(axis=1, keepdims=True), 1)).mean(axis=0), dtype=np.float64)


def _posterior(evidence: SequentialEvidence, *, draws: int, seed: int) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Values and feasibility of the alternatives in posterior draws, shape (draws, n) each."""
    rows = [ObservedRows(values=one.values, is_proportion=one.is_proportion) for one in evidence.observed]
    found = posterior_means(rows, draws=draws, generator=np.random.default_rng(seed), levels=evidence.levels)
    values = np.tile(evidence.fixed_value, (draws, 1))
    feasible = np.tile(evidence.fixed_met, (draws, 1))
    for one, drawn in zip(evidence.observed, found, strict=True):
        known = ~np.isnan(drawn)
        if one.function is not None:
            worth = one.function.values_at(np.where(known, drawn, 0.0).ravel()).reshape(drawn.shape)
            values += np.where(known, one.weight * worth, np.nan)
        for required in one.thresholds.values():
            threshold = required.tolerated(evidence.tolerance)
            margins = threshold.comparison.margin(1.0, 0.0) * (drawn - threshold.value)
            feasible &= known & (margins >= -1e-12)
    return values, feasible & ~np.isnan(values)
