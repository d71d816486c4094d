"""Tests on the replicates so far: alternatives that cannot be chosen, and verdicts that cannot change."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from rgss.measures import bounded_mean_evidence, proportion_evidence
from rgss.tradeoff.problem import Comparison, Threshold, ValueFunction
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.observed import Observed
from rgss.tradeoff.sequential.tests import difference_above, mean_above, mean_evidence

_PROPORTIONS, _MEANS, _THRESHOLDS = 0.6, 0.1, 0.3


def threshold_evidence(
    observed: Observed, row: int, threshold: Threshold, *, met: bool, slack: float = 0.0, after: int = 0
) -> float:
    """Logarithm of the evidence that an alternative meets, or violates, a threshold.

    Args:
        observed: The measure that is bounded.
        row: The alternative.
        threshold: The threshold.
        met: Whether the evidence is for its being met; for its being violated otherwise.
        slack: So much of the threshold's magnitude is allowed on the bad side.
        after: So many first replicates are left out.
    """
    at_least = threshold.comparison is Comparison.AT_LEAST
    limit = threshold.value - math.copysign(slack * abs(threshold.value), 1.0 if at_least else -1.0)
    above = at_least == met
    values = observed.known(row, after=after)
    if observed.is_proportion:
        return proportion_evidence(int(values.sum()), len(values), limit, above=above)
    return mean_evidence(values, limit, above=above)


def verdict_evidence(observed: Observed, row: int, threshold: Threshold, *, met: bool) -> float:
    """Logarithm of the evidence for a verdict at the threshold itself, for any distribution within the bounds.

    Args:
        observed: The measure that is bounded.
        row: The alternative.
        threshold: The threshold.
        met: As for `threshold_evidence`.
    """
    if observed.is_proportion:
        return threshold_evidence(observed, row, threshold, met=met)
    above = (threshold.comparison is Comparison.AT_LEAST) == met
    least, most = observed.bounds_of(row)
    return bounded_mean_evidence(observed.known(row), threshold.value, above=above, least=least, most=most)


def is_infeasible(evidence: SequentialEvidence, row: int, level: float) -> bool:
    """True if an alternative is proven to violate a threshold.

    Args:
        evidence: The evidence.
        row: The alternative.
        level: Error probability over all looks: one is taken for infeasible that is not.
    """
    if not evidence.fixed_met[row]:
        return True
    bounds = [(one, threshold) for one in evidence.observed for threshold in one.thresholds.values()]
    needed = math.log(max(len(bounds), 1) / level)
    return any(threshold_evidence(one, row, threshold, met=False) >= needed for one, threshold in bounds)


def is_acceptable(evidence: SequentialEvidence, row: int, *, level: float, slack: float, after: int) -> bool:
    """True if an alternative is proven to meet every threshold but for a slack.

    Args:
        evidence: The evidence.
        row: The alternative.
        level: Error probability over all looks: one is taken for acceptable that is not.
        slack: As for `threshold_evidence`.
        after: So many first replicates are left out.
    """
    needed = math.log(1.0 / level)
    return bool(evidence.fixed_met[row]) and all(
        threshold_evidence(one, row, threshold, met=True, slack=slack, after=after) >= needed
        for one in evidence.observed
        for threshold in one.thresholds.values()
    )


def is_beaten(
    evidence: SequentialEvidence, row: int, rival: int, *, level: float, after: int, lead: float, slack: float
) -> bool:
    """True if an alternative is proven not to be worth choosing before a rival.

    It would be if it met every threshold and either were worth more than the rival by the lead, or
    the rival violated a threshold by more than the slack. Both must be refuted. The level
    is divided among the differences of proportions, which are compared seed by seed and need the
    most replicates, the difference of means, and the rival's own thresholds.

    Args:
        evidence: The evidence.
        row: The alternative.
        rival: The rival.
        level: Error probability over all looks, for these two.
        after: So many first replicates are left out, because they chose the rival.
        lead: Lead in value that the alternative may have.
        slack: As for `threshold_evidence`.
    """
    if not evidence.fixed_met[rival]:
        return False
    proportions = [one for one in evidence.observed if one.is_proportion]
    shared = int(min(evidence.replicates[row], evidence.replicates[rival]))
    share = level * _PROPORTIONS / max(1, len(proportions))
    most_more = [_most_more(one, row, rival, share, slice(after, shared)) for one in proportions]
    gain = float(evidence.fixed_value[row] - evidence.fixed_value[rival])
    for one, more in zip(proportions, most_more, strict=True):
        gain += one.weight * _largest_gain(one, more, slack)
    # An unmet threshold of the alternative makes the gain minus infinite: it cannot be chosen at all.
    if gain > lead:
        return False
    gain += _gain_of_means(evidence, row, rival, level * _MEANS, after)
    if gain > lead:
        return False
    needed = -math.log(level * _THRESHOLDS)
    bounds = dict(zip((one.measure for one in proportions), most_more, strict=True))
    return all(
        _keeps_up(threshold, bounds.get(one.measure), slack)
        or threshold_evidence(one, rival, threshold, met=True, slack=slack, after=after) >= needed
        for one in evidence.observed
        for threshold in one.thresholds.values()
    )


def _most_more(one: Observed, row: int, rival: int, level: float, seeds: slice) -> float:
    """An upper bound of the difference of two shares, seed by seed where both have a value for each seed.

    A share may be of some trials alone, such as the successful ones. If these are of other seeds, the seeds that both
    have are none of the population of either: each share is bounded by its own.
    """
    mine, theirs = one.values[row, seeds], one.values[rival, seeds]
    if not (np.isnan(mine).any() or np.isnan(theirs).any()):
        more, less = int((mine > theirs).sum()), int((mine < theirs).sum())
        return difference_above(more, less, len(mine), level)
    mine, theirs = mine[~np.isnan(mine)], theirs[~np.isnan(theirs)]
    above = difference_above(int(mine.sum()), 0, len(mine), level / 2)
    return above + difference_above(0, int(theirs.sum()), len(theirs), level / 2)


def _keeps_up(threshold: Threshold, most_more: float | None, slack: float) -> bool:
    """True if a rival is near enough to an alternative that meets the threshold."""
    if most_more is None or threshold.comparison is not Comparison.AT_LEAST:
        return False
    return most_more <= slack * abs(threshold.value)


def _largest_gain(one: Observed, most_more: float, slack: float) -> float:
    """The largest v(x) - v(y) with x - y at most so much; x meets the thresholds, y but for the slack."""
    low, high = max(0.0, one.least), min(1.0, one.most)
    if low - high > most_more:
        return -math.inf
    return 0.0 if one.function is None else _largest_difference(one.function, low, high, most_more, slack)


@lru_cache(maxsize=65_536)
def _largest_difference(function: ValueFunction, low: float, high: float, most_more: float, slack: float) -> float:
    # Many pairs of alternatives differ in as many trials: with the cache a sweep of 72 takes a third of the time.
    rivals = np.linspace(max(low - slack * abs(low), low - most_more), min(1.0, high + slack * abs(high)), 65)
    best = -math.inf
    for rival in rivals.tolist():
        top = min(high, rival + most_more)
        mine = function.value_at(top)
        if function.more_is_better is not True:
            mine = max(function.value_at(each) for each in np.linspace(low, max(top, low), 65).tolist())
        best = max(best, mine - function.value_at(rival))
    return best


def _gain_of_means(evidence: SequentialEvidence, row: int, rival: int, level: float, after: int) -> float:
    """An upper bound of the difference of value in all measures that are means.

    Each mean is expanded about its estimate: seed s adds ``w v' (x_s - m) r/k`` with the slope v' of the value
    function, r the seeds and k those that have the measure, as the influence function of a mean over some trials does.
    The sums of two alternatives are compared seed by seed. Where the slope changes within the interval of a mean, as at
    the ends of a value function, no slope stands for all of it: what the mean can gain there is bounded by itself.
    """
    means = [one for one in evidence.observed if not one.is_proportion and one.function is not None]
    if not means:
        return 0.0
    shared = int(min(evidence.replicates[row], evidence.replicates[rival]))
    if shared <= after:
        return math.inf
    scores = np.zeros(shared - after)
    difference = 0.0
    bent: list[_Term] = []
    for one in means:
        for sign, each in ((1.0, row), (-1.0, rival)):
            values = one.values[each, after:shared]
            known = ~np.isnan(values)
            if known.sum() < 2 or one.function is None:
                return math.inf
            mean = math.fsum(values[known].tolist()) / int(known.sum())
            term = _Term(one.function, sign * one.weight, mean, values[known] - mean)
            half = term.half(level)
            if not math.isfinite(half):
                return math.inf
            difference += term.weight * one.function.value_at(mean)
            slope = term.slope(half)
            if slope is None:
                bent.append(term)
            else:
                scores += term.weight * slope * np.where(known, values - mean, 0.0) * (len(values) / known.sum())
    if not bent:
        return difference + mean_above(_rounded(scores), level)
    share = level / (1 + len(bent))
    return difference + mean_above(_rounded(scores), share) + math.fsum(each.most_gain(share) for each in bent)


_PLACES = tuple(side * place / 16.0 for place in range(1, 17) for side in (-1.0, 1.0))
_LEAST_RATIO = 0.5
"""Of the slopes within the interval of a mean, from which on the steepest stands for all of them."""


@dataclass(frozen=True, slots=True, eq=False)
class _Term:
    """The value of one mean of one alternative, weighted; the weight of the rival's is negative."""

    function: ValueFunction
    weight: float
    mean: float
    deviations: NDArray[np.float64]

    def half(self, level: float) -> float:
        """Half-width of the interval of the mean."""
        return mean_above(self.deviations, level)

    def slope(self, half: float) -> float | None:
        """The steepest slope to the side that gains; None if the slope changes much within the interval."""
        if half <= 0.0:
            return 0.0
        secants = [(side, self._change(side * half) / (side * half)) for side in _PLACES]
        sizes = [abs(secant) for _, secant in secants]
        if max(sizes) == 0.0:
            return 0.0
        same_sign = min(secant for _, secant in secants) * max(secant for _, secant in secants) > 0.0
        if not same_sign or min(sizes) < _LEAST_RATIO * max(sizes):
            return None
        gaining = [secant for side, secant in secants if side * secant * self.weight > 0.0]
        return max(gaining, key=abs, default=0.0)

    def most_gain(self, level: float) -> float:
        """The most that the true mean can be worth more than the estimate, weighted."""
        half = self.half(level)
        if not math.isfinite(half):
            return math.inf
        return max(0.0, *(self.weight * self._change(side * half) for side in _PLACES))

    def _change(self, step: float) -> float:
        return self.function.value_at(self.mean + step) - self.function.value_at(self.mean)


def _rounded(scores: NDArray[np.float64]) -> NDArray[np.float64]:
    # What differs by rounding alone is the same; it must not look like a little noise.
    return np.where(np.abs(scores) < 1e-12, 0.0, scores)
