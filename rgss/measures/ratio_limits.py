"""Distribution-free confidence limits of a ratio of two means."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from rgss.measures.anytime_evidence import bounded_mean_evidence
from rgss.measures.mean_limits import UNSEEN_FACTOR, falling_root, tail_probability
from rgss.measures.ranges import Range

Pair = tuple[float, float]
"""Numerator and denominator of one trial."""

_DIGITS = 9
_MOST_DOUBLINGS = 200


def ratio_limits(
    pairs: Sequence[Pair], *, numerator: Range, denominator: Range, tail: float, over_looks: bool = False
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
        over_looks: Whether the number of trials may depend on their values. The test is then that of
            `rgss.measures.bounded_mean_evidence`, which is exact where the bounds are stated.

    Returns:
        The lower and the upper limit, None for one that exceeds the range of floats, and on a side without a bound if
        all numerators are 0; None if b may have either sign.
    """
    if denominator.high <= 0.0:
        pairs = [(-a, -b) for a, b in pairs]
        numerator, denominator = numerator.negated(), denominator.negated()
    if denominator.low < 0.0 or min(b for _, b in pairs) < 0.0:
        return None
    tops, bottoms = _bounded(numerator, [a for a, _ in pairs]), _bounded(denominator, [b for _, b in pairs])
    test = partial(_Test, denominator=bottoms, tail=tail, over_looks=over_looks)
    # Numerators that were all 0 say nothing about the size of another.
    is_nothing = not any(a for a, _ in pairs)
    low = high = None
    if not is_nothing or math.isfinite(numerator.low):
        low = _upper_limit(test(pairs=[(-a, b) for a, b in pairs], most=tops.negated().high))
    if not is_nothing or math.isfinite(numerator.high):
        high = _upper_limit(test(pairs=pairs, most=tops.high))
    return None if low is None else -low, high


def _bounded(one: Range, seen: Sequence[float]) -> Range:
    """Range with assumed bounds where it has none, widened to contain all observed values."""
    unseen = UNSEEN_FACTOR * math.fsum(abs(each) / len(seen) for each in seen)
    low = one.low if math.isfinite(one.low) else -unseen
    return Range(low=min(*seen, low), high=max(*seen, one.high if math.isfinite(one.high) else unseen))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Test:
    """Test of a ratio from the greatest possible numerator and the range of the denominators, none negative."""

    pairs: Sequence[Pair]
    most: float
    denominator: Range
    tail: float
    over_looks: bool

    def height(self, ratio: float) -> float:
        """Probability of the test of a ratio, above its tail; it falls with the ratio."""
        differences = sorted(a - ratio * b for a, b in self.pairs)
        bound = self.most - min(ratio * self.denominator.low, ratio * self.denominator.high)
        bound = max(differences[-1], bound)
        if not self.over_looks:
            return tail_probability(differences, bound, 0.0) - self.tail
        evidence = bounded_mean_evidence(differences, 0.0, above=False, most=bound)
        return math.exp(-max(evidence, 0.0)) - self.tail


def _upper_limit(test: _Test) -> float | None:
    count = len(test.pairs)
    mean = math.fsum(b for _, b in test.pairs) / count
    ratio = math.fsum(a for a, _ in test.pairs) / count / mean
    step = max(abs(ratio), abs(test.most) / mean)
    if step == 0.0:
        return ratio
    for _ in range(_MOST_DOUBLINGS):
        if not math.isfinite((ratio + step) * test.denominator.high):
            return None
        beyond = test.height(ratio + step)
        if beyond <= 0.0:
            found = falling_root(test.height, ratio, ratio + step, below=beyond)
            return max(ratio, float(f"{found:.{_DIGITS}g}"))
        step *= 2.0
    return None
