"""Nonparametric population of proportions: a mixture of beta distributions, fitted to counts.

One beta distribution cannot represent many good and a few poor designs; fitted to both it underestimates the good ones.
A mixture with a Dirichlet process prior has as many components as the counts support (Ishwaran and James, "Gibbs
sampling methods for stick-breaking priors", Journal of the American Statistical Association 96, 2001); with one
component it is the beta-binomial model.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem.alternatives import Array

_STRENGTHS = 2.0 ** np.arange(-1, 8)
_MEANS = np.linspace(0.005, 0.995, 67)
_PARTS = 12
_CONCENTRATIONS = np.array([0.25, 0.5, 1.0, 2.0, 4.0])
_SWEEPS = 300
_UNUSED_SWEEPS = 50


def proportion_population(
    successes: Array, trials: Array, *, draws: int, generator: np.random.Generator
) -> tuple[Array, Array]:
    """The mean and the strength of the beta distribution that each proportion comes from, in each draw.

    The mean of a part has Jeffreys's prior. The share by which a single trial is drawn to the mean,
    s / (1 + s) of the strength s, is uniform: the strength's density is 1 / (1 + s)².

    Args:
        successes: Successes, shape (n,); of correlated trials their effective number.
        trials: Trials, shape (n,); all positive.
        draws: Number of draws.
        generator: Source of randomness.

    Returns:
        Means and strengths, shape (draws, n). A draw of the proportion has beta parameters
        ``mean * strength + successes`` and ``(1 - mean) * strength + trials - successes``.
    """
    counts = np.column_stack([successes, trials])
    pairs, pair, often = np.unique(counts, axis=0, return_inverse=True, return_counts=True)
    mean, strength, prior = _shapes()
    fits = _fits(pairs, mean, strength)
    means, strengths = np.empty((draws, len(successes))), np.empty((draws, len(successes)))
    kept = _SWEEPS - _UNUSED_SWEEPS
    for sweep, (weights, shapes) in enumerate(_sweeps(fits, prior, often, generator)):
        chances = _chances(fits[:, shapes] + np.log(weights))[pair.ravel()]
        for draw in range(sweep, draws, kept):
            part = (chances.cumsum(axis=1) < generator.random((len(chances), 1))).sum(axis=1).clip(max=_PARTS - 1)
            means[draw], strengths[draw] = mean[shapes[part]], strength[shapes[part]]
    return means, strengths


def _shapes() -> tuple[Array, Array, Array]:
    """Means and strengths of the shapes that a part can have, and the logarithm of their prior."""
    mean, strength = (grid.ravel() for grid in np.meshgrid(_MEANS, _STRENGTHS, indexing="ij"))
    # On a grid of the strength's logarithm its density has the strength as a factor.
    return mean, strength, np.log(strength) - 2.0 * np.log1p(strength) - 0.5 * np.log(mean * (1.0 - mean))


def _fits(pairs: Array, mean: Array, strength: Array) -> Array:
    """Log likelihood of pairs of successes and trials under each shape, shape (pairs, shapes)."""
    from scipy.special import betaln

    one, other = mean * strength, (1.0 - mean) * strength
    won, lost = pairs[:, :1], pairs[:, 1:] - pairs[:, :1]
    return np.asarray(betaln(one + won, other + lost) - betaln(one, other), dtype=np.float64)


def _sweeps(
    fits: Array, prior: Array, often: NDArray[np.intp], generator: np.random.Generator
) -> list[tuple[Array, NDArray[np.intp]]]:
    """Weights and shapes of the parts, by a blocked Gibbs sampler, in the sweeps that are kept."""
    shapes = generator.choice(len(prior), size=_PARTS, p=_chances(prior[None])[0])
    weights = np.full(_PARTS, 1.0 / _PARTS)
    concentration = 1.0
    kept = []
    for sweep in range(_SWEEPS):
        counts = generator.multinomial(often, _chances(fits[:, shapes] + np.log(weights)))
        heights = counts.T.astype(np.float64) @ fits + prior
        bounds = _chances(heights).cumsum(axis=1)
        shapes = (bounds < generator.random((_PARTS, 1))).sum(axis=1).clip(max=len(prior) - 1)
        sizes = counts.sum(axis=0)
        concentration = _concentration(sizes, generator)
        grown = generator.standard_gamma(concentration / _PARTS + sizes) + 1e-300
        weights = grown / grown.sum()
        if sweep >= _UNUSED_SWEEPS:
            kept.append((weights, shapes))
    return kept


def _concentration(sizes: NDArray[np.int64], generator: np.random.Generator) -> float:
    """A draw of the Dirichlet process's concentration, uniform on its grid beforehand."""
    from scipy.special import gammaln

    each = _CONCENTRATIONS[:, None] / _PARTS
    heights = (gammaln(each + sizes) - gammaln(each)).sum(axis=1)
    heights += gammaln(_CONCENTRATIONS) - gammaln(_CONCENTRATIONS + sizes.sum())
    return float(generator.choice(_CONCENTRATIONS, p=_chances(heights[None])[0]))


def _chances(heights: Array) -> Array:
    """Probabilities in each row that are proportional to exponentials."""
    raised = np.exp(heights - heights.max(axis=1, keepdims=True))
    return np.asarray(raised / raised.sum(axis=1, keepdims=True), dtype=np.float64)
