"""Measures whose noise has so few and so large values that few replicates hardly show them."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import EvidenceTable

ENOUGH_REPLICATES = 30
"""From so many replicates on no measure is called heavy-tailed."""

GREAT_SKEWNESS = 2.5
"""Sample skewness beyond that of exponential times, and of most lognormal ones with σ = 1, at 10 replicates."""


def heavy_tailed_measures(
    table: EvidenceTable, measures: Collection[str], replicates: NDArray[np.int64]
) -> tuple[str, ...]:
    """The measures of some whose noise, pooled over the alternatives, is very skewed; none with enough replicates.

    Args:
        table: The evidence.
        measures: The measures that decide and are no shares of trials.
        replicates: Replicates of each of the alternatives between which the choice is open.
    """
    if int(replicates.min()) >= ENOUGH_REPLICATES:
        return ()
    return tuple(
        measure
        for measure in measures
        if measure in table.samples and _skewness(table.samples[measure].values) > GREAT_SKEWNESS
    )


def _skewness(values: NDArray[np.float64]) -> float:
    """Greatest skewness, of either sign, of the deviations from each alternative's mean as shares of it."""
    from scipy.stats import skew

    known = [row[~np.isnan(row)] for row in values]
    relative = [row / row.mean() - 1.0 for row in known if len(row) > 1 and row.mean() != 0.0]
    pooled = np.concatenate(relative) if relative else np.zeros(1)
    return 0.0 if np.ptp(pooled) <= 1e-9 else abs(float(skew(pooled)))
