"""Noise of means: its form is that of all alternatives together, its width each one's own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array
from rgss.tradeoff.problem.noise_widths import noise_widths

_POOL_DRAWS = 2_000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MeanNoise:
    """Noise of the replicates of one measure.

    Attributes:
        rows: The alternatives with a known value, shape (k,).
        counts: Number of their known values, shape (k,).
        means: Their means, shape (k,).
        positive: Whether all values are positive; noise is a factor then, else a term.
        noise: Deviations from the means, 0 where a replicate has no value, shape (k, r).
        group: The group of each alternative, shape (k,), whose values are the same.
        widths: Standard deviation of the noise of one replicate, shape (k,).
        pool: Deviations of all in units of their widths.
    """

    rows: NDArray[np.intp]
    counts: NDArray[np.int64]
    means: Array
    positive: bool
    noise: Array
    group: NDArray[np.intp]
    widths: Array
    pool: Array

    @staticmethod
    def of(values: Array) -> MeanNoise:
        """The noise of values of shape (n, r); NaN where a replicate lacks one or was not run."""
        known = ~np.isnan(values)
        counts = known.sum(axis=1)
        rows = np.flatnonzero(counts)
        some, there, counts = values[rows], known[rows], counts[rows]
        positive = bool((some[there] > 0.0).all())
        means = np.where(there, some, 0.0).sum(axis=1) / counts
        noise = np.where(there, some / means[:, None] - 1.0 if positive else some - means[:, None], 0.0)
        _, first, group = np.unique(_same_rows(some), return_index=True, return_inverse=True)
        widths = noise_widths(noise, counts, first)
        pool = _pooled_noise((noise / widths[:, None])[first], there[first], counts[first])
        return MeanNoise(
            rows=rows,
            counts=counts,
            means=means,
            positive=positive,
            noise=noise,
            group=group,
            widths=widths,
            pool=pool,
        )

    def of_means(self, count: int, scores: Array, generator: np.random.Generator) -> Array:
        """Noise of the mean of so many replicates at standard normal scores, in units of the widths."""
        sums = self.pool[generator.integers(0, len(self.pool), size=(_POOL_DRAWS, count))].mean(axis=1)
        sums.sort()
        return _at_scores(sums, scores)


def noise_scores(noise: Array, shared: Array, group: NDArray[np.intp], generator: np.random.Generator) -> Array:
    """Standard normal scores of the alternatives, shape (draws, n), correlated as their noise over the seeds is.

    Args:
        noise: Deviations from the mean of each alternative, shape (n, r).
        shared: Standard normal numbers of the seeds, shape (draws, r).
        group: The group of each alternative, shape (n,), whose noise is the same.
        generator: Source of randomness.
    """
    own = generator.standard_normal((len(shared), int(group.max()) + 1))[:, group]
    length = np.sqrt((noise**2).sum(axis=1))
    unit = noise / np.where(length > 0.0, length, 1.0)[:, None]
    return np.where(length > 0.0, shared @ unit.T, own)


def _same_rows(values: Array) -> NDArray[np.intp]:
    """The group of each row, shape (n,), of rows that are equal to the last bit."""
    seen: dict[bytes, int] = {}
    return np.array([seen.setdefault(np.ascontiguousarray(row).tobytes(), len(seen)) for row in values], dtype=np.intp)


def _pooled_noise(noise: Array, known: NDArray[np.bool_], counts: NDArray[np.int64]) -> Array:
    """Deviations from their means in units of their widths, of all alternatives together."""
    several = counts > 1
    if not several.any():
        return np.zeros(1)
    wider = np.sqrt(counts[several] / (counts[several] - 1.0))[:, None]
    return np.asarray((noise[several] * wider)[known[several]], dtype=np.float64)


def _at_scores(ordered: Array, scores: Array) -> Array:
    """The quantiles of ordered values at standard normal scores."""
    from scipy.special import ndtr

    place = ndtr(scores) * (len(ordered) - 1)
    below = np.minimum(place.astype(np.intp), len(ordered) - 2)
    part = place - below
    return np.asarray(ordered[below] * (1.0 - part) + ordered[below + 1] * part, dtype=np.float64)
