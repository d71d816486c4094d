"""The bootstrap of replicates that all alternatives share (common random numbers)."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

FEWEST_REPLICATES = 2
"""One replicate has no variance."""

MOST_ENUMERATED = 2_000
"""Up to so many distinct resamples each is taken with its probability; beyond, some are drawn."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Resamples:
    """Resamples of the replicates, the same for every alternative.

    Replicate k of every alternative has the same seed, so a resample includes it for all of them or none; the
    correlation of their trials is preserved in differences.

    Attributes:
        counts: Count of each replicate in each resample, shape (b, r); rows sum to r.
        probabilities: The probability of each resample, shape (b,).
        exact: True if these are all distinct resamples.
    """

    counts: NDArray[np.int64]
    probabilities: NDArray[np.float64]
    exact: bool

    def means(self, replicates: NDArray[np.float64]) -> NDArray[np.float64]:
        """The mean of the known replicates in each resample.

        Args:
            replicates: Values by replicate in the last axis, shape (..., r); NaN where unknown.

        Returns:
            Shape (b, ...); NaN where no replicate of a resample is known.
        """
        known = np.isfinite(replicates)
        weight = self.counts.astype(np.float64)
        total = np.tensordot(weight, np.where(known, replicates, 0.0), axes=([1], [-1]))
        if known.all():
            # As large as the means themselves, the numbers of known replicates would all be the same.
            total /= weight.sum(axis=1).reshape(-1, *(1,) * (total.ndim - 1))
            return np.asarray(total, dtype=np.float64)
        # Whole numbers below 2^24 have no rounding in single precision.
        number = np.tensordot(weight.astype(np.float32), known.astype(np.float32), axes=([1], [-1]))
        some = number > 0.0
        np.divide(total, number, out=total, where=some)
        total[~some] = np.nan
        return np.asarray(total, dtype=np.float64)


def bootstrap(replicates: int, *, draws: int, generator: np.random.Generator) -> Resamples:
    """The bootstrap's resamples (Efron, "Bootstrap methods", 1979).

    Of r replicates there are only C(2r - 1, r) distinct resamples; while these are few they are
    all taken, each with its multinomial probability, and nothing is left to chance.

    Args:
        replicates: The number r of replicates.
        draws: Number of resamples where there are too many.
        generator: Source of randomness; not used where all are taken.

    Raises:
        TradeoffError: There are too few replicates.
    """
    if replicates < FEWEST_REPLICATES:
        raise TradeoffError(
            f"noise cannot be estimated from {replicates} replicate{'' if replicates == 1 else 's'} of each variant",
            hint=f"run 'rgss sweep' with at least {FEWEST_REPLICATES} replicates",
        )
    if math.comb(2 * replicates - 1, replicates) <= MOST_ENUMERATED:
        counts = np.array(_compositions(replicates, replicates), dtype=np.int64)
        ways = [math.factorial(replicates) // math.prod(math.factorial(int(n)) for n in row) for row in counts]
        return Resamples(counts=counts, probabilities=np.array(ways) / float(replicates**replicates), exact=True)
    drawn = generator.integers(0, replicates, size=(draws, replicates))
    counts = np.array([np.bincount(row, minlength=replicates) for row in drawn], dtype=np.int64)
    return Resamples(counts=counts, probabilities=np.full(draws, 1.0 / draws), exact=False)


def interval(
    values: NDArray[np.float64], probabilities: NDArray[np.float64], *, confidence: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The percentile interval over resamples.

    Args:
        values: One row for each resample, shape (b, ...); all finite.
        probabilities: Shape (b,).
        confidence: The share that the interval holds, such as 0.95.

    Returns:
        Its lower and upper ends, shape (...): the least values below which lies at least the tail
        and at least all but the tail of the probability.
    """
    order = np.argsort(values, axis=0, kind="stable")
    ranked = np.take_along_axis(values, order, axis=0)
    below = np.cumsum(probabilities[order], axis=0)
    tail = (1.0 - confidence) / 2.0
    ends = [
        np.take_along_axis(ranked, (below < share - 1e-12).sum(axis=0)[None].clip(max=len(ranked) - 1), axis=0)[0]
        for share in (tail, 1.0 - tail)
    ]
    return ends[0], ends[1]


def _compositions(total: int, parts: int) -> list[tuple[int, ...]]:
    """All ways to write a total as an ordered sum of non-negative parts, in lexicographic order."""
    bars = itertools.combinations(range(total + parts - 1), parts - 1)
    ways = []
    for bar in bars:
        edges = (-1, *bar, total + parts - 1)
        ways.append(tuple(after - before - 1 for before, after in itertools.pairwise(edges)))
    return ways
