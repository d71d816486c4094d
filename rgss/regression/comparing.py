"""One metric of one phase against its baseline, and all of them judged together."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from rgss.regression.error_rates import holm_adjusted
from rgss.regression.mcnemar import discordance_p_value, worsening_below
from rgss.regression.paired import PairedMean

Series = Mapping[int, Mapping[int, float | None]]
"""Values by variant and seed; None where a trial does not tell."""

WHOLE_TRIAL = "trial"
"""In place of a phase: over the whole trial."""


class Outcome(str, Enum):
    """What is said of one metric."""

    BETTER = "better"
    SAME = "same"
    WORSE = "worse"
    INCONCLUSIVE = "inconclusive"
    MISSING = "missing"

    @property
    def is_final(self) -> bool:
        """Whether more seeds change nothing about it."""
        return self is not Outcome.INCONCLUSIVE


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Subject:
    """What is compared.

    Attributes:
        run: The run whose trials observe it.
        metric: The metric.
        phase: The phase, or ``trial``.
    """

    run: str
    metric: str
    phase: str

    def __str__(self) -> str:
        return f"{self.metric} at {self.phase}" if self.phase != WHOLE_TRIAL else f"{self.metric} of the trial"


@dataclass(frozen=True, slots=True, kw_only=True)
class Guard:
    """How a metric may move.

    Attributes:
        unit: Its unit.
        higher_is_better: Whether more of it is better.
        margin: How much worse it may get, in its unit; above 0.
        is_success: Whether it is 1 or 0 in each trial.
    """

    unit: str
    higher_is_better: bool
    margin: float
    is_success: bool


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Pairs:
    """The trials of baseline and now with the same variant and seed in which both tell the metric.

    Attributes:
        worsening: For each seed, by how much it is worse on the mean of its variants, shape (n,).
        net: For each seed of a success, on how many variants it is worse less on how many better.
        worse_seeds: How many seeds are worse on some variant.
        count: How many pairs there are.
        lost: Pairs that the baseline tells and the present does not.
        baseline_mean: Mean of the baseline's values in the pairs.
        current_mean: Mean of the present ones.
    """

    worsening: NDArray[np.float64]
    net: tuple[int, ...]
    worse_seeds: int
    count: int
    lost: int
    baseline_mean: float
    current_mean: float


@dataclass(frozen=True, slots=True, kw_only=True)
class PValues:
    """How probable what is seen would be at the edge of each hypothesis.

    Attributes:
        worse: Against it not being worse by more than the margin.
        better: Against it not being better by more than the margin.
        same: Against it being worse by the margin or more.
    """

    worse: float
    better: float
    same: float


@dataclass(frozen=True, slots=True, kw_only=True)
class Comparison:
    """A metric against its baseline.

    Attributes:
        subject: What is compared.
        guard: How it may move.
        outcome: What is said of it.
        worsening: By how much it is worse, in its unit; negative if better; None where unknown.
        low: Lower end of a 95 % interval of that.
        high: Upper end.
        baseline_mean: The baseline's mean over the pairs.
        current_mean: The present mean.
        pairs: How many trials were compared.
        lost: How many of the baseline's values have none now.
        seeds: How many seeds they have.
        look: At which look it was decided, or the last.
        identical: Whether every trial of its run is the same bit by bit, which needs no statistics.
        p_values: The adjusted p-values it was decided by; empty if there are none.
    """

    subject: Subject
    guard: Guard
    outcome: Outcome
    worsening: float | None
    low: float | None
    high: float | None
    baseline_mean: float | None
    current_mean: float | None
    pairs: int
    lost: int
    seeds: int
    look: int
    identical: bool = False
    p_values: Mapping[str, float] = field(default_factory=dict, hash=False)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Candidate:
    """A comparison that is to be judged.

    Attributes:
        subject: What is compared.
        guard: How it may move.
        baseline: The baseline's values.
        current: The present values.
        seeds: The seeds that were run by now.
        identical: Whether all trials of the run are the same bit by bit.
    """

    subject: Subject
    guard: Guard
    baseline: Series
    current: Series
    seeds: tuple[int, ...]
    identical: bool


def pair(baseline: Series, current: Series, seeds: Sequence[int], guard: Guard) -> Pairs:
    """Pair the trials by variant and seed.

    The variants of a seed are taken together to their mean difference: they share plans, and so
    are no more than one draw of chance.
    """
    worsening, net, worse_seeds, lost = [], [], 0, 0
    before: list[float] = []
    after: list[float] = []
    sign = -1.0 if guard.higher_is_better else 1.0
    for seed in seeds:
        found = []
        for variant, row in sorted(baseline.items()):
            was, now = row.get(seed), current.get(variant, {}).get(seed)
            if was is not None and now is None:
                lost += 1
            if was is None or now is None:
                continue
            before.append(was)
            after.append(now)
            found.append(sign * (now - was))
        if found:
            worsening.append(math.fsum(found) / len(found))
            net.append(round(sum(found)) if guard.is_success else 0)
            worse_seeds += any(each > 0.0 for each in found)
    return Pairs(
        worsening=np.array(worsening),
        net=tuple(net),
        worse_seeds=worse_seeds,
        count=len(before),
        lost=lost,
        baseline_mean=math.fsum(before) / len(before) if before else math.nan,
        current_mean=math.fsum(after) / len(after) if after else math.nan,
    )


def _p_values(one: Candidate, pairs: Pairs, mean_of: PairedMean | None) -> PValues:
    """The p-values of one comparison; a success is worse by McNemar's test, and if it fell by more than the margin."""
    if one.identical:
        return PValues(worse=1.0, better=1.0, same=0.0)
    if mean_of is None:
        return PValues(worse=1.0, better=1.0, same=1.0)
    margin = one.guard.margin
    if not one.guard.is_success:
        return PValues(worse=mean_of.above(margin), better=mean_of.below(-margin), same=mean_of.below(margin))
    mean = float(np.mean(pairs.worsening))
    return PValues(
        worse=discordance_p_value(pairs.net) if mean > margin else 1.0,
        better=discordance_p_value([-each for each in pairs.net]) if mean < -margin else 1.0,
        same=worsening_below(pairs.worse_seeds, len(pairs.worsening), margin),
    )


