"""Posterior probability that the choice is right, given the replicates."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.robustness import DRAWS, PosteriorOutcomes, good_selection
from rgss.tradeoff.sequential.evidence import SequentialEvidence

_TIE = 1e-9

LOSS_DRAWS = 2_000
"""Draws for the allocation of replicates, which looks for the rare ones in which the choice is lost."""


def probability_of_good_selection(
    evidence: SequentialEvidence,
    chosen: int | None,
    *,
    margin: float,
    seed: int,
    draws: int | None = None,
) -> float:
    """Posterior probability of good selection: no feasible alternative is better than the choice by the margin.

    It is `rgss.tradeoff.robustness.good_selection` with the draws of the analysis of a decision with the same evidence,
    seed and margin, so that a sweep that ends by it and the decision state the same figure.

    Args:
        evidence: The evidence.
        chosen: The choice; None for the claim that nothing is feasible.
        margin: The practically irrelevant difference of value.
        seed: Seed of the draws.
        draws: Number of draws; that of a decision by default.

    Returns:
        The share of the draws in which the choice is feasible, within the tolerance, and good, or nothing is.
    """
    row = None if chosen is None else evidence.table.row_of(chosen)
    found = _posterior(evidence, seed=seed, draws=draws)
    return good_selection(found.totals, found.outcomes.feasible, row, margin)


def probabilities_of_loss(
    evidence: SequentialEvidence, chosen: int | None, *, margin: float, seed: int
) -> NDArray[np.float64]:
    """Posterior probability that each alternative is the best while the choice is not good, shape (n,).

    The choice is good if it is feasible and within the margin of the best; alternatives tied with it in every draw have
    probability 0. Equal best alternatives share a draw evenly.

    Args:
        evidence: The evidence.
        chosen: The choice; None if nothing is feasible by the estimates, which is never good.
        margin: The practically irrelevant difference of value.
        seed: Seed of the draws.
    """
    found = _posterior(evidence, seed=seed, draws=LOSS_DRAWS)
    feasible = found.outcomes.feasible
    worth = np.where(feasible, np.nan_to_num(found.totals), -np.inf)
    highest = worth.max(axis=1, keepdims=True)
    lost: NDArray[np.bool_] = np.asarray(feasible.any(axis=1))
    if chosen is not None:
        row = evidence.table.row_of(chosen)
        lost = lost & ~(feasible[:, row] & (worth[:, row] >= highest[:, 0] - margin))
    first = (worth >= highest - _TIE) & lost[:, None]
    return np.asarray((first / np.maximum(first.sum(axis=1, keepdims=True), 1)).mean(axis=0), dtype=np.float64)


def _posterior(evidence: SequentialEvidence, *, seed: int, draws: int | None = None) -> PosteriorOutcomes:
    return PosteriorOutcomes.of(
        evidence.tolerant_problem,
        evidence.table,
        evidence.proportions,
        generator=np.random.default_rng(seed),
        levels=evidence.levels,
        draws=DRAWS if draws is None else draws,
    )
