"""Anytime-valid tests and bounds: valid at any number of looks at the data.

Each uses a nonnegative martingale M that starts at 1 where the hypothesis holds: by Ville's
inequality (1939) the probability that M *ever* reaches 1/a is at most a. So a test that rejects at
the first look at which M ≥ 1/a errs with probability at most a, whatever the rule of stopping.
"""

from __future__ import annotations

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

PRIOR_REPLICATES = 4.0
"""Weight of the prior in Student's mixture: an effect of half a standard deviation is expected."""

BETS = ((1.0, 0.5), (0.5, 0.25), (0.25, 0.125), (0.125, 0.0625), (0.0625, 0.0625))
"""Shares of the largest bet against a bounded mean, each with its part of the wealth at the start.

Half is on the boldest bet, which wins fastest where trials of two designs do not differ at all, as
those of designs that share their executions do not.
"""

_BISECTIONS = 50


def mean_evidence(values: NDArray[np.float64], limit: float, *, above: bool) -> float:
    """Logarithm of the evidence that a mean lies above, or below, a limit, whatever the variance.

    Student's t as a sequential test: the ratio of the likelihoods of t with the effect μ/σ drawn
    from N(0, 1/c) and with no effect (Lai, "On confidence sequences", 1976; Wang and Ramdas,
    "Anytime-valid t-tests and confidence sequences for Gaussian means with unknown variance", 2024):
    ``sqrt(c/(n+c)) (Q / (Q - n d²  n/(n+c)))^(n/2)``, where d is the distance of the mean from the
    limit and Q the sum of squares about the limit. It counts where the mean is on the right side.

    It is exact for normal values and approximate for others.

    Args:
        values: The values, shape (n,).
        limit: The limit.
        above: As for `rgss.measures.proportion_evidence`.
    """
    count = len(values)
    if count < 2:
        return -math.inf
    mean = math.fsum(values) / count
    distance = mean - limit if above else limit - mean
    if distance <= 0.0:
        return -math.inf
    spread = float(np.square(values - mean).sum())
    return _student_evidence(count, distance, spread)


def mean_above(values: NDArray[np.float64], level: float) -> float:
    """An upper bound of a mean that holds at every look with probability 1 - level; see `mean_evidence`.

    Args:
        values: The values, shape (n,).
        level: Probability of an error.

    Returns:
        The bound; infinite while there are too few values.
    """
    count = len(values)
    if count < 2:
        return math.inf
    mean = math.fsum(values) / count
    # The evidence at the distance d is solved for d².
    share = PRIOR_REPLICATES / (count + PRIOR_REPLICATES)
    power = math.exp((2.0 / count) * (math.log(1.0 / level) - 0.5 * math.log(share)))
    left = 1.0 - power * share
    if left <= 0.0:
        return math.inf
    spread = float(np.square(values - mean).sum())
    return mean + math.sqrt(spread * (power - 1.0) / (count * left))


@lru_cache(maxsize=65_536)
def difference_above(more: int, less: int, trials: int, level: float) -> float:
    """An upper bound of the difference of two success probabilities from trials with common seeds.

    Each seed gives 1 (only the first succeeded), -1 (only the second) or 0. Against a difference m
    a gambler bets that it is smaller: the wealth ``Π (1 + f (m - y)/(1 - m))`` is a martingale, for
    any share f in (0, 1] (Waudby-Smith and Ramdas, "Estimating means of bounded random variables by
    betting", 2024); it is spread over some shares. The bound is the smallest difference at
    which the wealth reaches 1/level.

    Args:
        more: Seeds with which only the first succeeded.
        less: Seeds with which only the second succeeded.
        trials: All seeds.
        level: Probability of an error.
    """
    if trials == 0:
        return 1.0
    needed = math.log(1.0 / level)
    low, high = (more - less) / trials, 1.0
    for _ in range(_BISECTIONS):
        middle = (low + high) / 2.0
        if middle >= 1.0:
            break
        if _wealth_against(middle, more, less, trials - more - less) >= needed:
            high = middle
        else:
            low = middle
    return high


def _wealth_against(difference: float, more: int, less: int, equal: int) -> float:
    """Logarithm of the wealth of a gambler who bets against a difference."""
    bet_of_all = 1.0 / (1.0 - difference)
    wealth = []
    for share, part in BETS:
        if share == 1.0 and more:
            continue
        bet = share * bet_of_all
        lost = more * math.log1p(-share) if more else 0.0
        won = equal * math.log1p(bet * difference) + less * math.log1p(bet * (difference + 1.0))
        wealth.append(math.log(part) + lost + won)
    most = max(wealth)
    return most + math.log(math.fsum(math.exp(each - most) for each in wealth))


def _student_evidence(count: int, distance: float, spread: float) -> float:
    square = count * distance * distance
    share = PRIOR_REPLICATES / (count + PRIOR_REPLICATES)
    if spread + share * square <= 0.0:
        return math.inf
    return 0.5 * math.log(share) + 0.5 * count * math.log((spread + square) / (spread + share * square))
