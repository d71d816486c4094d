"""Main effects and interactions of factors on a measure, over a full factorial design.

The design is balanced: every combination of levels once, all equally probable. Then the analysis
of variance splits the variance between designs into terms that do not overlap, and each term's
share of it is the factor's Sobol index.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import interval

CONFIDENCE = 0.95

Array = NDArray[np.float64]
Term = tuple[str, ...]

MOST_AT_ONCE = 1_000_000
"""So many estimates are split into effects at once, 8 MB: designs times resamples."""

_NO_VARIANCE = 1e-18
LEAST_USED = 0.9
"""Least share of usable resamples for which intervals are given."""

_DUST = 1e-12


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Effect:
    """Effect of one factor on a measure, or of several together beyond each alone.

    Attributes:
        factors: The factors of the term; one for a main effect, two for their interaction.
        levels: The effect of each combination of their levels in the measure's unit, shape (l_1, ...): deviation of the
        mean there from the overall mean plus the terms of lower order. Effects sum to 0 along every axis.
        low: The lower ends of their bootstrap intervals; None without replicates.
        high: The upper ends.
        sum_of_squares: Of the estimates of all designs.
        degrees_of_freedom: The product of (levels - 1).
        share: Its share of the sum of squares between all designs; 0 where they do not differ.
        share_low: The lower end of the share's bootstrap interval; None without replicates.
        share_high: The upper end.
    """

    factors: Term
    levels: Array
    low: Array | None
    high: Array | None
    sum_of_squares: float
    degrees_of_freedom: int
    share: float
    share_low: float | None
    share_high: float | None


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FactorialAnalysis:
    """The effects of all factors on one measure.

    Attributes:
        mean: The mean over all designs.
        effects: Main effects in the order of the factors, then interactions by rising order.
        rest: The share of all terms of higher order than those in `effects`.
        total_sum_of_squares: Between all designs.
        first_order: The Sobol index of each factor alone: its main effect's share.
        total_order: The share of all terms that a factor takes part in, to the highest order.
        used: The share of the resamples in which every design had an estimate; 1 where none is lost, 0 without
            replicates. The intervals are of these, and missing where the share is below `LEAST_USED`: resamples that
            give each design an estimate differ less among themselves than all do.
    """

    mean: float
    effects: tuple[Effect, ...]
    rest: float
    total_sum_of_squares: float
    first_order: dict[str, float]
    total_order: dict[str, float]
    used: float


class ResampledDesigns(Protocol):
    """The estimates of every design in each resample, read block by block; an array is one."""

    def __len__(self) -> int:
        """The number b of resamples."""
        ...

    def __getitem__(self, some: slice, /) -> Array:
        """The estimates in some of them, shape (k, ...), one axis for each factor."""
        ...


def factorial_effects(
    estimates: Array,
    factors: Sequence[str],
    *,
    resampled: ResampledDesigns | None = None,
    probabilities: Array | None = None,
    order: int = 2,
) -> FactorialAnalysis:
    """Split a measure's differences between designs into the effects of factors.

    The effect of a term is the mean at its levels less all effects within it (Yates 1937; Fisher's
    analysis of variance): A_i = m_i - m, AB_ij = m_ij - m - A_i - B_j. In a balanced design the sums
    of squares of all terms add up to the total. Replicates share their seeds between designs, so
    that an F test, which takes them for independent, does not hold; the intervals are percentiles
    over resamples of the seeds instead.

    Args:
        estimates: The measure of every design, one axis for each factor.
        factors: The names of the factors, in the order of the axes.
        resampled: The same in each resample of the replicates, shape (b, ...); NaN where a
            resample gives a design no estimate.
        probabilities: The probability of each resample, shape (b,).
        order: The most factors of a term that is reported.

    Raises:
        TradeoffError: A design has no estimate, a factor has one level, or names do not fit.
    """
    _check(estimates, factors)
    axes = range(estimates.ndim)
    terms = [term for size in range(1, estimates.ndim + 1) for term in itertools.combinations(axes, size)]
    parts = _decomposed(estimates[None], terms, float(np.abs(estimates).max()))
    squares = {term: _squares(part, estimates.size)[0] for term, part in parts.items()}
    total = float(((estimates - estimates.mean()) ** 2).sum())
    scale = float(np.abs(estimates).max()) ** 2 * estimates.size
    shares = {term: (square / total if total > _NO_VARIANCE * scale else 0.0) for term, square in squares.items()}
    noise = None
    if resampled is not None and probabilities is not None:
        noise = _noise(resampled, probabilities, terms, estimates.size, order)
    effects = []
    for term in terms:
        if len(term) <= order:
            low = high = share_low = share_high = None
            if noise is not None and noise.used >= LEAST_USED:
                low, high = noise.interval_of(noise.parts[term])
                ends = noise.interval_of(noise.shares[term])
                share_low, share_high = float(ends[0]), float(ends[1])
            effects.append(
                Effect(
                    factors=tuple(factors[axis] for axis in term),
                    levels=parts[term][0],
                    low=low,
                    high=high,
                    sum_of_squares=float(squares[term]),
                    degrees_of_freedom=int(np.prod([estimates.shape[axis] - 1 for axis in term])),
                    share=float(shares[term]),
                    share_low=share_low,
                    share_high=share_high,
                )
            )
    return FactorialAnalysis(
        mean=float(estimates.mean()),
        effects=tuple(effects),
        rest=float(sum(share for term, share in shares.items() if len(term) > order)),
        total_sum_of_squares=total,
        first_order={factors[axis]: float(shares[axis,]) for axis in axes},
        total_order={
            factors[axis]: float(sum(share for term, share in shares.items() if axis in term)) for axis in axes
        },
        used=0.0 if noise is None else noise.used,
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Noise:
    """The terms in every usable resample."""

    parts: dict[tuple[int, ...], Array]
    shares: dict[tuple[int, ...], Array]
    probabilities: Array
    used: float

    def interval_of(self, values: Array) -> tuple[Array, Array]:
        return interval(values, self.probabilities, confidence=CONFIDENCE)


def _check(estimates: Array, factors: Sequence[str]) -> None:
    if estimates.ndim != len(factors) or not factors:
        raise TradeoffError(
            f"{len(factors)} factors do not fit a design with {estimates.ndim} axes",
            hint="give one axis for each factor",
        )
    missing = int((~np.isfinite(estimates)).sum())
    if missing:
        raise TradeoffError(
            f"{missing} of {estimates.size} designs have no estimate, so effects would be confounded",
            hint="leave out levels until every combination has one",
        )
    for factor, length in zip(factors, estimates.shape, strict=True):
        if length < 2:
            raise TradeoffError(f"factor {factor!r} has one level and no effect", hint="leave it out")


def _decomposed(estimates: Array, terms: Sequence[tuple[int, ...]], largest: float) -> dict[tuple[int, ...], Array]:
    """The effects of every term in each resample, shape (b, l_1, ...) over the term's axes.

    Args:
        estimates: The estimates in each resample.
        terms: The axes of each term, the lesser terms first.
        largest: The largest magnitude of an estimate, of which rounding is a share.
    """
    factors = estimates.ndim - 1
    grand = estimates.mean(axis=tuple(range(1, factors + 1)), keepdims=True)
    full: dict[tuple[int, ...], Array] = {}
    for term in terms:
        others = tuple(axis + 1 for axis in range(factors) if axis not in term)
        part = estimates.mean(axis=others, keepdims=True) - grand
        for size in range(1, len(term)):
            for lesser in itertools.combinations(term, size):
                part = part - full[lesser]
        full[term] = part
    # What is left of differences of equal numbers is rounding, and no effect.
    dust = _DUST * largest
    return {
        term: np.squeeze(
            np.where(np.abs(part) <= dust, 0.0, part),
            axis=tuple(axis + 1 for axis in range(factors) if axis not in term),
        )
        for term, part in full.items()
    }


def _squares(part: Array, designs: int) -> Array:
    """The sum of squares over all designs in each resample, shape (b,)."""
    flat = part.reshape(len(part), -1)
    return np.asarray((flat**2).sum(axis=1) * (designs / flat.shape[1]), dtype=np.float64)


def _noise(
    resampled: ResampledDesigns, probabilities: Array, terms: Sequence[tuple[int, ...]], designs: int, order: int
) -> _Noise | None:
    """The terms in every usable resample; None where none is usable.

    The highest terms are as large as the designs themselves, so resamples are split block by block,
    and of terms beyond the order only their sums of squares are kept.
    """
    # What is left of differences of equal numbers is rounding, compared with all usable resamples.
    usable = np.zeros(len(resampled), dtype=np.bool_)
    largest = 0.0
    for here in _blocks(len(resampled), designs):
        block = resampled[here]
        usable[here] = np.isfinite(block.reshape(len(block), -1)).all(axis=1)
        if usable[here].any():
            largest = max(largest, float(np.abs(block[usable[here]]).max()))
    if not usable.any():
        return None
    used = float(probabilities[usable].sum())
    kept: dict[tuple[int, ...], list[Array]] = {term: [] for term in terms if len(term) <= order}
    squares: dict[tuple[int, ...], list[Array]] = {term: [] for term in terms}
    for here in _blocks(len(resampled), designs):
        if usable[here].any():
            for term, part in _decomposed(resampled[here][usable[here]], terms, largest).items():
                squares[term].append(_squares(part, designs))
                if term in kept:
                    kept[term].append(part)
    summed = {term: np.concatenate(square) for term, square in squares.items()}
    total = np.sum(list(summed.values()), axis=0)
    return _Noise(
        parts={term: np.concatenate(part) for term, part in kept.items()},
        shares={
            term: np.divide(square, total, out=np.zeros_like(square), where=total > 0.0)
            for term, square in summed.items()
            if term in kept
        },
        probabilities=probabilities[usable] / used,
        used=used,
    )


def _blocks(resamples: int, designs: int) -> Iterator[slice]:
    at_once = max(1, MOST_AT_ONCE // max(1, designs))
    return (slice(start, start + at_once) for start in range(0, resamples, at_once))
