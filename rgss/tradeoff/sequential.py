"""Replication until decided: which alternatives need more replicates, and when none does.

The rule keeps a set of alternatives that may still be the best one. An alternative leaves it when
it is proven to be infeasible, or to be beaten by a rival. Let i* be the best feasible alternative.
Only i* can be dropped wrongly, so the probability of an error is that of tests of i* alone: it is
*not* divided among all pairs. The rivals are chosen by the first replicates (the pilot) and held
against the others by the replicates after it; all of them are tests that stay valid under any
number of looks (`rgss.tradeoff.sequential_tests`), so that the rule may stop whenever it likes.

The guarantee is one of good selection with tolerances, as procedures for ranking and selection
give (Kim and Nelson, "A fully sequential procedure for indifference-zone selection in simulation",
2001; Andradóttir and Kim, "Fully sequential procedures for comparing constrained systems via
simulation", 2010): if it says decided, then with probability at least 1 - α the alternative chosen
is worth no less than i* by more than the margin, and violates no threshold by more than the slack.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from rgss.errors import TradeoffError
from rgss.measures import Verdict
from rgss.tradeoff.conditions import EVIDENCE_PREFIX
from rgss.tradeoff.sequential_comparison import is_acceptable, is_beaten, is_infeasible, threshold_evidence
from rgss.tradeoff.sequential_evidence import SequentialEvidence

_INFEASIBLE_SHARE, _ACCEPTED_SHARE, _BEATEN_SHARE = 0.1, 0.1, 0.8
_DROP_SHARE = 0.8
_GROUP_SHARES = (0.75, 0.25)
_TIE = 1e-9
_LEVEL_STEP = 1.3

INFEASIBLE, BEATEN = "infeasible", "beaten"


class Reason(str, Enum):
    """Why replication ends."""

    DECIDED = "decided"
    """The decision stands with the stated probability, and no verdict is worth more replicates."""
    CAP = "cap"
    """Alternatives that may be the best have as many replicates as are allowed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SequentialRule:
    """When to go on and when to stop.

    Attributes:
        error_rate: α: probability that the decision is called decided and is wrong; and, of each
            verdict that is not inconclusive, that it is wrong.
        margin: Difference of value that is practically none: the indifference zone.
        slack: Share of a threshold by which it may be missed before it matters to the decision.
        pilot: Replicates that every alternative gets.
        batch: Replicates that are added at a look.
        cap: Most replicates of an alternative.
        verdict_cap: Most replicates of an alternative that only its verdicts ask for.

    Raises:
        TradeoffError: A number is out of its range.
    """

    error_rate: float = 0.05
    margin: float = 0.05
    slack: float = 0.1
    pilot: int = 8
    batch: int = 4
    cap: int = 200
    verdict_cap: int = 16

    def __post_init__(self) -> None:
        if not 0.0 < self.error_rate < 1.0:
            raise TradeoffError(f"an error rate of {self.error_rate:g} is none", hint="give one such as 0.05")
        for name, number in (("margin", self.margin), ("slack", self.slack)):
            if not (math.isfinite(number) and 0.0 <= number < 1.0):
                raise TradeoffError(f"the {name} is {number:g}", hint="give a number from 0 to 1, such as 0.05")
        if self.pilot < 2 or self.batch < 1:
            raise TradeoffError(
                f"a pilot of {self.pilot} and batches of {self.batch} replicates tell nothing",
                hint="give a pilot of at least 2 and batches of at least 1",
            )
        if self.cap < self.pilot or not 0 <= self.verdict_cap <= self.cap:
            raise TradeoffError(
                f"a cap of {self.cap}, one for verdicts of {self.verdict_cap} and a pilot of {self.pilot} do not agree",
                hint="the cap is the largest of the three",
            )


@dataclass(frozen=True, slots=True, kw_only=True)
class Progress:
    """What earlier looks found; it only grows.

    Attributes:
        looks: How often was looked.
        rivals: The alternatives that others are held against, with their weights, which sum to 1.
        dropped: The alternatives that cannot be chosen, and why.
        settled: By alternative and place of a threshold, whether it is met, where that is proven.
    """

    looks: int = 0
    rivals: tuple[tuple[int, float], ...] = ()
    dropped: Mapping[int, str] = field(default_factory=dict, hash=False)
    settled: Mapping[tuple[int, int], bool] = field(default_factory=dict, hash=False)


@dataclass(frozen=True, slots=True, kw_only=True)
class Allocation:
    """More replicates are needed.

    Attributes:
        replicates: The number that each of some alternatives should have in all.
        progress: What was found so far.
    """

    replicates: Mapping[int, int] = field(hash=False)
    progress: Progress


