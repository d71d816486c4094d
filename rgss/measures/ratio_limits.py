"""Distribution-free confidence limits of a ratio of two means."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial

from rgss.measures.mean_limits import UNSEEN_FACTOR, falling_root, tail_probability
from rgss.measures.ranges import Range

Pair = tuple[float, float]
"""Numerator and denominator of one trial."""

_DIGITS = 9
_MOST_DOUBLINGS = 200


def ratio_limits(
    pairs: Sequence[Pair], *, numerator: Range, denominator: Range, tail: float
) -> tuple[float | None, float | None] | None:
    """One-sided confidence limits of the ratio of means, each with at most the tail probability of failure.

    As in Fieller ("Some problems in interval estimation", 1954) the interval has every ratio r for which the hypothesis
    that the differences a - r b have the mean 0 is not rejected. The test is that of `rgss.measures.mean_limits`, valid
    for any distribution between the bounds of the differences, which follow from those of a and b. On a side without a
    bound, unobserved values are at most ten times the mean absolute value of the observed ones.

    Args:
        pairs: Numerators a and denominators b of at least two trials; the denominators do not sum to 0.
        numerator: Range of a.
        denominator: Range of b.
        tail: Probability beyond each limit.

    Returns:
        The lower and the upper limit, None for one that exceeds the range of floats; None if b may have either sign.
    """
    if denominator.high <= 0.0:
        pairs = [(-a, -b) for a, b in pairs]
        numerator, denominator = numerator.negated(), denominator.negated()
    if denominator.low < 0.0 or min(b for _, b in pairs) < 0.0:
        return None
    tops, bottoms = _bounded(numerator, [a for a, _ in pairs]), _bounded(denominator, [b for _, b in pairs])
    low = _upper_limit([(-a, b) for a, b in pairs], tops.negated().high, bottoms, tail)
    return None if low is None else -low, _upper_limit(pairs, tops.high, bottoms, tail)


def _bounded(one: Range, seen: Sequence[float]) -> Range:
    """Range with assumed bounds where it has none, widened to contain all observed values."""
    unseen = UNSEEN_FACTOR * math.fsum(abs(each) / len(seen) for each in seen)
    low = one.low if math.isfinite(one.low) else -unseen
    return Range(low=min(*seen, low), high=max(*seen, one.high if math.isfinite(one.high) else unseen))


def _upper_limit(pairs: Sequence[Pair], most: float, denominator: Range, tail: float) -> float | None:
    """Upper limit from the greatest possible numerator and the range of the denominators, which are not negative."""
    mean = math.fsum(b for _, b in pairs) / len(pairs)
    ratio = math.fsum(a for a, _ in pairs) / len(pairs) / mean
    height = partial(_height, pairs, most, denominator, tail)
    step = max(abs(ratio), abs(most) / mean)
    if step == 0.0:
        return ratio
    for _ in range(_MOST_DOUBLINGS):
        if not math.isfinite((ratio + step) * denominator.high):
            return None
        beyond = height(ratio + step)
        if beyond <= 0.0:
            found = falling_root(height, ratio, ratio + step, below=beyond)
            return max(ratio, float(f"{found:.{_DIGITS}g}"))
        step *= 2.0
    return None


def _height(pairs: Sequence[Pair], most: float, denominator: Range, tail: float, ratio: float) -> float:
    """Probability of the test of a ratio, above its tail; it falls with the ratio."""
    differences = sorted(a - ratio * b for a, b in pairs)
    bound = most - min(ratio * denominator.low, ratio * denominator.high)
    return tail_probability(differences, max(differences[-1], bound), 0.0) - tail
