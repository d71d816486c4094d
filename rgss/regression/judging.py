"""Tests of all comparisons together: pairs, p-values, and their adjustment."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from rgss.regression.comparing import WHOLE_TRIAL, Candidate, Comparison, Guard, Outcome, Pairs, Series
from rgss.regression.error_rates import holm_adjusted
from rgss.regression.mcnemar import discordance_p_value, worsening_below
from rgss.regression.paired import PairedMean
from rgss.regression.unseen_changes import unseen_p_value

PRIMARY_SHARE = 0.5
"""Share of the error rate that tests of the success of whole trials begin with; all others share the rest."""

WORSE_SHARE = 0.8
"""Share of a comparison's part that its test for worse begins with, where one direction is better than the other."""

LEAST_LOSS = 0.5
"""Share of its margin that success must have fallen by on average to be called worse."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PValues:
    """P-values of the null hypotheses of a comparison.

    Attributes:
        worse: Of not being worse by more than the margin.
        better: Of not being better by more than the margin.
        same: Of a change by the margin or more, in either direction.
    """

    worse: float
    better: float
    same: float


def pair(baseline: Series, current: Series, seeds: Sequence[int], guard: Guard) -> Pairs:
    """Pair the trials by variant and seed.

    The variants of a seed are averaged: they share plans, and so are one statistical unit.
    """
    worsening, net, worse_seeds, better_seeds, lost = [], [], 0, 0, 0
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
            better_seeds += any(each < 0.0 for each in found)
    return Pairs(
        worsening=np.array(worsening),
        net=tuple(net),
        worse_seeds=worse_seeds,
        better_seeds=better_seeds,
        count=len(before),
        lost=lost,
        baseline_mean=math.fsum(before) / len(before) if before else math.nan,
        current_mean=math.fsum(after) / len(after) if after else math.nan,
    )


def _p_values(one: Candidate, pairs: Pairs, mean_of: PairedMean | None) -> PValues:
    """The p-values of one comparison.

    A mean is compared with its margin. A success is worse if it fell at all, significantly, and on average by at least
    `LEAST_LOSS` of its margin: if a loss of the whole margin were required, a true loss of that size would be missed
    every other time for any number of seeds.
    """
    if one.identical:
        return PValues(worse=1.0, better=1.0, same=0.0)
    if mean_of is None:
        return PValues(worse=1.0, better=1.0, same=1.0)
    margin = one.guard.margin
    if not one.guard.is_success:
        return PValues(
            worse=mean_of.above(margin),
            better=mean_of.below(-margin),
            same=max(
                mean_of.below(margin),
                mean_of.above(-margin),
                unseen_p_value(
                    one.baseline,
                    margin,
                    len(pairs.worsening),
                    greatest_move=float(np.max(np.abs(pairs.worsening))),
                ),
            ),
        )
    seeds, mean = len(pairs.worsening), float(np.mean(pairs.worsening))
    worse, better = sum(each > 0 for each in pairs.net), sum(each < 0 for each in pairs.net)
    return PValues(
        worse=discordance_p_value(worse, better, seeds) if mean >= LEAST_LOSS * margin else 1.0,
        better=discordance_p_value(better, worse, seeds) if mean <= -LEAST_LOSS * margin else 1.0,
        same=worsening_below(max(pairs.worse_seeds, pairs.better_seeds), seeds, margin),
    )


def weights_of(candidates: Sequence[Candidate]) -> tuple[float, ...]:
    """Initial share of the error rate of each comparison in Holm's weighted procedure.

    Bitwise equal results cannot cause a false alarm and get none. The success of whole trials, the primary metric, gets
    `PRIMARY_SHARE`.
    """
    primary = [one.guard.is_success and one.subject.phase == WHOLE_TRIAL and not one.identical for one in candidates]
    others = [not first and not one.identical for first, one in zip(primary, candidates, strict=True)]
    # Where one of the two groups is empty, the other has all.
    share = PRIMARY_SHARE if any(primary) and any(others) else float(any(primary))
    return tuple(
        share / sum(primary) if first else (1.0 - share) / sum(others) if other else 0.0
        for first, other in zip(primary, others, strict=True)
    )


def shares_of(one: Candidate, weight: float) -> tuple[float, float]:
    """Division of a comparison's error rate between its tests for worse and for better."""
    share = 0.5 if one.guard.both_ways else WORSE_SHARE
    return weight * share, weight * (1.0 - share)


def judge(candidates: Sequence[Candidate], *, level: float, look: int) -> tuple[Comparison, ...]:
    """Judge all comparisons at one look.

    Claims of a change, worse and better, are adjusted together by Holm's weighted rule over all comparisons.
    That a metric is the same is a claim of its own, which no other one makes more tempting: that
    all are the same is their conjunction, whose error is that of one of them (Berger,
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
    adjusted_both = holm_adjusted(
        [*(each.worse for each in values), *(each.better for each in values)],
        [share for shares in zip(*map(shares_of, candidates, weights_of(candidates)), strict=True) for share in shares],
    )
    worse, better = adjusted_both[: len(values)], adjusted_both[len(values) :]
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
        outcome=_outcome(one.guard, pairs, p_values, level),
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


def _outcome(guard: Guard, pairs: Pairs, p_values: Mapping[str, float], level: float) -> Outcome:
    if not pairs.count and pairs.lost:
        return Outcome.MISSING
    for name, outcome in (("worse", Outcome.WORSE), ("better", Outcome.BETTER)):
        if p_values[name] <= level:
            return Outcome.MOVED if guard.both_ways else outcome
    return Outcome.SAME if p_values["same"] <= level else Outcome.INCONCLUSIVE
