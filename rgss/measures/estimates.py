"""Estimates from repeated trials, with intervals of 95 % confidence."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from statistics import NormalDist
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

CONFIDENCE = 0.95
RESAMPLES = 2_000

_TIE = 1e-12

_MOST_KEPT_TRIALS = 16
"""Draws for so many trials are a quarter of a megabyte; those for more are drawn anew each time."""
_FEW = 7
"""NumPy adds so few numbers one after the other; a column at a time gives the same bits, and sooner."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Estimate:
    """What is known of a measure of one variant.

    Attributes:
        value: The value; None where no trial gave one.
        unit: Its unit.
        low: Lower end of the interval; None where it is unknown.
        high: Upper end of the interval; None where it is unknown.
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


def mean_estimate(values: Sequence[float], unit: str, *, seed: int) -> Estimate:
    """The mean of trial values with its bootstrap interval.

    The interval is the bias-corrected and accelerated one (BCa; Efron 1987), from 2,000
    resamples. It is reproducible: the same values and seed give the same interval. With a
    handful of trials it is narrower than its confidence claims, as every bootstrap is; with
    one trial it is unknown.

    Args:
        values: The trial values.
        unit: Their unit.
        seed: Seed of the resampling; see `interval_seed`.
    """
    if not values:
        return Estimate.unknown(unit)
    value = math.fsum(values) / len(values)
    low, high = _bootstrap_interval(values, value, seed)
    return Estimate(value=value, unit=unit, low=low, high=high, n=len(values))


def proportion_estimate(successes: int, trials: int) -> Estimate:
    """A proportion with Wilson's score interval (Wilson 1927), which is known for one trial too.

    Args:
        successes: Trials that count.
        trials: All trials.
    """
    if trials == 0:
        return Estimate.unknown("1")
    share = successes / trials
    z = NormalDist().inv_cdf(0.5 + CONFIDENCE / 2)
    spread = 1 + z * z / trials
    centre = (share + z * z / (2 * trials)) / spread
    half = z / spread * math.sqrt(share * (1 - share) / trials + z * z / (4 * trials * trials))
    # At the ends the bounds are exactly 0 and 1; rounding must not move them.
    low = 0.0 if successes == 0 else centre - half
    high = 1.0 if successes == trials else centre + half
    return Estimate(value=share, unit="1", low=low, high=high, n=trials)


def interval_seed(study_seed: int, measure: str) -> int:
    """The seed of one interval's resampling, the same on every machine and in any order.

    It is the same for every variant, so that variants with the same evidence have the same interval.
    """
    digest = hashlib.sha256(f"{study_seed}/{measure}".encode()).digest()
    return int.from_bytes(digest[:16], "big")


def _bootstrap_interval(values: Sequence[float], value: float, seed: int) -> tuple[float | None, float | None]:
    if len(values) < 2:
        return None, None
    if min(values) == max(values):
        return value, value
    import numpy as np

    # Deviations on a scale of 1: neither tiny nor huge values lose digits, and a resample whose
    # mean is the sample's mean is recognised as a tie whatever the order of its summation.
    deviations = np.asarray(values, dtype=float) - value
    scale = float(np.abs(deviations).max())
    deviations /= scale
    size = deviations.size
    draws = _resamples(seed, size)
    sums = np.add.reduce(deviations[draws.T], axis=0) if size <= _FEW else np.add.reduce(deviations[draws], axis=1)
    means = sums / size
    below = (np.count_nonzero(means < -_TIE) / RESAMPLES + np.count_nonzero(means <= _TIE) / RESAMPLES) / 2
    normal = NormalDist()
    bias = normal.inv_cdf(min(max(below, 1 / RESAMPLES), 1 - 1 / RESAMPLES))
    # The jackknife means differ from their mean by the deviations over n - 1; the factor cancels.
    acceleration = float((deviations**3).sum() / (6 * (deviations**2).sum() ** 1.5))
    shifted = [bias + normal.inv_cdf(tail) for tail in ((1 - CONFIDENCE) / 2, (1 + CONFIDENCE) / 2)]
    tails = [normal.cdf(bias + z / (1 - acceleration * z)) for z in shifted]
    means.sort()
    low, high = (_quantile(means, tail) for tail in tails)
    return value + scale * low, value + scale * high


def _resamples(seed: int, size: int) -> NDArray[Any]:
    """The trials of each resample, shape (RESAMPLES, size): the same for all variants, and drawn once."""
    return _kept_draws(seed, size) if size <= _MOST_KEPT_TRIALS else _draws(seed, size)


def _draws(seed: int, size: int) -> NDArray[Any]:
    import numpy as np

    drawn = np.random.default_rng(seed).integers(0, size, size=(RESAMPLES, size))
    drawn = np.asfortranarray(drawn) if size <= _FEW else drawn
    drawn.setflags(write=False)
    return drawn


_kept_draws = lru_cache(maxsize=256)(_draws)


def _quantile(ordered: NDArray[Any], share: float) -> float:
    """The quantile of values in ascending order, between two of them in proportion, as NumPy has it.

    A call of NumPy's own takes longer than all the rest of an interval.
    """
    place = (len(ordered) - 1) * share
    index = min(int(place), len(ordered) - 2)
    before, after, part = float(ordered[index]), float(ordered[index + 1]), place - index
    return before + (after - before) * part if part < 0.5 else after - (after - before) * (1 - part)
