"""Shares of factors in a measure's differences, from any sample of designs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

from rgss.errors import TradeoffError

CONFIDENCE = 0.95
FEWEST_DESIGNS = 8
"""Fewest designs with a value from which shares are estimated."""

GREATEST_DEGREE = 8
"""Greatest degree of the polynomial of a factor with a range."""

_DESIGNS_PER_TERM = 3
_LEAST_NEW = 1e-6
"""Least share of a term's square that is not in the terms before."""

_EXACT = 1e-12
_PATIENCE = 4
"""So many further terms are tried after the best criterion."""

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


def range_terms(values: Array) -> Array:
    """Terms of a factor with a range: Legendre polynomials of the ranks of its values.

    Args:
        values: The value of each design, shape (n,).

    Returns:
        The terms, shape (n, k); fewer than the greatest degree for few values.
    """
    _, places, sizes = np.unique(values, return_inverse=True, return_counts=True)
    middles = np.cumsum(sizes) - sizes / 2.0
    degree = min(GREATEST_DEGREE, len(sizes) - 1)
    return np.asarray(legendre.legvander(2.0 * middles[places] / len(values) - 1.0, degree)[:, 1:], dtype=np.float64)


def level_terms(levels: Array) -> Array:
    """Terms of a factor with levels: whether a design has each of them, without the last.

    Args:
        levels: The level of each design, from 0, shape (n,).
    """
    return np.asarray(levels[:, None] == np.unique(levels)[None, :-1], dtype=np.float64)


