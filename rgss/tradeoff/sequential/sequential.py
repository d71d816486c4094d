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
from rgss.tradeoff.sequential.allocation import leaders, levelled, likely_better, raised_together
from rgss.tradeoff.sequential.comparison import is_infeasible, threshold_evidence
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule, affordable_replicates, check_pilot
from rgss.tradeoff.sequential.settling import (
    BEATEN,
    BEATEN_SHARE,
    INFEASIBLE,
    Progress,
    beats,
    is_accepted,
    unsettled,
)

_INFEASIBLE_SHARE = 0.1
_GROUP_SHARES = (0.75, 0.25)
_TIE = 1e-9
_LEVEL_STEP = 1.3


class Reason(str, Enum):
    """Why replication ends."""

    DECIDED = "decided"
    """The decision stands with the stated probability, and no verdict is worth more replicates."""
    BUDGET = "budget"
    """The budget of trials has no room for what is still open."""
    CAP = "cap"
    """Alternatives that may be the best have as many replicates as are allowed."""


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
        unsettled: The alternatives that may be worth more than the choice by the margin.
    """

    reason: Reason
    variant: int | None
    contenders: tuple[int, ...]
    verdicts: Mapping[int, Mapping[str, Verdict]] = field(hash=False)
    progress: Progress
    unsettled: frozenset[int] = frozenset()


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
    chosen = _chosen(evidence, contenders, focused=rule.budget is not None)
    open_pairs = unsettled(evidence, rule, progress, chosen, ids)
    accepted = chosen is not None and is_accepted(evidence, rule, progress, chosen)
    decided = (accepted and not open_pairs) or not any(progress.dropped.get(each) != INFEASIBLE for each in ids)
    if rule.budget is not None and rule.finalists is not None and not decided:
        leading = leaders(evidence, progress, rule.finalists)
        wanted, affordable = dict.fromkeys(leading, rule.cap), levelled(evidence, rule, leading)
    elif rule.budget is not None and not decided:
        members = likely_better(evidence, rule, chosen, open_pairs, seed=progress.looks)
        wanted = dict.fromkeys(members, rule.cap)
        affordable = raised_together(evidence, rule, members)
    else:
        wanted = _wanted(evidence, rule, progress, chosen=chosen, open_pairs=open_pairs, decided=decided)
        affordable = affordable_replicates(evidence, rule, wanted, first=chosen)
    if affordable and evidence.observed:
        return Allocation(replicates=affordable, progress=progress)
    ended = Reason.BUDGET if _is_spent(evidence, wanted) else Reason.CAP
    return Decided(
        reason=Reason.DECIDED if decided else ended,
        variant=chosen,
        contenders=contenders,
        verdicts=_verdicts(evidence, progress),
        progress=progress,
        unsettled=frozenset() if decided else open_pairs,
    )


def _is_spent(evidence: SequentialEvidence, wanted: Mapping[int, int]) -> bool:
    """True if it is the budget that leaves alternatives without the replicates that they should have."""
    ran = {variant: evidence.replicates[evidence.table.row_of(variant)] for variant in wanted}
    return bool(evidence.observed) and any(ran[variant] < most for variant, most in wanted.items())


def _wanted(
    evidence: SequentialEvidence,
    rule: SequentialRule,
    progress: Progress,
    *,
    chosen: int | None,
    open_pairs: frozenset[int],
    decided: bool,
) -> dict[int, int]:
    """The replicates that everything that is open should have after the next look."""
    wanted: dict[int, int] = {}
    for row, variant in enumerate(evidence.table.variants.tolist()):
        ran = int(evidence.replicates[row])
        most = 0
        if not decided and (variant == chosen or variant in open_pairs):
            most = rule.cap
        elif _is_open(evidence, progress, row):
            most = rule.verdict_cap
        if ran < most:
            wanted[variant] = min(ran + rule.batch, most)
    return wanted


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
    """True if some mean is the same in every replicate: the two share plans, or executions."""
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
    """True if the rivals together prove that an alternative is not worth more than each of them.

    The smallest level at which a rival's test rejects is one over an e-value; were the alternative
    the best, each would have an expectation of at most 1, and so would their weighted mean.
    """
    total = rule.error_rate * BEATEN_SHARE
    variant = int(evidence.table.variants[row])
    found = 0.0
    for rival, weight in rivals.items():
        if rival == variant:
            continue
        needed = (1.0 / total - found) / weight
        evident, tried = 0.0, 1.0 / total
        while tried > evident and beats(evidence, rule, row, rival, 1.0 / tried, lead=0.0, after=rule.pilot):
            evident = tried
            tried = min(tried * _LEVEL_STEP, needed)
        if evident >= needed:
            return True
        found += weight * evident
    return False


def _chosen(evidence: SequentialEvidence, contenders: tuple[int, ...], *, focused: bool) -> int | None:
    """The contender of the highest value that is feasible by its estimates; the smallest id of ties, or the largest.

    Only those with the most replicates count: who was left alone is known too vaguely to lead. Under a budget
    all count, for whoever leads is replicated first, and the assessment reads the same estimates.
    """
    rows = [row for row in map(evidence.table.row_of, contenders) if evidence.feasible[row]]
    most = max((evidence.replicates[row] for row in rows), default=0)
    known = [row for row in rows if focused or evidence.replicates[row] == most]
    best = _best(known, evidence.values.tolist())
    return int(evidence.table.variants[best[-1 if evidence.last_of_equals else 0]]) if best else None


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
