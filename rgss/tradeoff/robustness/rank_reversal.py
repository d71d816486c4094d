"""Rank reversal: whether the order of alternatives depends on which others are there."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rgss.tradeoff.problem import TIE_TOLERANCE, Array

Scoring = Callable[[NDArray[np.intp]], Array]
"""Gives the score of each of the alternatives that are there, more being better, shape (k,)."""


_PAIRS_UP_TO = 500
"""Largest number of alternatives of which every pair is compared."""

_PAIRS_AT_ONCE = 4_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class RankReversal:
    """Changes among the others when one alternative is removed.

    Attributes:
        removed: The alternative that is taken away.
        best_before: The best of the others while it was there; the first of equals.
        best_after: The best without it.
        swapped: Number of pairs of the others that change their order; ties that open or close count.
    """

    removed: int
    best_before: int
    best_after: int
    swapped: int


def rank_reversals(count: int, score: Scoring) -> tuple[RankReversal, ...]:
    """Rank reversal: each alternative is removed in turn, and the order of the others is compared.

    Scores that depend on the alternative alone, such as weighted values anchored on requirements,
    never reverse: the order of two alternatives is that of two numbers which nothing else touches.
    Scores that depend on the sample, such as values stretched between its extremes, may (Belton
    and Gear, "On a short-coming of Saaty's method of analytic hierarchies", 1983).

    Args:
        count: The number of alternatives.
        score: Score that orders them.

    Returns:
        The removals that change an order, by ascending alternative; empty where none does.
    """
    everyone = np.arange(count)
    before = np.asarray(score(everyone), dtype=np.float64)
    found = []
    for removed in range(count):
        rest = np.delete(everyone, removed)
        if not len(rest):
            continue
        old, new = before[rest], np.asarray(score(rest), dtype=np.float64)
        if np.array_equal(old, new) or (len(rest) > _PAIRS_UP_TO and _same_order(old, new)):
            continue
        swapped = _swaps(old, new)
        if swapped:
            found.append(
                RankReversal(
                    removed=removed,
                    best_before=int(rest[_best(old)]),
                    best_after=int(rest[_best(new)]),
                    swapped=swapped,
                )
            )
    return tuple(found)


def sample_anchored(quantities: Array, more_is_better: NDArray[np.bool_], weights: Array) -> Scoring:
    """Weighted values normalised by the range of the present alternatives.

    Not used for decisions, but for the demonstration of rank reversal. A measure without differences has the same value
    for all of them.

    Args:
        quantities: Shape (n, m).
        more_is_better: The direction of each measure, shape (m,).
        weights: Shape (m,).
    """
    signed = np.where(more_is_better, quantities, -quantities)

    def score(rows: NDArray[np.intp]) -> Array:
        here = signed[rows]
        low, span = here.min(axis=0), np.ptp(here, axis=0)
        shares = np.divide(here - low, span, out=np.zeros_like(here), where=span > 0.0)
        return np.asarray(shares @ weights, dtype=np.float64)

    return score


def _swaps(old: Array, new: Array) -> int:
    """Number of pairs that change their order, by blocks of rows, since all pairs at once need much memory."""
    count = len(old)
    step = max(1, _PAIRS_AT_ONCE // count)
    swapped = 0
    for start in range(0, count, step):
        rows = slice(start, start + step)
        changed = _order(old[rows], old) != _order(new[rows], new)
        swapped += int(np.triu(changed, start + 1).sum())
    return swapped


def _order(scores: Array, others: Array) -> NDArray[np.int8]:
    """For each pair, 1 where the first is better, -1 where it is worse, 0 in a tie."""
    gap = scores[:, None] - others[None, :]
    return np.asarray(np.where(np.abs(gap) <= TIE_TOLERANCE, 0, np.sign(gap)), dtype=np.int8)


def _same_order(old: Array, new: Array) -> bool:
    """True if no pair changes its order, by two sorted sequences instead of all pairs."""
    by_old, by_new = np.argsort(old, kind="stable"), np.argsort(new, kind="stable")
    worse = np.searchsorted(old[by_old], old - TIE_TOLERANCE)
    if not np.array_equal(worse, np.searchsorted(new[by_new], new - TIE_TOLERANCE)):
        return False
    # Equally many are worse than each; they are the same ones if the sequences begin with the same.
    place = np.empty(len(new), dtype=np.intp)
    place[by_new] = np.arange(len(new))
    furthest = np.maximum.accumulate(place[by_old])
    sizes = np.unique(worse[worse > 0])
    return bool((furthest[sizes - 1] < sizes).all())


def _best(scores: Array) -> int:
    return int(np.flatnonzero(scores >= scores.max() - TIE_TOLERANCE)[0])
