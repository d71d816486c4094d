"""The mean of paired differences against a limit: the bootstrap, with Student's t for few seeds."""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError

DRAWS = 20_000
"""Resamples of the seeds: the least p-value is one in so many."""

LEAST_SPREAD = 0.01
"""The spread is taken as at least this share of the margin, for a few equal numbers prove no certainty."""

CONFIDENCE = 0.95


class PairedMean:
    """Inference on the mean of paired differences.

    A p-value is the greater of two. The percentile bootstrap (Efron, "Bootstrap methods: another
    look at the jackknife", 1979) follows a skew, but takes the spread of few seeds for known;
    Student's t allows for that, but not for a skew. The greater keeps the error of either in check.
    """

    def __init__(self, differences: NDArray[np.float64], *, margin: float) -> None:
        """Bootstrap the seeds; the resamples are the same for every metric.

        Args:
            differences: One for each seed, shape (n,).
            margin: The margin, which bounds the spread from below.

        Raises:
            DefinitionError: There are fewer than two seeds.
        """
        if len(differences) < 2:
            raise DefinitionError("one seed shows nothing of noise", hint="compare at least two")
        self._count = len(differences)
        self._mean = math.fsum(differences) / self._count
        self._spread = float(np.std(differences, ddof=1))
        self._least_spread = LEAST_SPREAD * margin
        self._drawn = _counts(self._count) @ differences / self._count

    def above(self, limit: float) -> float:
        """The p-value against the mean being at most a limit."""
        return max(self._bootstrapped(int(np.count_nonzero(self._drawn <= limit))), self._tail(limit - self._mean))

    def below(self, limit: float) -> float:
        """The p-value against the mean being at least a limit."""
        return max(self._bootstrapped(int(np.count_nonzero(self._drawn >= limit))), self._tail(self._mean - limit))

    def interval(self, confidence: float = CONFIDENCE) -> tuple[float, float]:
        """Interval of the mean for reports: the union of the bootstrap's and Student's intervals.

        Args:
            confidence: Its confidence level, without correction for multiple metrics.
        """
        from scipy.special import stdtrit

        tail = (1.0 - confidence) / 2.0
        low, high = np.quantile(self._drawn, [tail, 1.0 - tail])
        reach = float(stdtrit(self._count - 1, 1.0 - tail)) * self._spread / math.sqrt(self._count)
        return min(float(low), self._mean - reach), max(float(high), self._mean + reach)

    def _bootstrapped(self, beyond: int) -> float:
        return (1.0 + beyond) / (DRAWS + 1.0)

    def _tail(self, distance: float) -> float:
        from scipy.special import stdtr

        error = max(self._spread, self._least_spread) / math.sqrt(self._count)
        return float(stdtr(self._count - 1, distance / error))


@lru_cache(maxsize=8)
def _counts(seeds: int) -> NDArray[np.float64]:
    """Count of each seed in each resample, shape (draws, n)."""
    drawn = np.random.default_rng(seeds).multinomial(seeds, np.full(seeds, 1.0 / seeds), size=DRAWS)
    return np.asarray(drawn, dtype=np.float64)
