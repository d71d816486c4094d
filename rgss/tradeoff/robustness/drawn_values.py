"""Values and feasibility of alternatives in draws of their evidence."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import Array, EvidenceTable, Samples, Threshold
from rgss.tradeoff.programs import Preferences, condition_column, keeps


def evaluated(
    preferences: Preferences, table: EvidenceTable, drawn: Mapping[str, Array], picks: NDArray[np.intp]
) -> tuple[Array, NDArray[np.bool_]]:
    """Single values, shape (b, n, m), and which alternatives can be chosen, shape (b, n).

    Args:
        preferences: The preferences.
        table: The evidence.
        drawn: Quantities of each measure that draws differ in, shape (b, n); NaN if unknown.
        picks: Replicates that conditions on replicates are evaluated on, shape (b, r).
    """
    draws, count = len(picks), len(table)
    feasible = np.ones((draws, count), dtype=np.bool_)
    measures = preferences.weighting.deciding_measures
    values = np.empty((draws, count, len(measures)))
    for place, measure in enumerate(measures):
        quantities = drawn.get(measure)
        quantities = np.tile(table.column(measure), (draws, 1)) if quantities is None else quantities
        known = ~np.isnan(quantities)
        flat = preferences.value_function(measure).values_at(np.where(known, quantities, 0.0).ravel())
        values[:, :, place] = np.where(known, flat.reshape(draws, count), np.nan)
        feasible &= known
    for condition in preferences.conditions:
        if isinstance(condition, Threshold):
            quantities = drawn.get(condition.measure)
            quantities = table.column(condition.measure)[None] if quantities is None else quantities
            feasible &= keeps(condition.sense, quantities, condition.limit)
        else:
            statistic = _drawn_statistics(preferences, table, picks, condition)
            feasible &= keeps(condition.sense, statistic, condition.limit)
    return values, feasible


def _drawn_statistics(
    preferences: Preferences, table: EvidenceTable, picks: NDArray[np.intp], condition: object
) -> Array:
    """The statistic of a demand on replicates in each draw, shape (b, n); the table's own without picks."""
    risk = next(one for one in preferences.risks if one is condition)
    if not picks.shape[1]:
        return condition_column(risk, table)[None]
    samples = table.replicates(risk.measure)
    found = np.empty((len(picks), len(table)))
    for draw, pick in enumerate(picks):
        again = Samples(values=samples.values[:, pick], ran=samples.ran[:, pick])
        one = replace(table, samples={risk.measure: again})
        found[draw] = condition_column(risk, one)
    return found
