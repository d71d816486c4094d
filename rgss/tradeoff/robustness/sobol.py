"""Sobol indices where a design space is too large to be tried whole, from a sample of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

CONFIDENCE = 0.95
FEWEST_SAMPLES = 16

Array = NDArray[np.float64]
Levels = NDArray[np.int64]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SobolDesign:
    """Which designs a sampled analysis asks for (Saltelli et al. 2010).

    Attributes:
        first: n designs, the level of each of d factors, shape (n, d).
        second: n others.
        mixed: For each factor the first designs with that factor's level from the second, shape
            (d, n, d).
    """

    first: Levels
    second: Levels
    mixed: Levels

    def rows(self) -> Levels:
        """All designs one below the other, shape (n (d + 2), d)."""
        return np.vstack([self.first, self.second, self.mixed.reshape(-1, self.first.shape[1])])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SobolIndices:
    """The indices of each factor with their bootstrap intervals.

    Attributes:
        first_order: The share of the variance that the factor explains alone, shape (d,).
        first_low: Lower ends of the intervals.
        first_high: Upper ends.
        total_order: The share of all terms that the factor takes part in, shape (d,).
        total_low: Lower ends.
        total_high: Upper ends.
    """

    first_order: Array
    first_low: Array
    first_high: Array
    total_order: Array
    total_low: Array
    total_high: Array


def sobol_design(levels: Sequence[int], samples: int, generator: np.random.Generator) -> SobolDesign:
    """Draw the designs of a sampled analysis, every level of a factor being equally probable.

    Args:
        levels: The number of levels of each factor.
        samples: n; a power of 2, and n (d + 2) designs are asked for.
        generator: Where randomness comes from.

    Raises:
        TradeoffError: n is no power of 2, or too small.
    """
    if samples < FEWEST_SAMPLES or samples & (samples - 1):
        raise TradeoffError(
            f"{samples} samples do not do for Sobol indices", hint=f"give a power of 2, at least {FEWEST_SAMPLES}"
        )
    first, second = (generator.integers(0, levels, size=(samples, len(levels))) for _ in range(2))
    mixed = np.repeat(first[None], len(levels), axis=0)
    for factor in range(len(levels)):
        mixed[factor, :, factor] = second[:, factor]
    return SobolDesign(first=first, second=second, mixed=mixed)


def sobol_indices(
    design: SobolDesign, evaluate: Callable[[Levels], Array], *, resamples: int, generator: np.random.Generator
) -> SobolIndices:
    """Estimate the indices from the measure of the designs asked for.

    The estimators are SciPy's (Saltelli et al., "Variance based sensitivity analysis of model
    output", 2010); the bootstrap resamples the n pairs.

    Args:
        design: What `sobol_design` drew.
        evaluate: Gives the measure of each row of levels, shape (k,); all finite.
        resamples: Resamples of the bootstrap.
        generator: Where its randomness comes from.

    Raises:
        TradeoffError: A design has no value, or all have the same.
    """
    samples, factors = design.first.shape
    values = np.asarray(evaluate(design.rows()), dtype=np.float64)
    missing = int((~np.isfinite(values)).sum())
    if missing:
        raise TradeoffError(
            f"{missing} of {len(values)} sampled designs have no value",
            hint="a variance needs the value of every design; leave out levels that fail",
        )
    if float(np.ptp(values[: 2 * samples])) == 0.0:
        raise TradeoffError("all sampled designs have the same value", hint="there is no variance to share out")
    first, second = values[:samples], values[samples : 2 * samples]
    mixed = values[2 * samples :].reshape(factors, samples)
    found = _indices(first, second, mixed)
    draws = np.array(
        [
            _indices(first[chosen], second[chosen], mixed[:, chosen])
            for chosen in generator.integers(0, samples, size=(resamples, samples))
        ]
    )
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(draws, [tail, 1.0 - tail], axis=0)
    return SobolIndices(
        first_order=found[0],
        first_low=low[0],
        first_high=high[0],
        total_order=found[1],
        total_low=low[1],
        total_high=high[1],
    )


def _indices(first: Array, second: Array, mixed: Array) -> Array:
    from scipy.stats import sobol_indices as estimate

    result = estimate(func={"f_A": first[None], "f_B": second[None], "f_AB": mixed[:, None, :]}, n=len(first))
    return np.array([np.ravel(result.first_order), np.ravel(result.total_order)])
