"""Reserve of trials beyond the budget, spent only if the probability of good selection is too low."""

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
    """One look of the rule, which continues beyond the budget while the probability of good selection is too low.

    A budget that suffices for most master seeds leaves a few with a doubtful choice, which the probability of good
    selection identifies (Chen and Lee, "Stochastic Simulation Optimization", 2011, stop at a probability of correct
    selection too), so that the reserve costs the others nothing.

    Args:
        evidence: As for `next_batch`.
        rule: The stopping rule.
        progress: As for `next_batch`.
        seed: Seed of the posterior draws, the same as in the report.

    Returns:
        As for `next_batch`. With a reserve, replication ends beyond the budget at the first look with the required
        probability of good selection, or when the reserve is spent.
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
