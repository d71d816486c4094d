"""Power of the guard: the probability with which a loss of a stated size is found with the seeds at hand."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.regression.comparing import Candidate, Series, Subject
from rgss.regression.error_rates import level_of_look
from rgss.regression.judging import LEAST_LOSS, shares_of, weights_of
from rgss.regression.mcnemar import critical_worsenings, worsening_below
from rgss.regression.paired import LEAST_SPREAD

TARGET = 0.8
"""The power for which a number of seeds is recommended."""

MOST_SEEDS = 200
"""Most seeds of a variant that a guard may take, and that are recommended."""

MEAN_LOSS = 2.0
"""The loss of a mean in margins: it is called worse only if it is beyond its margin, which a loss of one is not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Power:
    """Power of one comparison.

    Attributes:
        loss: The loss, in the metric's unit.
        probability: The probability that it is found at one of the looks, at least.
        seeds: The seeds at the last look.
        seeds_needed: The least seeds with a power of `TARGET` at the last look; None if that takes more than
            `MOST_SEEDS`.
        detectable: The least loss of a mean that is found with a power of `TARGET` by these seeds, in the metric's
            unit; None for a success, and where no loss is.
    """

    loss: float
    probability: float
    seeds: int
    seeds_needed: int | None
    detectable: float | None = None


def powers(
    candidates: Sequence[Candidate], seeds_at: Mapping[str, Sequence[int]], *, error_rate: float
) -> dict[Subject, Power]:
    """Power of every comparison, from the baseline's values only.

    The designs of a seed succeed and fail together. For success, the lower power of two models is reported: loss of a
    share of the successes, and independent new outcomes of each seed. For a mean, baseline and present of a seed are
    independent and normal; a change that preserves the seeds' noise is found more often. All other comparisons use
    their part of the error rate, as if all of them had changed.

    Args:
        candidates: All comparisons with all seeds of the baseline.
        seeds_at: For each run, the number of seeds at each look.
        error_rate: The error rate of all looks.

    Returns:
        The power by subject, without those whose baseline has no noise, or cannot deteriorate.
    """
    changed = [_as_changed(one) for one in candidates]
    found = {}
    for one, weight in zip(changed, weights_of(changed), strict=True):
        seeds = tuple(seeds_at[one.subject.run])
        looks = tuple(level_of_look(look, len(seeds), error_rate) for look in range(1, len(seeds) + 1))
        share = shares_of(one, weight)[0]
        rows = _by_seed(one.baseline)
        power = (
            _success(math.fsum(rows) / len(rows) if len(rows) else 0.0, one.guard.margin, seeds, looks, share)
            if one.guard.is_success
            else _of_mean(rows, one.guard.margin, seeds, looks, share)
        )
        if power is not None:
            found[one.subject] = power
    return found


def success_power(
    worse: float, better: float, margin: float, seeds: Sequence[int], levels: Sequence[float], share: float
) -> float:
    """Exact probability that a loss of success is found at one of the looks.

    The joint distribution of worse and better seeds is propagated from look to look, without the outcomes decided at
    earlier looks.

    Args:
        worse: Probability that a seed is worse.
        better: Probability that a seed is better.
        margin: The margin of success.
        seeds: Seeds at each look.
        levels: The error rate of each look.
        share: The share of it that this test has.
    """
    size = max(seeds) + 1
    distribution = np.zeros((size, size))
    distribution[0, 0] = 1.0
    rows, columns = np.indices((size, size))
    drawn, found = 0, 0.0
    for count, level in zip(seeds, levels, strict=True):
        for _ in range(count - drawn):
            distribution = _one_more_seed(distribution, worse, better)
        drawn = count
        critical = critical_worsenings(count, level * share)
        rejected = (rows >= critical[np.minimum(rows + columns, count)]) & (rows + columns <= count)
        rejected &= (rows - columns) >= LEAST_LOSS * margin * count - 1e-9
        found += float(distribution[rejected].sum())
        distribution[rejected] = 0.0
        most = next(each for each in range(count, -2, -1) if each < 0 or worsening_below(each, count, margin) <= level)
        distribution[np.maximum(rows, columns) <= most] = 0.0
    return min(1.0, found)


