"""Estimates from repeated trials, with intervals of 95 % confidence."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from rgss.measures.mean_limits import mean_limits

CONFIDENCE = 0.95
"""Confidence of an interval; each of its ends is wrong with at most half of the rest."""

_TAIL = (1.0 - CONFIDENCE) / 2.0
_DIGITS = 12


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """Estimate of a measure of one variant.

    Attributes:
        value: The value; None where no trial gave one.
        unit: Its unit.
        low: Lower end of the interval: the true value is lower with a probability of at most
            2.5 %; None where it is unknown.
        high: Upper end of the interval: the true value is higher with a probability of at most
            2.5 %; None where it is unknown.
        n: Trials behind it; 0 when it follows from the design alone (then low, high
            and value are equal) or when there is no value.
    """

    value: float | None
    unit: str
    low: float | None
    high: float | None
    n: int

    @staticmethod
    def exact(value: float, unit: str) -> Estimate:
        """The estimate of a value that follows from the design alone."""
        return Estimate(value=value, unit=unit, low=value, high=value, n=0)

    @staticmethod
    def unknown(unit: str) -> Estimate:
        """The estimate where no trial gave a value."""
        return Estimate(value=None, unit=unit, low=None, high=None, n=0)


def mean_estimate(
    values: Sequence[float], unit: str, *, least: float | None = None, most: float | None = None
) -> Estimate:
    """The mean of trial values with limits that assume no shape of their distribution.

    The limits are those of `rgss.measures.mean_limits`: valid for any distribution between the
    bounds, and, on a side without a bound, for any whose values are at most ten times the mean size
    of those that were seen. Bounds that trials contradict are widened to them.

    Args:
        values: The trial values.
        unit: Their unit.
        least: The least possible value; None where none is known.
        most: The greatest possible value; None where none is known.
    """
    if not values:
        return Estimate.unknown(unit)
    low, high = mean_limits(values, least=least, most=most, tail=_TAIL)
    return Estimate(value=math.fsum(values) / len(values), unit=unit, low=low, high=high, n=len(values))


def proportion_estimate(successes: int, trials: int) -> Estimate:
    """A proportion with the interval of Clopper and Pearson (1934), which is known for one trial too.

    Its ends are quantiles of two posteriors, Beta(k, n - k + 1) and Beta(k + 1, n - k): each has the
    prior that is least favourable to its end, so that the coverage of each is at least its level.
    Jeffreys's and Wilson's intervals are shorter, and wrong more often for some proportions.

    Args:
        successes: Trials that count.
        trials: All trials.
    """
    if trials == 0:
        return Estimate.unknown("1")
    low, high = _proportion_limits(successes, trials)
    return Estimate(value=successes / trials, unit="1", low=low, high=high, n=trials)


@lru_cache(maxsize=4_096)
def _proportion_limits(successes: int, trials: int) -> tuple[float, float]:
    from scipy.special import betaincinv

    low, high = 0.0, 1.0
    # Rounded, so that the last bits of a processor's functions do not show.
    if successes > 0:
        low = float(f"{float(betaincinv(successes, trials - successes + 1, _TAIL)):.{_DIGITS}g}")
    if successes < trials:
        high = float(f"{float(betaincinv(successes + 1, trials - successes, 1.0 - _TAIL)):.{_DIGITS}g}")
    return low, high
