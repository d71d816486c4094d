"""Exact tests of paired successes, with the seed as the sampling unit."""

from __future__ import annotations

from functools import lru_cache
from math import comb, fsum, lgamma

import numpy as np
from numpy.typing import NDArray

from rgss.errors import DefinitionError

_GRID = 1_001
_TIE = 1e-12


def discordance_p_value(worse: int, better: int, seeds: int) -> float:
    """One-sided exact unconditional p-value of paired successes, ordered by McNemar's mid-p.

    Under the null hypothesis a seed is worse and better with the same unknown probability ψ/2. Outcomes
    (b, c) are ordered by the mid-p of McNemar's test, ``P(X > b) + P(X = b) / 2`` of ``X ~ Bin(b + c, 1/2)``,
    and the p-value is the greatest probability over ψ of an outcome at least as extreme (Suissa and Shuster,
    "The 2 x 2 matched-pairs trial: exact unconditional design and analysis", Biometrics 1991; the mid-p as
    Fagerland, Lydersen and Laake 2013). It keeps its level for every ψ, as McNemar's conditional test does,
    and rejects more often because it does not lose the rest of the level to discreteness.

    Args:
        worse: Seeds that are worse.
        better: Seeds that are better.
        seeds: All seeds, those that do not differ included.

    Returns:
        The p-value against success not having fallen; 1 if no seed differs.
    """
    if worse + better == 0:
        return 1.0
    return _rejection_probability(seeds, float(_mid_p(seeds)[worse + better, worse]))


@lru_cache(maxsize=1024)
def critical_worsenings(seeds: int, level: float) -> NDArray[np.int64]:
    """Rejection region of `discordance_p_value`: the fewest worse seeds for each number of discordant ones.

    Args:
        seeds: All seeds.
        level: The level of the test.

    Returns:
        For 0 … ``seeds`` discordant seeds the critical number, ``seeds + 1`` where none rejects; shape (n + 1,).
    """
    table = _mid_p(seeds)
    candidates = np.unique(table[table <= 1.0])
    low, high = 0, len(candidates)
    while low < high:
        middle = (low + high) // 2
        if _rejection_probability(seeds, float(candidates[middle])) <= level:
            low = middle + 1
        else:
            high = middle
    threshold = float(candidates[low - 1]) if low else -1.0
    return _critical(seeds, threshold)


def worsening_below(worse: int, seeds: int, margin: float) -> float:
    """P-value of the null hypothesis that success fell by the margin or more.

    The loss of success is at most the probability that a seed is worse on any design, so that P(X <= worse) of X ~
    Bin(seeds, margin) bounds the probability of so few deteriorations.

    Args:
        worse: Number of seeds that are worse on some design.
        seeds: Number of seeds.
        margin: The share that success may fall by, between 0 and 1.

    Raises:
        DefinitionError: The margin is not a share between 0 and 1.
    """
    if not 0.0 < margin < 1.0:
        raise DefinitionError(
            f"the margin of a success is {margin:g}", hint="give a share between 0 and 1, such as 20 %"
        )
    terms = (comb(seeds, count) * margin**count * (1.0 - margin) ** (seeds - count) for count in range(worse + 1))
    return min(1.0, fsum(terms))


def _rejection_probability(seeds: int, threshold: float) -> float:
    """The greatest probability over ψ that the mid-p is at most a threshold."""
    tails = _upper_tails(seeds)
    reached = tails[np.arange(seeds + 1), _critical(seeds, threshold)]
    return float(min(1.0, np.max(_discordance(seeds) @ reached)))


def _critical(seeds: int, threshold: float) -> NDArray[np.int64]:
    table = _mid_p(seeds)
    below = table <= threshold * (1.0 + _TIE)
    return np.where(below.any(axis=1), below.argmax(axis=1), seeds + 1)


@lru_cache(maxsize=64)
def _mid_p(seeds: int) -> NDArray[np.float64]:
    """McNemar's mid-p by discordant seeds and worse ones, shape (n + 1, n + 1); 2 where impossible, 1 at none."""
    table = np.full((seeds + 1, seeds + 1), 2.0)
    tails = _upper_tails(seeds)
    for discordant in range(1, seeds + 1):
        row = tails[discordant]
        table[discordant, : discordant + 1] = 0.5 * (row[: discordant + 1] + row[1 : discordant + 2])
    table[0, 0] = 1.0
    return table


@lru_cache(maxsize=64)
def _upper_tails(seeds: int) -> NDArray[np.float64]:
    """``P(X >= b)`` of ``X ~ Bin(d, 1/2)`` by d and b, shape (n + 1, n + 2)."""
    tails = np.zeros((seeds + 1, seeds + 2))
    tails[:, 0] = 1.0
    for discordant in range(1, seeds + 1):
        tails[discordant, 1:] = 0.5 * (tails[discordant - 1, 1:] + tails[discordant - 1, :-1])
    return tails


@lru_cache(maxsize=64)
def _discordance(seeds: int) -> NDArray[np.float64]:
    """Probability of each number of discordant seeds on a grid of ψ, shape (grid, n + 1)."""
    counts = np.arange(seeds + 1)
    ways = np.array([lgamma(seeds + 1) - lgamma(k + 1) - lgamma(seeds - k + 1) for k in counts.tolist()])
    rates = np.linspace(0.0, 1.0, _GRID)[1:-1, None]
    inner = np.exp(ways + counts * np.log(rates) + (seeds - counts) * np.log1p(-rates))
    last = np.zeros((1, seeds + 1))
    last[0, -1] = 1.0
    return np.vstack([inner, last])
