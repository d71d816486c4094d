"""Standard deviations of the noise of alternatives, each estimated from few replicates with the help of all."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array

_FEWEST = 3
_LARGEST_PRIOR = 1e6


def noise_widths(noise: Array, counts: NDArray[np.int64], first: NDArray[np.intp]) -> Array:
    """Standard deviation of the noise of each alternative, moderated towards that of all.

    The variances are draws of a scaled inverse chi-squared distribution, whose mean and degrees of freedom follow from
    the mean and the variance of their logarithms (Smyth, "Linear models and empirical Bayes methods for assessing
    differential expression in microarray experiments", Statistical Applications in Genetics and Molecular Biology 3,
    2004). If they scatter no more than estimates of one variance do, all have the pooled one.

    Args:
        noise: Deviations from the mean of each alternative, 0 where it has no replicate, shape (n, r).
        counts: Number of replicates of each alternative, at least 1, shape (n,).
        first: Rows of the alternatives that count, one of each group of equal ones.

    Returns:
        The standard deviations, shape (n,); 1 if nothing varies.
    """
    free = counts - 1.0
    squares = (noise**2).sum(axis=1)
    pooled = float(squares[first].sum() / max(free[first].sum(), 1.0))
    if pooled == 0.0:
        return np.ones(len(noise))
    own = squares / np.maximum(free, 1.0)
    several = first[(free[first] > 0.0) & (own[first] > 0.0)]
    prior, centre = math.inf, pooled
    if len(several) >= _FEWEST:
        prior, centre = _prior(own[several], free[several], pooled)
    if math.isinf(prior):
        return np.full(len(noise), math.sqrt(pooled))
    return np.asarray(np.sqrt((prior * centre + free * own) / (prior + free)), dtype=np.float64)


def _prior(variances: Array, free: Array, pooled: float) -> tuple[float, float]:
    """Degrees of freedom of the prior, and the variance that it is about."""
    from scipy.optimize import brentq
    from scipy.special import digamma, polygamma

    half = free / 2.0
    logs = np.log(variances) - digamma(half) + np.log(half)
    extra = float(logs.var(ddof=1) - polygamma(1, half).mean())
    if extra <= float(polygamma(1, _LARGEST_PRIOR / 2.0)):
        return math.inf, pooled
    prior = 2.0 * float(brentq(lambda each: float(polygamma(1, each)) - extra, 1e-3, _LARGEST_PRIOR))
    return prior, math.exp(float(logs.mean()) + float(digamma(prior / 2.0)) - math.log(prior / 2.0))
