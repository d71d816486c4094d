"""Posterior of estimates under a hierarchical model: alternatives with a common level share its effect.

Every estimate is the population's mean plus an effect of each factor's level and an individual residual, observed with
noise that is correlated between alternatives with common trials:

    θ = μ 1 + Σ_f Z_f a_f + r,   a_f ~ N(0, v_f I),   r ~ N(0, v_r I),   estimates ~ N(θ, C)

(Gelman, "Analysis of variance", Annals of Statistics 33, 2005). The shrinkage of a factor's levels depends on its
effect: a factor that separates designs is hardly shrunk, one without an effect is pooled. The variances are estimated
from the data.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array

MOST_JOINT = 160
"""Of at most so many distinct alternatives the noise is weighed jointly, and levels have effects."""

_SWEEPS = 240
_UNUSED_SWEEPS = 40
_STEP = 1.5
_RIDGE = 1e-6
_RATIOS = 10.0 ** np.linspace(-4.0, 6.0, 101)
"""Grid of the population's variance over that of noise, where it has no factors."""


def joint_draws(count: int) -> int:
    """Fewest draws that show how the noise of so many distinct alternatives goes together."""
    return 8 * count if count <= MOST_JOINT else 0


def drawn_with_population(
    flat: Array,
    groups: NDArray[np.intp],
    levels: NDArray[np.intp] | None,
    *,
    seeds: int,
    generator: np.random.Generator,
) -> Array:
    """Posterior draws from draws of the estimates alone.

    Args:
        flat: Draws of each estimate by its own evidence, shape (draws, n); all finite.
        groups: The group of each alternative, shape (n,), whose draws are the same.
        levels: The level of each alternative in each factor, shape (n, f); None where it is unknown.
        seeds: Number of replicates that correlations of the noise were seen in.
        generator: Source of randomness.

    Returns:
        Draws that the population has its share in, shape (draws, n).
    """
    _, first, group = np.unique(groups, return_index=True, return_inverse=True)
    own = flat[:, first]
    count = len(first)
    if count < 2 or not own.var(axis=0).any():
        return flat
    if count <= MOST_JOINT:
        return _jointly(own, _alikeness(group, count, levels), seeds, generator)[:, group]
    return _one_by_one(own, generator)[:, group]


def _alikeness(group: NDArray[np.intp], count: int, levels: NDArray[np.intp] | None) -> list[Array]:
    """Share of a level's effect that two distinct alternatives have in common, (count, count) for each factor.

    An alternative that represents several of other levels has their mean effect.
    """
    shares = []
    for column in () if levels is None else np.asarray(levels).T:
        codes = np.unique(column, return_inverse=True)[1]
        member = np.zeros((count, int(codes.max()) + 1))
        np.add.at(member, (group, codes), 1.0)
        member /= member.sum(axis=1, keepdims=True)
        shared = member @ member.T
        # A factor with one level is the mean; one with a level for each alternative is the rest.
        if np.ptp(shared) > 0.0 and not np.array_equal(shared, np.eye(count)):
            shares.append(shared)
    return shares


def _weighed_noise(own: Array, seeds: int) -> Array:
    """The covariance of the noise that estimates are weighed by, shape (n, n).

    Correlations from few seeds are too sharp: some mixture of estimates seems free of noise. They are
    drawn to their mean by the share that their own sampling variance explains (Schäfer and Strimmer, "A
    shrinkage approach to large-scale covariance matrix estimation", 2005).
    """
    size = own.std(axis=0, ddof=1)
    size = np.maximum(size, math.sqrt(_RIDGE) * float(size.max()))
    count = len(size)
    found = np.cov(own, rowvar=False) / np.outer(size, size)
    apart = ~np.eye(count, dtype=np.bool_)
    mean = float(np.clip(found[apart].mean(), 0.0, 1.0))
    sampling = (1.0 - mean**2) ** 2 / max(seeds - 1, 1)
    share = min(1.0, sampling / max(float(((found - mean) ** 2)[apart].mean()), 1e-300))
    drawn = (1.0 - share) * found + share * mean
    np.fill_diagonal(drawn, 1.0 + _RIDGE)
    return np.asarray(drawn * np.outer(size, size), dtype=np.float64)


