"""Estimates after further replicates, drawn from their posterior predictive distribution."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array
from rgss.tradeoff.problem.mean_noise import MeanNoise, noise_scores
from rgss.tradeoff.problem.posterior import ObservedRows, alike_groups


def further_shifts(
    observed: Sequence[ObservedRows], truths: Sequence[Array], added: Sequence[Array], *, generator: np.random.Generator
) -> list[Array]:
    """Changes of the estimates by further replicates, one for each draw of the true means.

    After n values of mean x a further m of mean y shift the estimate by ``(y - x) m / (n + m)``. Of a draw θ of the
    true mean y is θ with the noise of m values, in which alternatives are correlated as in the replicates so far: they
    have their seeds in common.

    Args:
        observed: The replicates of each measure, of the same n alternatives.
        truths: Draws of its true means, each of shape (draws, n); NaN where unknown.
        added: Expected number of further values of each measure, each of shape (n,) and above 0 where known.
        generator: Source of randomness.

    Returns:
        The changes of each measure, shape (draws, n); NaN where unknown.
    """
    if not observed:
        return []
    groups = alike_groups(observed)
    most = max(one.values.shape[1] for one in observed)
    shared = generator.standard_normal((len(truths[0]), most))
    return [
        (_shares if one.is_proportion else _means)(one.values, groups, truth, more, shared, generator)
        for one, truth, more in zip(observed, truths, added, strict=True)
    ]


def _shares(
    values: Array, groups: NDArray[np.intp], truth: Array, added: Array, shared: Array, generator: np.random.Generator
) -> Array:
    """Changes of proportions: binomial counts at correlated scores."""
    from scipy.special import ndtr
    from scipy.stats import binom

    known = ~np.isnan(values)
    rows = np.flatnonzero(known.any(axis=1))
    found = np.full(truth.shape, np.nan)
    if not len(rows):
        return found
    seen, there = np.where(known, values, 0.0)[rows], known[rows]
    counts = there.sum(axis=1)
    rates = seen.sum(axis=1) / counts
    noise = np.where(there, seen - rates[:, None], 0.0)
    group = np.unique(groups[rows], return_inverse=True)[1]
    scores = noise_scores(noise, shared[:, : values.shape[1]], group, generator)
    chances, more = np.clip(truth[:, rows], 0.0, 1.0), added[rows]
    whole = _whole(more)
    won = np.clip(binom.ppf(ndtr(scores), whole, chances), 0.0, whole)
    later = chances + (won / whole - chances) * np.sqrt(whole / more)
    found[:, rows] = (later - rates) * more / (counts + more)
    return found


def _means(
    values: Array, _groups: NDArray[np.intp], truth: Array, added: Array, shared: Array, generator: np.random.Generator
) -> Array:
    """Changes of means: noise of the form and width that their posterior has."""
    found = np.full(truth.shape, np.nan)
    if np.isnan(values).all():
        return found
    noise = MeanNoise.of(values)
    rows = noise.rows
    scores = noise_scores(noise.noise, shared[:, : values.shape[1]], noise.group, generator)
    more = added[rows]
    whole = _whole(more)
    deviations = np.empty(scores.shape)
    for count in np.unique(whole):
        at = whole == count
        deviations[:, at] = noise.widths[at] * noise.of_means(int(count), scores[:, at], generator)
    deviations *= np.sqrt(whole / more)
    later = truth[:, rows] * (1.0 + deviations) if noise.positive else truth[:, rows] + deviations
    found[:, rows] = (later - noise.means) * more / (noise.counts + more)
    return found


def _whole(added: Array) -> NDArray[np.int64]:
    """The nearest number of values of which noise can be drawn; the rest is a matter of its width."""
    return np.maximum(1, np.rint(added)).astype(np.int64)