@dataclass(frozen=True, slots=True, kw_only=True)
class Decided:
    """No more replicates are added.

    Attributes:
        reason: Why.
        variant: The alternative that is chosen; None if none meets every requirement.
        contenders: The alternatives that may be the best.
        verdicts: By alternative, the verdict on each requirement.
        progress: What was found.
    """

    reason: Reason
    variant: int | None
    contenders: tuple[int, ...]
    verdicts: Mapping[int, Mapping[str, Verdict]] = field(hash=False)
    progress: Progress


def next_batch(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress) -> Allocation | Decided:
    """Tell which alternatives need more replicates, or that none does.

    Args:
        evidence: The evidence so far; replicate k of every alternative has the same seed.
        rule: When to stop.
        progress: What the last look gave; ``Progress()`` at first.

    Returns:
        An allocation, or the end. The same arguments give the same answer.
    """
    ids = [int(variant) for variant in evidence.table.variants]
    pilot = {each: rule.pilot for each, ran in zip(ids, evidence.replicates, strict=True) if ran < rule.pilot}
    progress = replace(progress, looks=progress.looks + 1)
    if pilot and evidence.observed:
        return Allocation(replicates=pilot, progress=progress)
    if not progress.rivals:
        progress = replace(progress, rivals=_rivals(evidence, rule.slack))
    progress = replace(progress, settled=_settled(evidence, rule, progress))
    progress = replace(progress, dropped=_dropped(evidence, rule, progress))
    contenders = tuple(each for each in ids if each not in progress.dropped)
    chosen = _chosen(evidence, contenders)
    decided = not contenders or (chosen is not None and _is_decided(evidence, rule, progress, contenders, chosen))
    wanted: dict[int, int] = {}
    for row, variant in enumerate(ids):
        ran = int(evidence.replicates[row])
        most = 0
        if variant in contenders and not decided:
            most = rule.cap
        elif _is_open(evidence, progress, row):
            most = rule.verdict_cap
        if ran < most:
            wanted[variant] = min(ran + rule.batch, most)
    if wanted and evidence.observed:
        return Allocation(replicates=wanted, progress=progress)
    return Decided(
        reason=Reason.DECIDED if decided else Reason.CAP,
        variant=chosen,
        contenders=contenders,
        verdicts=_verdicts(evidence, progress),
        progress=progress,
    )


def _rivals(evidence: SequentialEvidence, slack: float) -> tuple[tuple[int, float], ...]:
    """The alternatives that look best after the pilot, and those that could be best with better luck.

    The first group has the highest value, ties together. The second insures against what may befall
    all of it: of those that share no trials with it, the group that would have the highest value if
    proportions were as high as the pilot leaves open (optimism in the face of uncertainty; Lai and
    Robbins, "Asymptotically efficient adaptive allocation rules", 1985).
    """
    promising = [row for row in range(len(evidence.table)) if evidence.is_nearly_feasible(row, slack)]
    hoped = evidence.optimistic_values()
    hopeful = [row for row in range(len(evidence.table)) if not np.isnan(hoped[row])]
    first = _best(promising, evidence.values.tolist())
    second = _best([row for row in hopeful if not first or not _shares_trials(evidence, first[0], row)], hoped.tolist())
    groups = [group for group in (first, second) if group]
    whole = math.fsum(_GROUP_SHARES[: len(groups)])
    return tuple(
        (int(evidence.table.variants[row]), share / whole / len(group))
        for share, group in zip(_GROUP_SHARES, groups, strict=False)
        for row in group
    )


def _best(rows: list[int], values: list[float]) -> list[int]:
    """The rows of the highest value, ties together."""
    highest = max((values[row] for row in rows), default=-math.inf)
    return [row for row in rows if values[row] >= highest - _TIE]


def _shares_trials(evidence: SequentialEvidence, row: int, other: int) -> bool:
    """Whether some mean is the same in every replicate: the two stand on the same plans, or executions."""
    return any(
        np.array_equal(one.values[row], one.values[other], equal_nan=True)
        for one in evidence.observed
        if not one.is_proportion
    )


def _dropped(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress) -> dict[int, str]:
    ids = evidence.table.variants.tolist()
    level = rule.error_rate * _INFEASIBLE_SHARE
    infeasible = {
        variant: INFEASIBLE
        for row, variant in enumerate(ids)
        if progress.dropped.get(variant) == INFEASIBLE or is_infeasible(evidence, row, level)
    }
    rivals = {variant: share for variant, share in progress.rivals if variant not in infeasible}
    dropped = dict(infeasible)
    # Whoever was beaten by a rival that turns out to be infeasible is looked at anew.
    if not any(variant in infeasible and progress.dropped.get(variant) != INFEASIBLE for variant, _ in progress.rivals):
        dropped = {**progress.dropped, **infeasible}
    for row, variant in enumerate(ids):
        if variant not in dropped and _is_beaten(evidence, rule, row, rivals, only_strictly=variant in rivals):
            dropped[variant] = BEATEN
    return dropped


