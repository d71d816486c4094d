"""Estimates from repeated trials, with intervals of 95 % confidence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from rgss.measures.anytime_evidence import anytime_mean_limits, anytime_proportion_limits
from rgss.measures.mean_limits import mean_limits

CONFIDENCE = 0.95
"""Confidence level of an interval; each limit fails with at most half of the remaining probability."""

TAIL = (1.0 - CONFIDENCE) / 2.0
"""Probability beyond each limit of an interval."""

_DIGITS = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """Estimate of a measure of one variant.

    Attributes:
        value: The value; None without trial values.
        unit: Its unit.
        low: Lower limit of the interval: the true value is lower with a probability of at most 2.5 %; None if unknown.
        high: Upper limit of the interval: the true value is higher with a probability of at most 2.5 %; None if
        unknown.
        n: Number of trials; 0 if it depends only on the design (then low, high and value are equal) or without a value.
    """

    value: float | None
    unit: str
    low: float | None
    high: float | None
    n: int

    @staticmethod
    def exact(value: float, unit: str) -> Estimate:
        """Estimate of a value that depends only on the design."""
        return Estimate(value=value, unit=unit, low=value, high=value, n=0)

    @staticmethod
    def unknown(unit: str) -> Estimate:
        """Estimate without trial values."""
        return Estimate(value=None, unit=unit, low=None, high=None, n=0)


def mean_estimate(
    values: Sequence[float],
    unit: str,
    *,
    least: float | None = None,
    most: float | None = None,
    over_looks: bool = False,
) -> Estimate:
    """Mean of trial values with distribution-free confidence limits.

    The limits are those of `rgss.measures.mean_limits`: valid for any distribution between the bounds, and, on a side
    without a bound, for any whose values are at most ten times the mean absolute value of the observed ones. Bounds are
    widened to contain all trial values.

    Args:
        values: The trial values.
        unit: Their unit.
        least: The least possible value; None if unknown.
        most: The greatest possible value; None if unknown.
        over_looks: Whether the number of trials may depend on their values; the limits are then those of
            `rgss.measures.anytime_evidence`, with the same bounds.
    """
    if not values:
        return Estimate.unknown(unit)
    limits = anytime_mean_limits if over_looks else mean_limits
    low, high = limits(values, least=least, most=most, tail=TAIL)
    return Estimate(value=math.fsum(values) / len(values), unit=unit, low=low, high=high, n=len(values))


def proportion_estimate(successes: int, trials: int, *, over_looks: bool = False) -> Estimate:
    """Proportion with the Clopper-Pearson interval (1934), which is defined for one trial too.

    Its limits are quantiles of Beta(k, n - k + 1) and Beta(k + 1, n - k); the coverage of each is at least its level.
    Jeffreys's and Wilson's intervals are shorter, but below their level for some proportions.

    Args:
        successes: Number of successes.
        trials: Number of trials.
        over_looks: As for `mean_estimate`.
    """
    if trials == 0:
        return Estimate.unknown("1")
    if over_looks:
        low, high = anytime_proportion_limits(successes, trials, tail=TAIL)
    else:
        low, high = _proportion_limits(successes, trials)
    return Estimate(value=successes / trials, unit="1", low=low, high=high, n=trials)


@lru_cache(maxsize=4_096)
def _proportion_limits(successes: int, trials: int) -> tuple[float, float]:
    from scipy.special import betaincinv

    low, high = 0.0, 1.0
    # Rounded, so that differences of processors in the last bits have no effect.
    if successes > 0:
        low = float(f"{float(betaincinv(successes, trials - successes + 1, TAIL)):.{_DIGITS}g}")
    if successes < trials:
        high = float(f"{float(betaincinv(successes + 1, trials - successes, 1.0 - TAIL)):.{_DIGITS}g}")
    return low, high
