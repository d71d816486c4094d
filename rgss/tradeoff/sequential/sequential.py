"""Replication until decided: which alternatives need more replicates, and when none does.

The rule has a choice, an alternative that it would name now, and holds it against all others. Let i*
be the best feasible alternative. The decision is wrong only if i* was taken for infeasible, if the
choice was taken for acceptable, or if i* was taken for worth no more than the choice by the margin.
So only tests of i* and of the choice can err: α is *not* divided among all pairs, but among those
that may become the choice. These are the rivals, which the first replicates (the pilot) name and the
replicates after it judge; what is left of α is for all others. Everything is a test that stays valid
under any number of looks (`rgss.tradeoff.sequential.tests`), so that the rule may stop when it likes
and may leave those alone for which there is nothing left to show.

What is within the margin of the choice is settled as well as what is worth less. That ends the race of
alternatives that hardly any trial separates, as planning limits that seldom bind: after n replicates
without any difference two proportions differ by less than about ln(1/level)/n.

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

from rgss.measures import Verdict
from rgss.tradeoff.problem import EVIDENCE_PREFIX
from rgss.tradeoff.sequential.comparison import is_acceptable, is_beaten, is_infeasible, threshold_evidence
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule, affordable_replicates, check_pilot

_INFEASIBLE_SHARE, _ACCEPTED_SHARE, _BEATEN_SHARE = 0.1, 0.1, 0.8
_RIVALS_SHARE = 0.9
_GROUP_SHARES = (0.75, 0.25)
_TIE = 1e-9
_LEVEL_STEP = 1.3

INFEASIBLE, BEATEN = "infeasible", "beaten"


class Reason(str, Enum):
    """Why replication ends."""

    DECIDED = "decided"
    """The decision stands with the stated probability, and no verdict is worth more replicates."""
    BUDGET = "budget"
    """The budget of trials has no room for what is still open."""
    CAP = "cap"
    """Alternatives that may be the best have as many replicates as are allowed."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Progress:
    """What earlier looks found; it only grows.

    Attributes:
        looks: How often was looked.
        rivals: The alternatives that others are compared with, with their weights, which sum to 1.
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
        contenders: The alternatives that may be the best; if it is decided, those that the choice
            may fall short of, by less than the margin.
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
        check_pilot(rule, len(ids))
        return Allocation(replicates=pilot, progress=progress)
    if not progress.rivals:
        progress = replace(progress, rivals=_rivals(evidence, rule.slack))
    progress = replace(progress, settled=_settled(evidence, rule, progress))
    progress = replace(progress, dropped=_dropped(evidence, rule, progress))
    contenders = tuple(each for each in ids if each not in progress.dropped)
    chosen = _chosen(evidence, contenders)
    open_pairs = _unsettled(evidence, rule, progress, chosen)
    accepted = chosen is not None and _is_accepted(evidence, rule, progress, chosen)
    decided = (accepted and not open_pairs) or not any(progress.dropped.get(each) != INFEASIBLE for each in ids)
    wanted: dict[int, int] = {}
    for row, variant in enumerate(ids):
        ran = int(evidence.replicates[row])
        most = 0
        if not decided and (variant == chosen or variant in open_pairs):
            most = rule.cap
        elif _is_open(evidence, progress, row):
            most = rule.verdict_cap
        if ran < most:
            wanted[variant] = min(ran + rule.batch, most)
    affordable = affordable_replicates(evidence, rule, wanted, first=chosen)
    if affordable and evidence.observed:
        return Allocation(replicates=affordable, progress=progress)
    ended = Reason.BUDGET if wanted and evidence.observed else Reason.CAP
    return Decided(
        reason=Reason.DECIDED if decided else ended,
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
    """Whether some mean is the same in every replicate: the two share plans, or executions."""
    return any(
        np.array_equal(one.values[row], one.values[other], equal_nan=True)
        for one in evidence.observed
        if not one.is_proportion
    )


def _dropped(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress) -> dict[int, str]:
    """The alternatives that are proven not to be the best; that they are beaten is no part of the promise."""
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
        if variant not in dropped and _is_beaten(evidence, rule, row, rivals):
            dropped[variant] = BEATEN
    return dropped


def _is_beaten(evidence: SequentialEvidence, rule: SequentialRule, row: int, rivals: Mapping[int, float]) -> bool:
    """Whether the rivals together prove that an alternative is not worth more than each of them.

    The smallest level at which a rival's test rejects is one over an e-value; were the alternative
    the best, each would have an expectation of at most 1, and so would their weighted mean.
    """
    total = rule.error_rate * _BEATEN_SHARE
    variant = int(evidence.table.variants[row])
    found = 0.0
    for rival, weight in rivals.items():
        if rival == variant:
            continue
        needed = (1.0 / total - found) / weight
        evident, tried = 0.0, 1.0 / total
        while tried > evident and _beats(evidence, rule, row, rival, 1.0 / tried, lead=0.0, after=rule.pilot):
            evident = tried
            tried = min(tried * _LEVEL_STEP, needed)
        if evident >= needed:
            return True
        found += weight * evident
    return False


def _unsettled(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, chosen: int | None
) -> frozenset[int]:
    """The alternatives that may be worth more than the choice by the margin, as far as is proven."""
    possible = frozenset(
        variant for variant in evidence.table.variants.tolist() if progress.dropped.get(variant) != INFEASIBLE
    )
    if chosen is None:
        return possible - {variant for variant, why in progress.dropped.items() if why == BEATEN}
    rivals = dict(progress.rivals)
    share = _RIVALS_SHARE * rivals[chosen] if chosen in rivals else (1.0 - _RIVALS_SHARE) / len(evidence.table)
    level = rule.error_rate * _BEATEN_SHARE * share
    # The pilot named the rivals, so that it cannot speak for them again.
    after = rule.pilot if chosen in rivals else 0
    return frozenset(
        variant
        for variant in possible - {chosen}
        if not _beats(evidence, rule, evidence.table.row_of(variant), chosen, level, lead=rule.margin, after=after)
    )


def _is_accepted(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, chosen: int) -> bool:
    """Whether the choice is proven to violate no threshold by more than the slack."""
    rivals = dict(progress.rivals)
    level = rule.error_rate * _ACCEPTED_SHARE / 2.0
    level /= len(rivals) if chosen in rivals else len(evidence.table)
    after = rule.pilot if chosen in rivals else 0
    return is_acceptable(evidence, evidence.table.row_of(chosen), level=level, slack=rule.slack, after=after)


def _beats(
    evidence: SequentialEvidence, rule: SequentialRule, row: int, rival: int, level: float, *, lead: float, after: int
) -> bool:
    place = evidence.table.row_of(rival)
    return is_beaten(evidence, row, place, level=level, after=after, lead=lead, slack=rule.slack)


def _chosen(evidence: SequentialEvidence, contenders: tuple[int, ...]) -> int | None:
    """The contender of the highest value that is feasible by its estimates; the smallest id of ties.

    Only those with the most replicates count: who was left alone is known too vaguely to lead.
    """
    rows = [row for row in map(evidence.table.row_of, contenders) if evidence.feasible[row]]
    most = max((evidence.replicates[row] for row in rows), default=0)
    best = _best([row for row in rows if evidence.replicates[row] == most], evidence.values.tolist())
    return int(evidence.table.variants[best[0]]) if best else None


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