def _jointly(own: Array, shares: Sequence[Array], seeds: int, generator: np.random.Generator) -> Array:
    """Posterior draws by conditioning prior draws on the estimates (Matheron's rule).

    The variances are drawn by Metropolis steps from their posterior. A variance has the uniform
    shrinkage prior (Daniels, "A prior for the variance in hierarchical models", 1999): the share by
    which noise draws an estimate to the others is uniform.
    """
    draws, count = own.shape
    places, noise = own.mean(axis=0), _weighed_noise(own, seeds)
    # Noise that is common to all alternatives does not separate them.
    scale = float(noise.trace() / count - noise.mean())
    scale = max(scale, _RIDGE * float(noise.trace()) / count)
    parts = [*shares, np.eye(count)]
    ratios = _variance_ratios(places, noise, [scale * part for part in parts], generator)
    found = np.empty_like(own)
    for place, ratio in enumerate(ratios):
        some = slice(place, None, len(ratios))
        size = len(range(*some.indices(draws)))
        if size:
            prior = scale * sum((share * part for share, part in zip(ratio, parts, strict=True)), np.zeros_like(noise))
            lower = np.linalg.cholesky(prior + _RIDGE * scale * np.eye(count))
            start = generator.standard_normal((size, count)) @ lower.T
            solved = np.linalg.solve(prior + noise, np.column_stack([prior, np.ones(count)]))
            gain, weights = solved[:, :-1].T, solved[:, -1] / solved[:, -1].sum()
            rest = own[some] - start
            centre = rest @ weights
            found[some] = start + centre[:, None] + (rest - centre[:, None]) @ gain.T
    return found


def _variance_ratios(
    places: Array, noise: Array, parts: Sequence[Array], generator: np.random.Generator
) -> list[Array]:
    """Draws of each part's variance over that of noise, from their posterior."""
    state = np.zeros(len(parts))
    known = np.column_stack([places, np.ones(len(places))])
    scaled = [share * part for share, part in zip(np.exp(state), parts, strict=True)]
    height = _log_density(state, known, noise, scaled)
    kept = []
    for sweep in range(_SWEEPS):
        for part in range(len(parts)):
            moved = state.copy()
            moved[part] += _STEP * generator.standard_normal()
            with_moved = [*scaled]
            with_moved[part] = np.exp(moved)[part] * parts[part]
            at_moved = _log_density(moved, known, noise, with_moved)
            if math.log(generator.random()) < at_moved - height:
                state, height, scaled = moved, at_moved, with_moved
        if sweep >= _UNUSED_SWEEPS:
            kept.append(np.exp(state))
    return kept


def _log_density(logs: Array, known: Array, noise: Array, scaled: Sequence[Array]) -> float:
    """Log posterior density of the logarithms of the ratios, the population's mean integrated out.

    Args:
        logs: The logarithms, shape (p,).
        known: The estimates beside ones, shape (n, 2).
        noise: The covariance of the noise, shape (n, n).
        scaled: The covariance of each part at these ratios, shape (n, n).
    """
    if np.abs(logs).max() > 25.0:
        return -math.inf
    total = np.zeros_like(noise)
    for part in scaled:
        total += part
    total += noise
    lower = np.linalg.cholesky(total)
    half = np.linalg.solve(lower, known)
    precision = float(half[:, 1] @ half[:, 1])
    deviance = float(half[:, 0] @ half[:, 0]) - float(half[:, 0] @ half[:, 1]) ** 2 / precision
    fit = -0.5 * deviance - float(np.log(np.diag(lower)).sum()) - 0.5 * math.log(precision)
    # Of a ratio the density is 1 / (1 + ratio)²; of its logarithm the ratio is a factor more.
    return fit + float((logs - 2.0 * np.logaddexp(0.0, logs)).sum())


def _one_by_one(own: Array, generator: np.random.Generator) -> Array:
    """Posterior draws where alternatives are too many to weigh their noise jointly: one population, own noise."""
    draws = len(own)
    places = own.mean(axis=0)
    common = own.mean(axis=1, keepdims=True)
    noise = np.maximum((own - common).var(axis=0), _RIDGE * own.var(axis=0).max())
    scale = float(noise.mean())
    heights = np.array([_population_height(places, noise + ratio * scale) for ratio in _RATIOS])
    heights += np.log(_RATIOS) - 2.0 * np.log1p(_RATIOS)
    chances = np.exp(heights - heights.max())
    picked = _RATIOS[generator.choice(len(_RATIOS), size=draws, p=chances / chances.sum())]
    between = scale * picked[:, None]
    share = between / (between + noise)
    precision = 1.0 / (between + noise)
    total = precision.sum(axis=1, keepdims=True)
    centre = (precision * places).sum(axis=1, keepdims=True) / total
    centre = centre + generator.standard_normal((draws, 1)) / np.sqrt(total)
    deviations = own - common - (places - places.mean())
    moved = centre + share * (places - centre) + np.sqrt(share) * deviations
    return np.asarray(moved + (common - common.mean()), dtype=np.float64)


def _population_height(places: Array, variance: Array) -> float:
    """Log likelihood of independent places about a mean that is integrated out."""
    precision = 1.0 / variance
    total = float(precision.sum())
    mean = float(precision @ places) / total
    return -0.5 * float(np.log(variance).sum() + math.log(total) + precision @ (places - mean) ** 2)
