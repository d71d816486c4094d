"""Error rates of many comparisons and repeated looks: Holm's rule and error spending."""

from __future__ import annotations

from collections.abc import Sequence

SPENDING_POWER = 2.0
"""Exponent of the error spending: little is spent at the first look, most at the last."""


def holm_adjusted(p_values: Sequence[float], weights: Sequence[float] | None = None) -> tuple[float, ...]:
    """P-values adjusted by Holm's rule, each to be compared with the level of the whole family.

    Holm, "A simple sequentially rejective multiple test procedure", 1979, section 4 for weights: in the order
    of p/w, each is multiplied by the weights that are left over its own, and none is less than the one
    before it. The probability of any false rejection stays below the level, whatever the comparisons have in
    common.

    Args:
        p_values: One for each comparison.
        weights: The share of the level that each begins with, in any unit; equal shares by default. A
            comparison with weight 0 is never rejected.
    """
    shares = [1.0] * len(p_values) if weights is None else weights
    adjusted = [1.0] * len(p_values)
    order = sorted(
        (place for place, share in enumerate(shares) if share > 0.0),
        key=lambda place: (p_values[place] / shares[place], place),
    )
    left = [0.0] * (len(order) + 1)
    for rank in range(len(order) - 1, -1, -1):
        left[rank] = left[rank + 1] + shares[order[rank]]
    greatest = 0.0
    for rank, place in enumerate(order):
        greatest = max(greatest, min(1.0, left[rank] / shares[place] * p_values[place]))
        adjusted[place] = greatest
    return tuple(adjusted)


def level_of_look(look: int, looks: int, level: float) -> float:
    """Share of an error rate for one look (alpha spending).

    The power family of spending functions (Kim and DeMets, "Design and analysis of group sequential tests based on the
    type I error spending rate function", 1987) allows ``level * (k / K)**2`` up to look k of K; each look gets the
    increment. Since the parts sum to the level, the error over all looks is at most the level for any dependence
    between looks; the loss of power is small.

    Args:
        look: Which look, from 1.
        looks: How many there are at most.
        level: The error rate of all looks.
    """
    until, before = (float(level * (count / looks) ** SPENDING_POWER) for count in (look, look - 1))
    return until - before