def judge(candidates: Sequence[Candidate], *, level: float, look: int) -> tuple[Comparison, ...]:
    """Judge all comparisons at one look.

    Claims of a change, worse and better, are each adjusted by Holm's rule over all comparisons.
    That a metric is not worse is a claim of its own, which no other one makes more tempting: that
    none is worse is their conjunction, whose error is that of one of them (Berger,
    "Multiparameter hypothesis testing and acceptance sampling", 1982), so it is not adjusted.

    Args:
        candidates: All comparisons, also those that were decided before: they count.
        level: The error rate of this look.
        look: Its number.
    """
    paired = [pair(one.baseline, one.current, one.seeds, one.guard) for one in candidates]
    means = [
        PairedMean(pairs.worsening, margin=one.guard.margin) if len(pairs.worsening) > 1 and not one.identical else None
        for one, pairs in zip(candidates, paired, strict=True)
    ]
    values = [_p_values(*each) for each in zip(candidates, paired, means, strict=True)]
    worse = holm_adjusted([each.worse for each in values])
    better = holm_adjusted([each.better for each in values])
    adjusted = [
        {"worse": each[0], "better": each[1], "same": each[2].same} for each in zip(worse, better, values, strict=True)
    ]
    return tuple(_judged(*each, level, look) for each in zip(candidates, paired, means, adjusted, strict=True))


def _judged(
    one: Candidate, pairs: Pairs, mean_of: PairedMean | None, p_values: Mapping[str, float], level: float, look: int
) -> Comparison:
    known = len(pairs.worsening) > 0
    low, high = (None, None) if mean_of is None else mean_of.interval()
    return Comparison(
        subject=one.subject,
        guard=one.guard,
        outcome=_outcome(pairs, p_values, level),
        worsening=float(np.mean(pairs.worsening)) if known else None,
        low=low,
        high=high,
        baseline_mean=pairs.baseline_mean if known else None,
        current_mean=pairs.current_mean if known else None,
        pairs=pairs.count,
        lost=pairs.lost,
        seeds=len(pairs.worsening),
        look=look,
        identical=one.identical,
        p_values=dict(p_values),
    )


def _outcome(pairs: Pairs, p_values: Mapping[str, float], level: float) -> Outcome:
    if not pairs.count and pairs.lost:
        return Outcome.MISSING
    if p_values["worse"] <= level:
        return Outcome.WORSE
    if p_values["better"] <= level:
        return Outcome.BETTER
    return Outcome.SAME if p_values["same"] <= level else Outcome.INCONCLUSIVE