def _success(
    rate: float, margin: float, seeds: tuple[int, ...], levels: tuple[float, ...], share: float
) -> Power | None:
    if not rate >= margin:
        return None
    return Power(
        loss=margin,
        probability=min(success_power(*each, margin, seeds, levels, share) for each in _loss_models(rate, margin)),
        seeds=seeds[-1],
        seeds_needed=_needed(round(rate, 9), round(margin, 9), round(levels[-1], 12), round(share, 12)),
    )


@lru_cache(maxsize=256)
def _needed(rate: float, margin: float, level: float, share: float) -> int | None:
    models = _loss_models(rate, margin)
    return _least(lambda count: min(success_power(*each, margin, (count,), (level,), share) for each in models))


def _loss_models(rate: float, margin: float) -> tuple[tuple[float, float], ...]:
    """Probabilities that a seed is worse and better: only successes are lost, or each seed has a new outcome."""
    now = rate - margin
    return (margin, 0.0), (rate * (1.0 - now), now * (1.0 - rate))


def _of_mean(
    rows: NDArray[np.float64], margin: float, seeds: tuple[int, ...], levels: tuple[float, ...], share: float
) -> Power | None:
    if len(rows) < 2:
        return None
    # Two independent draws differ with twice the variance of one.
    spread = max(math.sqrt(2.0) * float(np.std(rows, ddof=1)), LEAST_SPREAD * margin)

    def power(count: int, beyond: float = (MEAN_LOSS - 1.0) * margin) -> float:
        return mean_power(beyond, spread, count, levels[-1] * share)

    # A loss beyond the margin may be called the same at an earlier look, with at most the part of that look.
    called_same = math.fsum(levels[:-1])
    beyond = _least_found(lambda size: power(seeds[-1], size) - called_same, spread)
    return Power(
        loss=MEAN_LOSS * margin,
        probability=max(0.0, power(seeds[-1]) - called_same),
        seeds=seeds[-1],
        seeds_needed=_least(power),
        detectable=None if beyond is None else margin + beyond,
    )


def _least_found(power: Callable[[float], float], spread: float) -> float | None:
    """Distance beyond its margin at which a mean is found with the wanted power, by bisection.

    Args:
        power: The power by the distance from the margin, increasing.
        spread: Standard deviation of the differences.

    Returns:
        The distance to a thousandth; None if a hundred standard deviations are not enough.
    """
    low, high = 0.0, 100.0 * spread
    if power(high) < TARGET:
        return None
    while high - low > 1e-3 * high:
        middle = 0.5 * (low + high)
        if power(middle) >= TARGET:
            high = middle
        else:
            low = middle
    return high


def mean_power(beyond: float, spread: float, seeds: int, level: float) -> float:
    """Power of Student's one-sided test of a mean difference, from the noncentral t distribution.

    Args:
        beyond: How far the mean is beyond the limit that it is tested against.
        spread: Standard deviation of the differences.
        seeds: How many differences there are.
        level: The level of the test.
    """
    from scipy.special import nctdtr, stdtrit

    critical = float(stdtrit(seeds - 1, 1.0 - level))
    centre = beyond / spread * math.sqrt(seeds)
    if centre > 2.0 * critical + 30.0:  # where the distribution function is out of its range
        return 1.0
    return float(min(1.0, max(0.0, 1.0 - nctdtr(seeds - 1, centre, critical))))


def _least(power: Callable[[int], float]) -> int | None:
    """The least number of seeds with the wanted power, by bisection."""
    low, high = 2, MOST_SEEDS
    if power(high) < TARGET:
        return None
    while low < high:
        middle = (low + high) // 2
        if power(middle) >= TARGET:
            high = middle
        else:
            low = middle + 1
    return low


def _as_changed(one: Candidate) -> Candidate:
    return replace(one, identical=False)


def _by_seed(series: Series) -> NDArray[np.float64]:
    """The mean of the designs for each seed that any of them has a value of."""
    found = []
    for seed in sorted({seed for row in series.values() for seed in row}):
        known = [value for row in series.values() if (value := row.get(seed)) is not None]
        if known:
            found.append(math.fsum(known) / len(known))
    return np.array(found)


def _one_more_seed(distribution: NDArray[np.float64], worse: float, better: float) -> NDArray[np.float64]:
    after = (1.0 - worse - better) * distribution
    after[1:, :] += worse * distribution[:-1, :]
    after[:, 1:] += better * distribution[:, :-1]
    return np.asarray(after)
