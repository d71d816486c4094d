"""Expected gain of value by more replicates: a preposterior analysis of the rule that chooses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import TIE_TOLERANCE, Array, ObservedRows, further_shifts
from rgss.tradeoff.robustness.drawn_values import evaluated
from rgss.tradeoff.robustness.posterior_outcomes import FEWEST_DRAWS, PosteriorOutcomes, is_end, known_values

_MOST_VALUES = 1_000_000
"""Values of alternatives that are made at a time, 8 MB."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ReplicationGains:
    """Expected gain of value by more evidence, over the value of the choice.

    Attributes:
        of_more: Numbers of more replicates of every alternative, each with the gain of who chooses again with them.
        perfect: Gain by perfect knowledge.
    """

    of_more: tuple[tuple[int, float], ...]
    perfect: float


NO_GAINS = ReplicationGains(of_more=(), perfect=0.0)
"""Gains that were not computed."""


def _worth(found: PosteriorOutcomes) -> Array:
    """Value of each alternative in each draw, shape (b, n): what is infeasible is worth nothing."""
    return np.where(found.outcomes.feasible, np.nan_to_num(found.totals), 0.0)


def replication_gains(
    found: PosteriorOutcomes, chosen: int, *, generator: np.random.Generator, more: tuple[int, ...] = (1, 10)
) -> ReplicationGains:
    """Expected gains of choosing again with more replicates of every alternative.

    Each posterior draw is taken for the truth in turn; further replicates are drawn from it, added to the evidence, and
    the rule of the choice is applied to the new estimates: the highest value among those that are feasible. The gain is
    the mean difference of what the new choice and the present one are worth by the truth (Raiffa and Schlaifer,
    *Applied Statistical Decision Theory*, 1961). A gain below zero, where estimates of few replicates mislead, is
    stated as zero.

    Args:
        found: Posterior draws of the evidence.
        chosen: Row of the choice.
        generator: Source of randomness.
        more: Numbers of more replicates that are valued.
    """
    worth = _worth(found)
    present = float(worth[:, chosen].mean())
    seed = int(generator.integers(2**32))
    gains = []
    for count in more:
        # The same numbers for each count, so that the counts differ by what they are.
        expected = _worth_of_new_choices(found, worth, chosen, count, np.random.default_rng(seed))
        gains.append((count, max(0.0, expected)))
    return ReplicationGains(
        of_more=tuple(gains), perfect=max(0.0, float(worth.max(axis=1, initial=0.0).mean()) - present)
    )


def _worth_of_new_choices(
    found: PosteriorOutcomes, worth: Array, chosen: int, count: int, generator: np.random.Generator
) -> float:
    """Mean gain of value by the choices after so many more replicates."""
    draws = min(len(worth), max(FEWEST_DRAWS, _MOST_VALUES // max(1, found.outcomes.values.shape[1])))
    estimates, picks = _new_estimates(found, draws, count, generator)
    values, feasible = evaluated(found.preferences, found.table, estimates, picks)
    weighting = found.preferences.weighting
    weights = np.array([weighting.weights[measure] for measure in weighting.deciding_measures])
    totals = np.where(feasible, np.nan_to_num(values @ weights), -np.inf)
    best = feasible & (totals >= totals.max(axis=1, keepdims=True) - TIE_TOLERANCE)
    worth = worth[:draws]
    of_best = np.where(best, worth, 0.0).sum(axis=1) / np.maximum(best.sum(axis=1), 1)
    # Of equals the present choice is kept.
    return float(np.where(best[:, chosen], 0.0, of_best - worth[:, chosen]).mean())


def _new_estimates(
    found: PosteriorOutcomes, draws: int, count: int, generator: np.random.Generator
) -> tuple[dict[str, Array], NDArray[np.int64]]:
    """Estimates after so many more replicates, and the replicates for conditions on them, by draws of the truth."""
    table = found.table
    observed = [measure for measure in found.drawn if not is_end(measure, table)]
    rows = [
        ObservedRows(values=known_values(table.samples[measure]), is_proportion=measure in found.proportions)
        for measure in observed
    ]
    truths = [found.drawn[measure][:draws] for measure in observed]
    added = []
    for measure, one in zip(observed, rows, strict=True):
        known = (~np.isnan(one.values)).sum(axis=1)
        added.append(count * known / np.maximum(table.samples[measure].ran.sum(axis=1), 1))
    shifts = dict(zip(observed, further_shifts(rows, truths, added, generator=generator), strict=True))
    estimates = {
        measure: table.column(measure) + shifts[measure.rpartition(".")[0] if is_end(measure, table) else measure]
        for measure in found.drawn
    }
    size = found.picks.shape[1]
    if not size:
        return estimates, found.picks[:draws]
    later = generator.integers(0, size, size=(draws, count))
    again = np.take_along_axis(found.picks[:draws], later, axis=1)
    return estimates, np.hstack([np.tile(np.arange(size), (draws, 1)), again])
