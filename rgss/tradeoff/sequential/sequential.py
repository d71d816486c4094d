"""Replication until decided: sequential allocation of replicates, and stopping rule.

At each look the rule compares its present choice with every other alternative. Let i* be the best feasible alternative.
The decision is wrong only if i* was taken for infeasible, if the choice was wrongly taken for acceptable, or if i* was
taken for worth no more than the choice by the margin. So only tests of i* and of the choice can err: α is *not* divided
among all pairs, but among the alternatives that may become the choice. These are the rivals: the first replicates (the
pilot) select them, and only later replicates are used to compare them; the rest of α is for all others. Every test is
valid at any number of looks (`rgss.tradeoff.sequential.tests`), so that the rule may stop at any look, and may add no
replicates to alternatives that are settled.

An alternative within the margin of the choice is settled, as is one that is worth less. So alternatives that differ in
few trials, such as by a planning limit that is seldom active, are settled too: after n replicates without a difference
two proportions differ by less than about ln(1/level)/n.

The guarantee is one of good selection with tolerances, as procedures for ranking and selection
give (Kim and Nelson, "A fully sequential procedure for indifference-zone selection in simulation",
2001; Andradóttir and Kim, "Fully sequential procedures for comparing constrained systems via
simulation", 2010): if the reason is decided, then with probability at least 1 - α the alternative chosen
is worth no less than i* by more than the margin, and violates no threshold by more than the slack.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import Enum

import numpy as np

from rgss.tradeoff.problem import surpassed_equals
from rgss.tradeoff.sequential.allocation import leaders, levelled, likely_better, raised_together
from rgss.tradeoff.sequential.elimination import eliminated, highest_rows, rivals_after_pilot
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule, affordable_replicates, check_pilot
from rgss.tradeoff.sequential.settled_thresholds import has_open_threshold, settled_thresholds
from rgss.tradeoff.sequential.settling import INFEASIBLE, Progress, is_accepted, unsettled


class Reason(str, Enum):
    """Reason for the end of replication."""

    DECIDED = "decided"
    """The decision is right with the stated probability, and no verdict needs more replicates."""
    BUDGET = "budget"
    """The budget of trials has no room for what is still open."""
    CAP = "cap"
    """Alternatives that may be the best have as many replicates as are allowed."""
    NO_VALUE = "no value"
    """No trial gives a measure that decides a value, and more would not."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Allocation:
    """More replicates are needed.

    Attributes:
        replicates: The number that each of some alternatives should have in all.
        progress: Results so far.
    """

    replicates: Mapping[int, int] = field(hash=False)
    progress: Progress


@dataclass(frozen=True, slots=True, kw_only=True)
class Decided:
    """No more replicates are added.

    Attributes:
        reason: The reason.
        variant: The alternative that is chosen; None if none meets every requirement.
        contenders: The alternatives that may be the best; if it is decided, those that the choice
            may fall short of, by less than the margin.
        progress: Results of the looks.
        unsettled: The alternatives that may be worth more than the choice by the margin.
    """

    reason: Reason
    variant: int | None
    contenders: tuple[int, ...]
    progress: Progress
    unsettled: frozenset[int] = frozenset()


def next_batch(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress) -> Allocation | Decided:
    """One look of the rule: the alternatives that need more replicates, or the end of replication.

    Args:
        evidence: The evidence so far; replicate k of every alternative has the same seed.
        rule: The stopping rule.
        progress: Result of the last look; ``Progress()`` at first.

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
        progress = replace(progress, rivals=rivals_after_pilot(evidence, rule.slack))
    progress = replace(progress, settled=settled_thresholds(evidence, rule, progress))
    progress = replace(progress, dropped=eliminated(evidence, rule, progress))
    contenders = tuple(each for each in ids if each not in progress.dropped)
    chosen = _chosen(evidence, contenders, focused=rule.budget is not None)
    open_pairs = unsettled(evidence, rule, progress, chosen, ids)
    accepted = chosen is not None and is_accepted(evidence, rule, progress, chosen)
    decided = (accepted and not open_pairs) or not any(progress.dropped.get(each) != INFEASIBLE for each in ids)
    if rule.budget is not None and rule.finalists is not None and not decided:
        leading = leaders(evidence, progress, rule.finalists, cap=rule.cap)
        wanted, affordable = dict.fromkeys(leading, rule.cap), levelled(evidence, rule, leading)
    elif rule.budget is not None and not decided:
        members = likely_better(evidence, rule, chosen, open_pairs, seed=progress.looks)
        wanted = dict.fromkeys(members, rule.cap)
        affordable = raised_together(evidence, rule, members)
    else:
        wanted = _next_replicates(evidence, rule, progress, chosen=chosen, open_pairs=open_pairs, decided=decided)
        affordable = affordable_replicates(evidence, rule, wanted, first=chosen)
    if affordable and evidence.observed:
        return Allocation(replicates=affordable, progress=progress)
    ended = Reason.BUDGET if _is_spent(evidence, wanted) else Reason.CAP
    return Decided(
        reason=Reason.DECIDED if decided else ended,
        variant=chosen,
        contenders=contenders,
        progress=progress,
        unsettled=frozenset() if decided else open_pairs,
    )


def _is_spent(evidence: SequentialEvidence, wanted: Mapping[int, int]) -> bool:
    """True if it is the budget that leaves alternatives without the replicates that they should have."""
    ran = {variant: evidence.replicates[evidence.table.row_of(variant)] for variant in wanted}
    return bool(evidence.observed) and any(ran[variant] < most for variant, most in wanted.items())


def _next_replicates(
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
        elif has_open_threshold(evidence, progress, row):
            most = rule.verdict_cap
        if ran < most:
            wanted[variant] = min(ran + rule.batch, most)
    return wanted


def _chosen(evidence: SequentialEvidence, contenders: tuple[int, ...], *, focused: bool) -> int | None:
    """The contender of the highest value that is feasible by its estimates.

    Of ties it is the smallest id, or the largest, of those that no other surpasses in quantities.

    Only those with the most replicates count: the estimate of an alternative with fewer is too uncertain. Under
    a budget all count, because the leader is replicated first, and the assessment reads the same estimates.
    """
    rows = [row for row in map(evidence.table.row_of, contenders) if evidence.feasible[row]]
    most = max((evidence.replicates[row] for row in rows), default=0)
    known = [row for row in rows if focused or evidence.replicates[row] == most]
    equal = np.array(highest_rows(known, evidence.values.tolist()), dtype=np.intp)
    best = equal[~surpassed_equals(evidence.table, evidence.value_functions, equal)].tolist()
    return int(evidence.table.variants[best[-1 if evidence.last_of_equals else 0]]) if best else None
