"""Shares of factors in a measure's differences, from any sample of designs."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError

CONFIDENCE = 0.95
MOST_CLASSES = 32
"""A range of values is cut into as many classes as the root of the number of designs, and at most so many."""

FEWEST_PER_CLASS = 4

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class SampledIndex:
    """The Sobol index of first order of one factor, estimated from a sample.

    Attributes:
        share: The share of the variance that the factor explains alone; may be below 0 by chance.
        low: The lower end of its bootstrap interval.
        high: The upper end.
        by_chance: The share that a factor without any effect exceeds in one of twenty such samples.
    """

    share: float
    low: float
    high: float
    by_chance: float = 0.0


def classes_of(values: Array) -> NDArray[np.int64]:
    """Quantile classes of about equal size, as levels of a factor with a range.

    Args:
        values: The value of each design, shape (n,).

    Returns:
        The class of each, from 0; equal values are in the same class.
    """
    _, places = np.unique(values, return_inverse=True)
    roots = min(MOST_CLASSES, math.isqrt(len(values)), len(values) // FEWEST_PER_CLASS)
    number = max(1, min(roots, int(places.max(initial=0)) + 1))
    ranks = np.searchsorted(np.sort(places), places, side="left")
    return np.asarray(ranks * number // max(1, len(values)), dtype=np.int64)


def first_order_indices(
    classes: NDArray[np.int64], values: Array, *, resamples: int, generator: np.random.Generator
) -> tuple[SampledIndex, ...]:
    """First-order Sobol index of each factor: share of the variance between its classes, corrected for chance.

    For designs that are spread evenly over all factors, as a Latin hypercube's and Sobol's points do, the variance
    between the means of a factor's classes estimates its Sobol index of first order: Pearson's correlation ratio. With
    few designs it is above 0 by chance; epsilon squared (Kelley, "An unbiased correlation ratio measure", 1935) removes
    the expected value of that. Total-order indices cannot be estimated from such a sample without a model of the
    measure.

    A resample has designs twice, which differ in nothing within their class, so that its shares are too large; their
    mean excess is taken off the interval. What a factor without an effect has by chance is found by permuting the
    values.

    Args:
        classes: The class of each design in each factor, shape (n, d).
        values: The measure of each design, shape (n,); finite.
        resamples: Resamples of the designs, for the intervals.
        generator: Source of their randomness.

    Returns:
        One index for each factor; all 0 where the designs do not differ.

    Raises:
        TradeoffError: There are too few designs, or one has no value.
    """
    count, factors = classes.shape
    if count < 2 * FEWEST_PER_CLASS or values.shape != (count,) or not np.isfinite(values).all():
        raise TradeoffError(
            f"{count} designs with {int(np.isfinite(values).sum())} values do not do for shares of the variance",
            hint=f"leave out designs without a value; at least {2 * FEWEST_PER_CLASS} must be left",
        )
    found = _indices(classes, values)
    drawn = np.array(
        [_indices(classes[rows], values[rows]) for rows in generator.integers(0, count, size=(resamples, count))]
    )
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(drawn, [tail, 1.0 - tail], axis=0) - np.maximum(drawn.mean(axis=0) - found, 0.0)
    shuffled = np.array([_indices(classes, generator.permutation(values)) for _ in range(resamples)])
    by_chance = np.quantile(shuffled, CONFIDENCE, axis=0)
    return tuple(
        SampledIndex(
            share=float(found[factor]),
            low=float(low[factor]),
            high=float(high[factor]),
            by_chance=float(by_chance[factor]),
        )
        for factor in range(factors)
    )


def _indices(classes: NDArray[np.int64], values: Array) -> Array:
    total = float(((values - values.mean()) ** 2).sum())
    scale = float(np.abs(values).max(initial=0.0)) ** 2 * len(values)
    if total <= 1e-18 * scale:
        return np.zeros(classes.shape[1])
    found = []
    for column in classes.T:
        sizes = np.bincount(column).astype(np.float64)
        means = np.bincount(column, weights=values) / np.where(sizes > 0.0, sizes, 1.0)
        between = float((sizes * (means - values.mean()) ** 2).sum())
        number = int((sizes > 0.0).sum())
        left = len(values) - number
        # The mean square within classes is what one degree of freedom between them has by chance.
        within = (total - between) / left if left else math.inf
        found.append((between - (number - 1) * within) / total if left else 0.0)
    return np.array(found)
