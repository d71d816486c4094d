"""Observations of a measure in the replicates of every alternative."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import Comparison, Threshold, ValueFunction


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Observed:
    """A measure that is observed in trials.

    Attributes:
        measure: The measure.
        is_proportion: Whether each replicate is 0 or 1; the mean of its replicates otherwise.
        values: Quantities, shape (n, r); NaN where a replicate lacks it or was not run.
        weight: Its weight in the value; 0 if it has none.
        function: Its value function; None if it has no weight.
        thresholds: Its thresholds, by their place among all thresholds.
        bounds: The least and the greatest value that a replicate can have, shape (n, 2), infinite where unknown; None
            without any.
    """

    measure: str
    is_proportion: bool
    values: NDArray[np.float64]
    weight: float
    function: ValueFunction | None
    thresholds: Mapping[int, Threshold]
    bounds: NDArray[np.float64] | None = None

    def bounds_of(self, row: int) -> tuple[float, float]:
        """The least and the greatest value that a replicate of one alternative can have; infinite where unknown."""
        return (
            (-math.inf, math.inf) if self.bounds is None else (float(self.bounds[row, 0]), float(self.bounds[row, 1]))
        )

    def known(self, row: int, *, after: int = 0) -> NDArray[np.float64]:
        """The replicates of one alternative, without the first ones.

        Args:
            row: The alternative.
            after: So many first replicates are left out.
        """
        values = self.values[row, after:]
        return values[~np.isnan(values)]

    def standard_errors(self) -> NDArray[np.float64]:
        """The standard error of each alternative's estimate, shape (n,); 0 for a mean of one replicate or none."""
        known = ~np.isnan(self.values)
        counts = known.sum(axis=1)
        if self.is_proportion:
            share = (np.where(known, self.values, 0.0).sum(axis=1) + 1.0) / (counts + 2.0)
            return np.asarray(np.sqrt(share * (1.0 - share) / np.maximum(counts, 1)), dtype=np.float64)
        means = np.where(known, self.values, 0.0).sum(axis=1) / np.maximum(counts, 1)
        squares = (np.where(known, self.values - means[:, None], 0.0) ** 2).sum(axis=1)
        return np.asarray(np.sqrt(squares / np.maximum(counts * (counts - 1.0), 1.0)), dtype=np.float64)

    @property
    def least(self) -> float:
        """The smallest quantity that meets every threshold."""
        return max(
            (one.value for one in self.thresholds.values() if one.comparison is Comparison.AT_LEAST), default=-np.inf
        )

    @property
    def most(self) -> float:
        """The largest quantity that meets every threshold."""
        return min(
            (one.value for one in self.thresholds.values() if one.comparison is Comparison.AT_MOST), default=np.inf
        )
