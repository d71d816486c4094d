"""Allocation of a budget of replicates to the alternatives that may be the best.

Without a budget every alternative that is not settled is replicated, so that the guarantee of the rule is reached as
early as possible. A smaller budget is spent where the choice is open: on the alternatives that the posterior draws
(`rgss.tradeoff.sequential.probability`) find better than the choice most often, as top-two procedures do (Russo,
"Simple Bayesian algorithms for best-arm identification", 2020). Alternatives tied with the choice in every draw get
none. The numbers of replicates are raised together, the fewest first, so that all are compared on common random
numbers.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

import numpy as np

from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.probability import probabilities_of_loss
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.settling import INFEASIBLE, Progress

COVERED = 0.8
"""Posterior probability that the best is among the alternatives that are replicated next."""

FEWEST_RAISED = 2
"""Alternatives that a part of a look is for, at least."""

_ROUNDING = 1e-12
_EQUAL = 1e-9


def likely_better(
    evidence: SequentialEvidence, rule: SequentialRule, chosen: int | None, among: Collection[int], *, seed: int
) -> tuple[int, ...]:
    """The choice, and the smallest set of others that contains a better one (by the margin) with probability `COVERED`.

    If no draw has a better one, all alternatives that are not settled.

    Args:
        evidence: The evidence so far.
        rule: The rule.
        chosen: The choice; None if nothing is feasible by the estimates.
        among: The alternatives that are not settled.
        seed: Seed of the posterior draws.

    Returns:
        Their ids, the choice first, then by falling probability; equals by ascending id.
    """
    chances = probabilities_of_loss(evidence, chosen, margin=rule.margin, seed=seed)
    open_ = {variant: float(chances[evidence.table.row_of(variant)]) for variant in among if variant != chosen}
    total = math.fsum(open_.values())
    needed = COVERED * total - _ROUNDING if total > 0.0 else math.inf
    members = [] if chosen is None else [chosen]
    covered = 0.0
    for variant in sorted(open_, key=lambda each: (-open_[each], each)):
        if covered >= needed:
            break
        covered += open_[variant]
        members.append(variant)
    return tuple(members)


def leaders(evidence: SequentialEvidence, progress: Progress, finalists: int, *, cap: int) -> tuple[int, ...]:
    """Finalists of a budget: those that would be chosen, then those with the greatest upper confidence bounds.

    The first have the highest value among the feasible by the estimates, including ties: an alternative that leads by a
    few lucky replicates gets as many as the others, so that the choice has the most replicates. The others are ranked
    by their value plus one standard error (`SequentialEvidence.hopes`), an upper confidence bound as in Auer,
    Cesa-Bianchi and Fischer ("Finite-time analysis of the multiarmed bandit problem", 2002): an unlucky pilot
    eliminates no alternative. All are brought to the same number of replicates, and so to the same seeds, on which
    alternatives that differ in few trials are separated. Who has as many replicates as are allowed gives up its place:
    otherwise the first ones hold all places to the end, and an alternative whose few replicates were unlucky gets no
    more of them however much budget is left.

    Args:
        evidence: The evidence so far.
        progress: Results of earlier looks: an alternative that is proven to be infeasible does not lead.
        finalists: So many with less than the most replicates lead, and all that are equal to the first.
        cap: Most replicates of an alternative.

    Returns:
        Their ids, the first one leading.
    """
    possible = [
        row
        for row, variant in enumerate(evidence.table.variants.tolist())
        if evidence.fixed_met[row] and progress.dropped.get(variant) != INFEASIBLE
    ]
    feasible = [row for row in possible if evidence.feasible[row]]
    highest = max((float(evidence.values[row]) for row in feasible), default=-math.inf)
    first = [row for row in feasible if evidence.values[row] >= highest - _EQUAL]
    hopes = evidence.hopes()
    values = np.nan_to_num(hopes.values, nan=-math.inf)
    others = sorted(
        (row for row in possible if row not in first), key=lambda row: (hopes.shortfalls[row], -values[row], row)
    )
    hold = (evidence.replicates < cap).tolist()
    leading, places = first, finalists - sum(hold[row] for row in first)
    for row in others:
        if places <= 0:
            break
        leading.append(row)
        places -= hold[row]
    return tuple(int(evidence.table.variants[row]) for row in leading)


def levelled(evidence: SequentialEvidence, rule: SequentialRule, leading: Sequence[int]) -> Mapping[int, int]:
    """The number of replicates that each of the leading alternatives should have after the next look, all the same.

    Args:
        evidence: The evidence so far.
        rule: The rule.
        leading: The alternatives.

    Returns:
        The numbers; empty where the cap is reached, or the budget has no room for one replicate of each.
    """
    ran = {variant: int(evidence.replicates[evidence.table.row_of(variant)]) for variant in leading}
    fewest = min((ran[variant] for variant in leading), default=rule.cap)
    left = math.inf if rule.budget is None else rule.budget - int(evidence.replicates.sum())
    for target in range(min(fewest + rule.batch, rule.cap), fewest, -1):
        raised = {variant: target for variant in leading if ran[variant] < target}
        if sum(target - ran[variant] for variant in raised) <= left:
            return raised
    return {}


def raised_together(evidence: SequentialEvidence, rule: SequentialRule, members: Sequence[int]) -> Mapping[int, int]:
    """The number of replicates that each of some alternatives should have after the next look.

    All are raised to the same number, a batch above the fewest that one of them has. Where the budget has no room
    for that the number is lower; where it has none for a replicate of each with the fewest, the last ones are left out.

    Args:
        evidence: The evidence so far.
        rule: The rule.
        members: The alternatives, the most important first.
    """
    ran = {variant: int(evidence.replicates[evidence.table.row_of(variant)]) for variant in members}
    below = {variant: count for variant, count in ran.items() if count < rule.cap}
    fewest = min(below.values(), default=rule.cap)
    left = math.inf if rule.budget is None else rule.budget - int(evidence.replicates.sum())
    for target in range(min(fewest + rule.batch, rule.cap), fewest, -1):
        raised = {variant: target for variant, count in below.items() if count < target}
        if sum(target - below[variant] for variant in raised) <= left:
            return raised
    # The choice alone is compared with nothing.
    return raised_together(evidence, rule, members[:-1]) if len(members) > FEWEST_RAISED else {}
