"""Distribution-free confidence limits of a mean of bounded values."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from statistics import NormalDist

UNSEEN_FACTOR = 10.0
"""Assumed bound without a declared one, as a multiple of the mean absolute value of the observations."""

MOST_EXACT = 64
"""Greatest number of values for the exact tail; for more a saddlepoint approximation is used."""

_TAIL_TOLERANCE = 1e-10
_DIGITS = 9
_MOST_STEPS = 200


def mean_limits(
    values: Sequence[float], *, least: float | None, most: float | None, tail: float
) -> tuple[float | None, float | None]:
    """One-sided confidence limits of the mean, each with at most the tail probability of failure.

    The upper limit is the quantile of ``Σ w_i x_(i)`` over the order statistics and the upper bound, with weights
    uniform on the simplex (Gaffke, "Three test statistics for a nonparametric one-sided hypothesis on the mean of a
    nonnegative variable", 2005; Learned-Miller and Thomas, "A new confidence interval for the mean of a bounded random
    variable", 2019): the Bayesian bootstrap with one more observation at the bound. The lower limit is mirrored. For
    values that are all 0 or 1 it equals the Clopper-Pearson limit. Its coverage is proven in Vlassis and Thomas, "An
    exact distribution-free test for means of nonnegative random variables", 2026.

    Args:
        values: The observations; not empty.
        least: The least possible value; None if unknown.
        most: The greatest possible value; None if unknown.
        tail: Probability beyond each limit.

    Returns:
        The lower and the upper limit; None on a side without a bound if no bound can be assumed: if there is only one
        value, if all are 0, or if the assumed bound exceeds the range of floats.
    """
    seen = tuple(sorted(values))
    size = math.fsum(abs(each) / len(seen) for each in seen)
    # Ten times nothing is no bound: a rare value that is not 0 may have any size.
    unknown = len(seen) < 2 or size == 0.0
    bottom = min(seen[0], -UNSEEN_FACTOR * size) if least is None else min(seen[0], least)
    top = max(seen[-1], UNSEEN_FACTOR * size) if most is None else max(seen[-1], most)
    no_low = (unknown and least is None) or not math.isfinite(bottom)
    no_high = (unknown and most is None) or not math.isfinite(top)
    low = None if no_low else -_upper_limit(tuple(-each for each in reversed(seen)), -bottom, tail)
    return low, None if no_high else _upper_limit(seen, top, tail)


@lru_cache(maxsize=4_096)
def _upper_limit(seen: tuple[float, ...], bound: float, tail: float) -> float:
    """Upper limit from values in ascending order and an upper bound."""
    count = len(seen)
    mean = math.fsum(each / count for each in seen)
    if bound <= seen[0]:
        return bound
    # By the Brunn-Minkowski inequality this power of the tail is concave: regula falsi needs few steps.
    power = 1.0 / count

    def height(limit: float) -> float:
        return float(tail_probability(seen, bound, limit) ** power - tail**power)

    found = falling_root(height, mean, bound, below=-(tail**power))
    return max(mean, float(f"{found:.{_DIGITS}g}"))


def tail_probability(seen: Sequence[float], bound: float, limit: float) -> float:
    """Probability that the mean of some values and an upper bound with uniform weights exceeds a limit.

    The limit of `mean_limits` is where it is the tail: a mean is rejected at that level where it is less.

    Args:
        seen: The values in ascending order.
        bound: An upper bound.
        limit: The limit.
    """
    return (_exact_tail if len(seen) <= MOST_EXACT else _saddlepoint_tail)(seen, bound, limit)


def falling_root(height: Callable[[float], float], low: float, high: float, *, below: float) -> float:
    """Root of a decreasing function by the Illinois variant of regula falsi.

    Args:
        height: The function.
        low: Point with a positive value; returned if the value is not positive.
        high: Point with the value ``below``.
        below: The function's value at the upper end.
    """
    at_low, at_high, side = height(low), below, 0
    if at_low <= 0.0:
        return low
    span = high - low
    for _ in range(_MOST_STEPS):
        middle = (low * at_high - high * at_low) / (at_high - at_low)
        if not low < middle < high:
            middle = 0.5 * (low + high)
        at_middle = height(middle)
        if abs(at_middle) < _TAIL_TOLERANCE or high - low < 1e-13 * span:
            return middle
        if at_middle > 0.0:
            low, at_low = middle, at_middle
            at_high, side = (at_high / 2.0 if side > 0 else at_high), 1
        else:
            high, at_high = middle, at_middle
            at_low, side = (at_low / 2.0 if side < 0 else at_low), -1
    return 0.5 * (low + high)


def _exact_tail(seen: Sequence[float], bound: float, limit: float) -> float:
    """The probability exactly.

    Uniform weights are exponential variables divided by their sum, so it is the probability that ``Σ a_i E_i`` of the
    values above the limit, with ``a_i = x_i - limit``, exceeds ``Σ b_j E_j`` of those below. Exponential variables are
    memoryless: of the last two, ``a E`` is the larger with probability ``a / (a + b)``, and its excess has the same
    distribution. All summands are positive.
    """
    above = [each - limit for each in (*seen, bound) if each > limit]
    below = [limit - each for each in seen if each < limit]
    chances = [0.0] * (len(below) + 1)
    for more in above:
        chances[0] = last = 1.0
        for place, less in enumerate(below, start=1):
            last = (more * last + less * chances[place]) / (more + less)
            chances[place] = last
    return chances[-1] if above else 0.0


def _saddlepoint_tail(seen: Sequence[float], bound: float, limit: float) -> float:
    """The same probability by the Lugannani-Rice formula (1980), for many values."""
    import numpy as np

    steps = np.array((*seen, bound)) - limit
    largest, smallest = float(steps.max()), float(steps.min())
    if largest <= 0.0:
        return 0.0
    if smallest >= 0.0:
        return 1.0
    # The cumulant generating function is -Σ log(1 - s a); its derivative rises between these poles.
    left, right = 1.0 / smallest, 1.0 / largest
    for _ in range(_MOST_STEPS):
        point = 0.5 * (left + right)
        if point in (left, right):
            break
        left, right = (point, right) if float((steps / (1.0 - point * steps)).sum()) < 0.0 else (left, point)
    ratios = steps / (1.0 - point * steps)
    generating = -float(np.log1p(-point * steps).sum())
    deviance = math.copysign(math.sqrt(max(0.0, -2.0 * generating)), point)
    wald = point * math.sqrt(float((ratios * ratios).sum()))
    normal = NormalDist()
    if abs(deviance) < 1e-4:
        return 0.5
    found = normal.cdf(-deviance) + normal.pdf(deviance) * (1.0 / wald - 1.0 / deviance)
    return min(1.0, max(0.0, found))
