"""SMAA-2: how acceptable each alternative is over weights and over the noise of replicates."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.errors import TradeoffError
from rgss.tradeoff.problem import TIE_TOLERANCE, Array
from rgss.tradeoff.weights import Drawing, WeightSet, sample_weights

UNRANKED = 0
"""The rank of an alternative that cannot be chosen."""

ALL_RANKS_TO = 1_000
"""Of at most so many alternatives every rank is counted; the counts grow with their square."""

MOST_RANKS = 100
"""Of more alternatives so many ranks are counted, the best."""

_ROWS_AT_ONCE = 4_096
_RANKS_AT_ONCE = 4_000_000


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Outcomes:
    """The values of every alternative in each outcome of the noise, as arrays in memory.

    Attributes:
        values: Single values, shape (b, n, m), from 0 to 1; NaN only where not feasible.
        feasible: Mask of the alternatives that can be chosen in each outcome, shape (b, n).
        probabilities: The probability of each outcome, shape (b,).
        exact: Whether these are all the outcomes there are, so that sums over them have no
            sampling error.
    """

    values: Array
    feasible: NDArray[np.bool_]
    probabilities: Array
    exact: bool

    @staticmethod
    def certain(values: Array, feasible: NDArray[np.bool_]) -> Outcomes:
        """One outcome, without noise.

        Args:
            values: Shape (n, m).
            feasible: Shape (n,).
        """
        return Outcomes(values=values[None], feasible=feasible[None], probabilities=np.ones(1), exact=True)

    @property
    def shape(self) -> tuple[int, ...]:
        """The shape of the values."""
        return self.values.shape


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Acceptability:
    """The indices of SMAA-2 for each alternative.

    Attributes:
        iterations: Number of drawn pairs of weights and outcomes.
        drawn_by: Method of sampling the weights.
        ranks: The rank acceptability b_i^r: the share of draws in which alternative i has rank r,
            shape (n, r), rank 1 in the first column. Equals share the better rank, so that the
            first column may sum to more than 1. All n ranks are there of up to `ALL_RANKS_TO`
            alternatives, of more the first `MOST_RANKS`.
        rank_errors: The standard error of each of these, shape (n, r).
        unranked: The share of draws in which it cannot be chosen, shape (n,).
        central_weights: The mean of the weights at which it is best, shape (n, m); NaN where it
            never is.
        confidence: The probability that it is best at its central weights, over the noise alone,
            shape (n,); NaN where it has none.
        confidence_errors: The standard errors of these; 0 where all outcomes are known.
    """

    iterations: int
    drawn_by: Drawing
    ranks: Array
    rank_errors: Array
    unranked: Array
    central_weights: Array
    confidence: Array
    confidence_errors: Array

    @property
    def first(self) -> Array:
        """The first-rank acceptability of each alternative, shape (n,)."""
        return np.asarray(self.ranks[:, 0], dtype=np.float64)


def smaa2(outcomes: Outcomes, weights: WeightSet, *, iterations: int, generator: np.random.Generator) -> Acceptability:
    """Draw weights and outcomes, rank, and count.

    Lahdelma and Salminen, "SMAA-2: Stochastic multicriteria acceptability analysis for group
    decision making", Operations Research 49(3), 2001: the rank of i is one more than the number of
    alternatives that are better; the central weights are the mean of the weights that make i the
    best; the confidence factor is the probability that i is best when they are used. An alternative
    that misses a threshold in an outcome has no rank in it.

    Args:
        outcomes: Possible outcomes.
        weights: The admitted weights; they are drawn uniformly.
        iterations: Number of draws.
        generator: Source of randomness.

    Returns:
        The indices; the same for the same generator state, on any machine up to ties.

    Raises:
        TradeoffError: The outcomes contradict themselves, or the admitted weights have no interior.
    """
    _check(outcomes, weights)
    _, count, size = outcomes.shape
    sample = sample_weights(weights, iterations, generator)
    drawn = sample.weights
    which = np.sort(generator.choice(len(outcomes.probabilities), size=iterations, p=outcomes.probabilities))
    most = count if count <= ALL_RANKS_TO else MOST_RANKS
    tally = np.zeros((count, most + 2), dtype=np.int64)  # not ranked, each rank, later ranks
    at_once = _ROWS_AT_ONCE if most == count else max(1, min(_ROWS_AT_ONCE, _RANKS_AT_ONCE // count))
    sums = np.zeros((count, size))
    for outcome in np.unique(which):
        values, feasible = _checked_outcome(outcomes, int(outcome))
        rows = np.flatnonzero(which == outcome)
        for start in range(0, len(rows), at_once):
            here = drawn[rows[start : start + at_once]]
            ranks = _ranks(here, values, feasible, most)
            for row, column in enumerate(ranks.T):
                tally[row] += np.bincount(column, minlength=most + 2)
            sums += (ranks == 1).T.astype(np.float64) @ here
    shares = tally[:, 1 : most + 1] / iterations
    best = tally[:, 1]
    central = np.divide(sums, best[:, None], out=np.full_like(sums, np.nan), where=best[:, None] > 0)
    confidence = _confidence(outcomes, central)
    draws = np.inf if outcomes.exact else float(len(outcomes.probabilities))
    return Acceptability(
        iterations=iterations,
        drawn_by=sample.drawn_by,
        ranks=shares,
        rank_errors=np.sqrt(shares * (1.0 - shares) / iterations),
        unranked=tally[:, UNRANKED] / iterations,
        central_weights=central,
        confidence=confidence,
        confidence_errors=np.sqrt(confidence * (1.0 - confidence) / draws),
    )


def _check(outcomes: Outcomes, weights: WeightSet) -> None:
    shape = outcomes.shape
    if len(shape) != 3 or shape[2] != weights.size or 0 in shape:
        raise TradeoffError(
            f"outcomes of the shape {shape} do not fit {weights.size} weights",
            hint="give one value for each outcome, alternative and weighted measure",
        )


def _checked_outcome(outcomes: Outcomes, outcome: int) -> tuple[Array, NDArray[np.bool_]]:
    values, feasible = outcomes.values[outcome], outcomes.feasible[outcome]
    possible = values[feasible]
    if not ((possible >= 0.0) & (possible <= 1.0)).all():
        raise TradeoffError(
            "an alternative that can be chosen has a value that is not a number from 0 to 1",
            hint="an alternative with an unknown weighted measure cannot be chosen",
        )
    return values, feasible


def _ranks(weights: Array, values: Array, feasible: NDArray[np.bool_], most: int) -> NDArray[np.int64]:
    """The rank of each alternative at each of k weights, shape (k, n); ``most + 1`` for all later ranks."""
    ranks = np.full((len(weights), len(values)), UNRANKED, dtype=np.int64)
    possible = np.flatnonzero(feasible)
    if not len(possible):
        return ranks
    totals = weights @ values[possible].T
    if most < len(possible):
        ranks[:, possible] = _first_ranks(totals, most)
        return ranks
    # Values lie in [0, 1]: shifted by two a row, all rows are ranked in one sorted sequence.
    shift = 2.0 * np.arange(len(weights))[:, None]
    ranked = np.sort(totals, axis=1) + shift
    after = np.searchsorted(ranked.ravel(), (totals + shift + TIE_TOLERANCE).ravel(), side="right")
    ends = (np.arange(len(weights))[:, None] + 1) * len(possible)
    ranks[:, possible] = 1 + ends - after.reshape(totals.shape)
    return ranks


def _first_ranks(totals: Array, most: int) -> NDArray[np.int64]:
    """The ranks up to ``most`` by descending totals, shape (k, n); ``most + 1`` for all later ones."""
    ranks = np.full(totals.shape, most + 1, dtype=np.int64)
    # What at least `most` alternatives are better than has a later rank, so that the rest need no order.
    leaders = -np.sort(-np.partition(totals, -most, axis=1)[:, -most:], axis=1)
    lines, places = np.nonzero(totals >= leaders[:, -1:] - TIE_TOLERANCE)
    asked = totals[lines, places] + TIE_TOLERANCE
    # How many leaders are better, counted by halving: they descend.
    low, high = np.zeros(len(asked), dtype=np.int64), np.full(len(asked), most, dtype=np.int64)
    while (low < high).any():
        middle = (low + high) // 2
        better = leaders[lines, np.minimum(middle, most - 1)] > asked
        going = low < high
        low = np.where(going & better, middle + 1, low)
        high = np.where(going & ~better, middle, high)
    ranks[lines, places] = low + 1
    return ranks


def _confidence(outcomes: Outcomes, central: Array) -> Array:
    """The probability that each alternative is best at its central weights, shape (n,); NaN where it has none."""
    found = np.full(len(central), np.nan)
    rows = np.flatnonzero(~np.isnan(central).any(axis=1))
    if not len(rows):
        return found
    best = np.zeros((outcomes.shape[0], len(rows)), dtype=np.bool_)
    for outcome in range(outcomes.shape[0]):
        values, feasible = _checked_outcome(outcomes, outcome)
        possible = np.flatnonzero(feasible)
        if not len(possible):
            continue
        of_possible = values[possible]
        own = np.where(feasible[rows, None], values[rows], 0.0)
        for start in range(0, len(rows), _RANKS_AT_ONCE // len(possible) + 1):
            block = slice(start, start + _RANKS_AT_ONCE // len(possible) + 1)
            highest = (central[rows[block]] @ of_possible.T).max(axis=1)
            totals = (own[block] * central[rows[block]]).sum(axis=1)
            best[outcome, block] = feasible[rows[block]] & (totals >= highest - TIE_TOLERANCE)
    # Probabilities that sum to 1 may do so up to rounding.
    found[rows] = [min(1.0, float(outcomes.probabilities[best[:, place]].sum())) for place in range(len(rows))]
    return found
