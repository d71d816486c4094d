"""From a trade-off to the tables that the analyses of robustness take."""

from __future__ import annotations

import numpy as np

from rgss.tradeoff.infeasibility import resampled_tables
from rgss.tradeoff.problem import EvidenceTable, Mask, Resamples
from rgss.tradeoff.programs import Preferences, condition_column, keeps, single_values, violations
from rgss.tradeoff.robustness.acceptability import Outcomes
from rgss.tradeoff.weights import WeightSet


def admitted_weights(preferences: Preferences) -> WeightSet:
    """Admitted weights of the measures with a weight above 0.

    Raises:
        TradeoffError: The elicited bounds are inconsistent.
    """
    measures = preferences.weighting.deciding_measures
    rows, limits = preferences.weight_bounds.system(measures)
    return WeightSet.cut(rows, limits) if len(limits) else WeightSet.simplex(len(measures))


def condition_masks(preferences: Preferences, table: EvidenceTable) -> list[Mask]:
    """Masks of the alternatives that meet each of the conditions, in their order, shape (n,) each."""
    return [
        keeps(condition.sense, condition_column(condition, table), condition.limit)
        for condition in preferences.conditions
    ]


def common_replicates(table: EvidenceTable) -> int:
    """The number of replicates that all alternatives have in common; 0 where nothing is observed in trials.

    Replicate k of every alternative has the same seed, so that these are the first ones.
    """
    return min((int(number) for samples in table.samples.values() for number in samples.ran.sum(axis=1)), default=0)


def noisy_outcomes(preferences: Preferences, table: EvidenceTable, resamples: Resamples) -> Outcomes:
    """Every alternative valued and judged in each resample of the replicates.

    Conditions on replicates are judged by those of the resample.
    """
    values, feasible = [], []
    for drawn in resampled_tables(table, resamples):
        values.append(single_values(preferences, drawn))
        feasible.append(~violations(preferences, drawn).any(axis=1))
    return Outcomes(
        values=np.array(values),
        feasible=np.array(feasible),
        probabilities=resamples.probabilities,
        exact=resamples.exact,
    )
