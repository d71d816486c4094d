"""A reserve beside the budget: trials that are spent only where the choice is not probable enough without them."""

from __future__ import annotations

from dataclasses import replace

from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.probability import probability_of_good_selection
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.sequential import Allocation, Decided, Reason, next_batch
from rgss.tradeoff.sequential.settling import Progress


def next_batch_with_reserve(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, *, seed: int
) -> Allocation | Decided:
    """One look of the rule, which goes on beyond a spent budget while its choice is too doubtful.

    A budget that suffices for most master seeds leaves some with a choice that is as likely wrong as right. Their
    probability of good selection says which (Chen and Lee, "Stochastic Simulation Optimization", 2011, stop at a
    probability of correct selection too), so that the reserve costs the others nothing.

    Args:
        evidence: As for `next_batch`.
        rule: The stopping rule.
        progress: As for `next_batch`.
        seed: Seed of the posterior draws, which are those that the result is reported by.

    Returns:
        As for `next_batch`. With a reserve, replication ends by its budget at the first look at which the
        probability of good selection is as high as the rule asks for, or when the reserve is spent too.
    """
    answer = next_batch(evidence, rule, progress)
    if rule.budget is None or rule.reserve is None or not isinstance(answer, Decided):
        return answer
    if answer.reason is not Reason.BUDGET:
        return answer
    probability = probability_of_good_selection(evidence, answer.variant, margin=rule.margin, seed=seed)
    if probability >= rule.good_selection:
        return answer
    return next_batch(evidence, replace(rule, budget=rule.budget + rule.reserve, reserve=None), progress)