def first_order_indices(
    terms: Sequence[Array], values: Array, *, resamples: int, generator: np.random.Generator
) -> tuple[SampledIndex, ...]:
    """First-order Sobol index of each factor, by a sparse additive regression of the measure on all factors.

    The main effect of each factor is the sum of the terms that forward selection takes by the extended Bayesian
    information criterion (Chen and Chen, "Extended Bayesian information criteria for model selection with large model
    spaces", 2008): a sparse polynomial chaos expansion without interactions (Blatman and Sudret, "Adaptive sparse
    polynomial chaos expansion based on least angle regression", 2011). Its variance, less the part that noise has in
    it, is divided by the sum of those of all factors and of what is left, which interactions have. All factors are
    fitted at once, so that the effect of one is no noise of another. Total-order indices are not estimated.

    A resample is the fitted values with the residuals, each with a random sign (Wu, "Jackknife, bootstrap and other
    resampling methods in regression analysis", 1986), so that noise which differs from place to place stays there; the
    interval is that of the shares estimated from it, and begins at 0 at the most where the share is no more than chance
    gives. What a factor without an effect has by chance is found by random signs of the values.

    Args:
        terms: The terms of each factor, shape (n, k) each.
        values: The measure of each design, shape (n,); finite.
        resamples: Resamples of the residuals, for the intervals.
        generator: Source of their randomness.

    Returns:
        One index for each factor; all 0 where the designs do not differ.

    Raises:
        TradeoffError: There are too few designs, or one has no value.
    """
    count = len(values)
    if count < FEWEST_DESIGNS or not np.isfinite(values).all() or any(len(one) != count for one in terms):
        raise TradeoffError(
            f"{count} designs with {int(np.isfinite(values).sum())} values do not do for shares of the variance",
            hint=f"leave out designs without a value; at least {FEWEST_DESIGNS} must be left",
        )
    candidates = _Candidates.of(terms)
    found = candidates.shares(values)
    fitted, residuals = candidates.fit(values)
    signs = generator.choice([-1.0, 1.0], size=(2, resamples, count))
    drawn = np.array([candidates.shares(fitted + residuals * row) for row in signs[0]])
    tail = (1.0 - CONFIDENCE) / 2.0
    low, high = np.quantile(drawn, [tail, 1.0 - tail], axis=0)
    shuffled = np.array([candidates.shares((values - values.mean()) * row) for row in signs[1]])
    by_chance = np.quantile(shuffled, CONFIDENCE, axis=0)
    return tuple(
        SampledIndex(
            share=float(found[factor]),
            low=float(min(low[factor], found[factor] if found[factor] > by_chance[factor] else 0.0)),
            high=float(max(high[factor], found[factor])),
            by_chance=float(by_chance[factor]),
        )
        for factor in range(len(terms))
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Candidates:
    """Terms that a regression may take.

    Attributes:
        columns: All terms, centred and of length 1, shape (n, k).
        owners: The factor of each.
        factors: The number of factors.
    """

    columns: Array
    owners: NDArray[np.intp]
    factors: int

    @staticmethod
    def of(terms: Sequence[Array]) -> _Candidates:
        columns = np.concatenate([one - one.mean(axis=0) for one in terms], axis=1)
        owners = np.repeat(np.arange(len(terms)), [one.shape[1] for one in terms])
        lengths = np.linalg.norm(columns, axis=0)
        kept = lengths > _LEAST_NEW
        return _Candidates(columns=columns[:, kept] / lengths[kept], owners=owners[kept], factors=len(terms))

    def shares(self, values: Array) -> Array:
        """Share of the variance of each factor's main effect, shape (d,)."""
        centred = values - values.mean()
        variances = np.zeros(self.factors)
        if _is_level(values, centred):
            return variances
        columns, coefficients, residuals, chosen = self._fitted(centred)
        noise = float(residuals @ residuals) / (len(values) - 1 - len(chosen))
        inverse = np.linalg.pinv(columns)
        # Interactions are noise that differs from place to place: White's covariance, with jackknifed residuals.
        errors = residuals / np.maximum(1.0 - (columns * inverse.T).sum(axis=1), _LEAST_NEW)
        spread = (inverse * errors**2) @ inverse.T
        for factor in np.unique(self.owners[chosen]):
            at = np.flatnonzero(self.owners[chosen] == factor)
            effect = columns[:, at] @ coefficients[at]
            by_noise = np.trace(columns[:, at].T @ columns[:, at] @ spread[np.ix_(at, at)])
            variances[factor] = (float(effect @ effect) - float(by_noise)) / (len(values) - 1)
        return variances / (float(np.maximum(variances, 0.0).sum()) + noise)

    def fit(self, values: Array) -> tuple[Array, Array]:
        """The fitted values, and the jackknifed residuals, shape (n,) each."""
        centred = values - values.mean()
        if _is_level(values, centred):
            return values, np.zeros(len(values))
        columns, _, residuals, _ = self._fitted(centred)
        leverages = (columns * np.linalg.pinv(columns).T).sum(axis=1) if columns.size else np.zeros(len(values))
        return values - residuals, residuals / np.maximum(1.0 - leverages, _LEAST_NEW)

    def _fitted(self, centred: Array) -> tuple[Array, Array, Array, NDArray[np.intp]]:
        chosen = self._selected(centred)
        columns = self.columns[:, chosen]
        coefficients: Array = np.zeros(0)
        if len(chosen):
            coefficients = np.asarray(np.linalg.lstsq(columns, centred, rcond=None)[0], dtype=np.float64)
        return columns, coefficients, centred - columns @ coefficients, chosen

    def _selected(self, centred: Array) -> NDArray[np.intp]:
        """The terms of the least extended Bayesian information criterion along a forward selection."""
        count, left = len(centred), centred.copy()
        rest = self.columns.copy()
        total = float(centred @ centred)
        chosen: list[int] = []
        best, length = count * math.log(total), 0
        for size in range(1, min(count // _DESIGNS_PER_TERM, rest.shape[1]) + 1):
            squares = (rest**2).sum(axis=0)
            gains = np.where(squares > _LEAST_NEW, (rest.T @ left) ** 2 / np.maximum(squares, _LEAST_NEW), -1.0)
            gains[chosen] = -1.0
            place = int(np.argmax(gains))
            if gains[place] < 0.0:
                break
            direction = rest[:, place] / math.sqrt(squares[place])
            left -= direction * float(direction @ left)
            rest -= np.outer(direction, direction @ rest)
            chosen.append(place)
            remaining = float(left @ left)
            if remaining <= _EXACT * total:
                return np.array(chosen, dtype=np.intp)
            criterion = count * math.log(remaining) + size * math.log(count) + _log_choices(rest.shape[1], size)
            if criterion < best:
                best, length = criterion, size
            elif size - length >= _PATIENCE:
                break
        return np.array(chosen[:length], dtype=np.intp)


def _log_choices(terms: int, size: int) -> float:
    """Logarithm of the number of sets of so many terms."""
    return math.lgamma(terms + 1) - math.lgamma(size + 1) - math.lgamma(terms - size + 1)


def _is_level(values: Array, centred: Array) -> bool:
    scale = float(np.abs(values).max(initial=0.0)) ** 2 * len(values)
    return float(centred @ centred) <= 1e-18 * scale
