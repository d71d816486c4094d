"""From a trade-off to the tables that the analyses of robustness take."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.acceptability import Outcomes
from rgss.tradeoff.alternatives import Array, Mask
from rgss.tradeoff.columns import condition_column, keeps, value_column
from rgss.tradeoff.enumeration import violations
from rgss.tradeoff.evidence_table import EvidenceTable, Samples
from rgss.tradeoff.preferences import Preferences
from rgss.tradeoff.resampling import Resamples
from rgss.tradeoff.weight_set import WeightSet


def single_values(preferences: Preferences, table: EvidenceTable) -> Array:
    """The value of every alternative in each measure with a weight above 0, shape (n, m); NaN where unknown."""
    columns = [
        value_column(preferences.value_function(measure), table.column(measure))
        for measure in preferences.weighting.deciding_measures
    ]
    return np.stack(columns, axis=1)


def admitted_weights(preferences: Preferences) -> WeightSet:
    """The weights, of measures with a weight above 0, that agree with what was elicited.

    Raises:
        TradeoffError: None do.
    """
    measures = preferences.weighting.deciding_measures
    rows, limits = preferences.weight_bounds.inequalities(measures)
    fixed, equals = preferences.weight_bounds.equations(measures)
    if not len(limits) and not len(equals):
        return WeightSet.simplex(len(measures))
    return WeightSet.cut(np.vstack([rows, fixed, -fixed]), np.concatenate([limits, equals, -equals]))


def condition_masks(preferences: Preferences, table: EvidenceTable) -> list[Mask]:
    """Which alternatives meet each of the conditions, in their order, shape (n,) each."""
    return [
        keeps(condition.sense, condition_column(condition, table), condition.limit)
        for condition in preferences.conditions
    ]


def replicate_number(table: EvidenceTable) -> int:
    """How many replicates every alternative has; 0 where nothing is observed in trials.

    Raises:
        TradeoffError: Alternatives or measures have different numbers of them.
    """
    numbers = {int(number) for samples in table.samples.values() for number in samples.ran.sum(axis=1)}
    if len(numbers) > 1:
        raise TradeoffError(
            f"alternatives have from {min(numbers)} to {max(numbers)} replicates",
            hint="noise is drawn from replicates that all share; run 'rgss sweep' for the others",
        )
    return numbers.pop() if numbers else 0


def noisy_outcomes(preferences: Preferences, table: EvidenceTable, resamples: Resamples) -> Outcomes:
    """What the evidence may say: every alternative valued and judged in each resample of the replicates.

    A quantity moves by as much as the mean of its replicates does, an end of an interval included;
    conditions on replicates are judged by those of the resample.

    Args:
        preferences: What is wanted.
        table: The evidence.
        resamples: The resamples.
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


def resampled_tables(table: EvidenceTable, resamples: Resamples) -> Sequence[EvidenceTable]:
    """The evidence in each of the resamples."""
    shifts: dict[str, NDArray[np.float64]] = {}
    for measure, samples in table.samples.items():
        if measure in table.measures:
            whole = np.full(samples.values.shape, np.nan)
            whole[samples.ran] = samples.values[samples.ran]
            known = np.isfinite(whole)
            mean = np.divide(
                np.where(known, whole, 0.0).sum(axis=1),
                known.sum(axis=1),
                out=np.full(len(whole), np.nan),
                where=known.any(axis=1),
            )
            shifts[measure] = resamples.means(whole) - mean
    found = []
    for place, counts in enumerate(resamples.counts):
        draw = np.repeat(np.arange(len(counts)), counts)
        quantities = table.quantities.copy()
        for measure, moved in shifts.items():
            quantities[:, table.measures.index(measure)] += moved[place]
        found.append(
            EvidenceTable(
                variants=table.variants,
                measures=table.measures,
                quantities=quantities,
                samples={
                    measure: Samples(values=samples.values[:, draw], ran=samples.ran[:, draw])
                    for measure, samples in table.samples.items()
                },
            )
        )
    return found