def _is_beaten(
    evidence: SequentialEvidence, rule: SequentialRule, row: int, rivals: Mapping[int, float], *, only_strictly: bool
) -> bool:
    """Whether the rivals together prove that an alternative is not worth choosing.

    The smallest level at which a rival's test rejects is one over an e-value; were the alternative
    the best, each would have an expectation of at most 1, and so would their weighted mean.
    """
    # A rival is dropped for what is strictly better, so that tolerances do not add up in a chain.
    lead = 0.0 if only_strictly else rule.margin * _DROP_SHARE
    total = rule.error_rate * _BEATEN_SHARE
    variant = int(evidence.table.variants[row])
    found = 0.0
    for rival, weight in rivals.items():
        if rival == variant:
            continue
        needed = (1.0 / total - found) / weight
        evident, tried = 0.0, 1.0 / total
        while tried > evident and _beats(evidence, rule, row, rival, 1.0 / tried, lead):
            evident = tried
            tried = min(tried * _LEVEL_STEP, needed)
        if evident >= needed:
            return True
        found += weight * evident
    return False


def _is_decided(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, contenders: tuple[int, ...], chosen: int
) -> bool:
    """Whether the chosen one is acceptable, and nothing that is left is better by more than the margin."""
    rivals = dict(progress.rivals)
    place = evidence.table.row_of(chosen)
    level = rule.error_rate * _ACCEPTED_SHARE / 2.0
    level /= len(rivals) if chosen in rivals else len(evidence.table)
    # The pilot chose the rivals, so that it cannot speak for them again.
    after = rule.pilot if chosen in rivals else 0
    if not is_acceptable(evidence, place, level=level, slack=rule.slack, after=after):
        return False
    others = [variant for variant in contenders if variant != chosen]
    if not others:
        return True
    if chosen not in rivals:
        return False
    level = rule.error_rate * _BEATEN_SHARE * rivals[chosen]
    lead = rule.margin * (1.0 - _DROP_SHARE)
    return all(_beats(evidence, rule, evidence.table.row_of(variant), chosen, level, lead) for variant in others)


def _beats(evidence: SequentialEvidence, rule: SequentialRule, row: int, rival: int, level: float, lead: float) -> bool:
    return is_beaten(
        evidence, row, evidence.table.row_of(rival), level=level, after=rule.pilot, lead=lead, slack=rule.slack
    )


def _chosen(evidence: SequentialEvidence, contenders: tuple[int, ...]) -> int | None:
    """The contender of the highest value that is feasible by its estimates; the smallest id of ties."""
    best: int | None = None
    for variant in contenders:
        row = evidence.table.row_of(variant)
        if not evidence.feasible[row]:
            continue
        if best is None or evidence.values[row] > evidence.values[evidence.table.row_of(best)] + _TIE:
            best = variant
    return best


def _settled(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress) -> dict[tuple[int, int], bool]:
    settled = dict(progress.settled)
    needed = math.log(1.0 / rule.error_rate)
    for one in evidence.observed:
        for place, threshold in one.thresholds.items():
            for row, variant in enumerate(evidence.table.variants.tolist()):
                if (variant, place) in settled:
                    continue
                for met in (True, False):
                    if threshold_evidence(one, row, threshold, met=met) >= needed:
                        settled[variant, place] = met
    return settled


def _is_open(evidence: SequentialEvidence, progress: Progress, row: int) -> bool:
    variant = int(evidence.table.variants[row])
    return any((variant, place) not in progress.settled for one in evidence.observed for place in one.thresholds)


def _verdicts(evidence: SequentialEvidence, progress: Progress) -> dict[int, dict[str, Verdict]]:
    observed = {place for one in evidence.observed for place in one.thresholds}
    verdicts: dict[int, dict[str, Verdict]] = {}
    for variant in evidence.table.variants.tolist():
        alternative = evidence.table[evidence.table.row_of(variant)]
        answers: dict[str, list[bool | None]] = {}
        for place, threshold in enumerate(evidence.thresholds):
            answer = progress.settled.get((variant, place))
            if place not in observed:
                answer = threshold.is_met_by(threshold.statistic(alternative))
            answers.setdefault(threshold.requirement, []).append(answer)
        verdicts[variant] = {
            requirement: _verdict(each)
            for requirement, each in answers.items()
            if not requirement.startswith(EVIDENCE_PREFIX)
        }
    return verdicts


def _verdict(answers: list[bool | None]) -> Verdict:
    if False in answers:
        return Verdict.NOT_MET
    return Verdict.INCONCLUSIVE if None in answers else Verdict.MET
