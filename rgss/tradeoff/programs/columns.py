"""Statistics of whole columns of alternatives, in NumPy."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rgss.requirements import RELATIVE_TOLERANCE, ZERO_TOLERANCE, Comparison
from rgss.tradeoff.problem import (
    ChanceBound,
    Condition,
    EvidenceTable,
    Samples,
    TailBound,
    Threshold,
)
from rgss.tradeoff.programs.preferences import Preferences

Column = NDArray[np.float64]


def condition_column(condition: Condition, table: EvidenceTable) -> Column:
    """The statistic that a condition compares with its limit, for every alternative.

    Returns:
        Statistics, shape (n,); NaN where unknown.
    """
    if isinstance(condition, Threshold):
        return table.column(condition.measure)
    samples = table.replicates(condition.measure)
    if isinstance(condition, ChanceBound):
        met = keeps(condition.comparison, samples.values, condition.value) & samples.ran
        return np.asarray(met.sum(axis=1) / samples.ran.sum(axis=1), dtype=np.float64)
    return tail_column(condition, samples)


def tail_column(condition: TailBound, samples: Samples) -> Column:
    """The mean of the worst replicates of every alternative, shape (n,); NaN where one is unknown."""
    sign = 1.0 if condition.comparison is Comparison.AT_MOST else -1.0
    losses = np.where(samples.ran, sign * samples.values, -np.inf)
    losses = np.where(samples.ran & np.isnan(samples.values), np.inf, losses)
    worst_first = -np.sort(-losses, axis=1)
    tail = condition.share * samples.ran.sum(axis=1)
    places = np.arange(losses.shape[1])
    parts = np.clip(tail[:, None] - places[None, :], 0.0, 1.0)
    # What counts nothing adds nothing, infinite or not.
    products = np.where(parts > 0.0, parts * np.where(parts > 0.0, worst_first, 0.0), 0.0)
    # Summed exactly, for gains and losses may cancel to something far smaller than either.
    totals = np.array([math.fsum(row) if np.isfinite(row).all() else np.inf for row in products], dtype=np.float64)
    means = sign * totals / tail
    return np.asarray(np.where(np.isfinite(means), means, np.nan), dtype=np.float64)


def keeps(sense: Comparison, quantities: Column, limit: float | Column) -> NDArray[np.bool_]:
    """Mask of the quantities that keep a limit; an unknown one does not, one that counts as equal to it does."""
    kept = quantities >= limit if sense is Comparison.AT_LEAST else quantities <= limit
    share = RELATIVE_TOLERANCE * np.maximum(np.abs(quantities), np.abs(limit))
    equal = np.abs(quantities - limit) <= np.where(np.equal(limit, 0.0), ZERO_TOLERANCE, share)
    return np.asarray(kept | equal, dtype=np.bool_)


def single_values(preferences: Preferences, table: EvidenceTable) -> Column:
    """The value of every alternative in each measure with a weight above 0, shape (n, m); NaN where unknown."""
    columns = [
        preferences.value_function(measure).values_at(table.column(measure))
        for measure in preferences.weighting.deciding_measures
    ]
    return np.stack(columns, axis=1)
