"""Measures without a value in any replicate, for which more replicates decide nothing."""

from __future__ import annotations

import numpy as np

from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.sequential import Allocation, Decided, Reason

FEWEST_FAILED = 60
"""After so many trials without a success its probability is below 5 % in each, with a confidence of 95 %."""


def valueless_measures(evidence: SequentialEvidence) -> tuple[str, ...]:
    """The observed measures that decide, and have no value in any replicate of any alternative."""
    return tuple(one.measure for one in evidence.observed if np.isnan(one.values).all())


def ended_without_values(
    evidence: SequentialEvidence, rule: SequentialRule, answer: Allocation | Decided, *, succeeded: int
) -> Allocation | Decided:
    """The answer of a look, or the end where more replicates would not give a measure that decides a value.

    Without a value of such a measure no alternative can be chosen. Trials that succeed do not observe it, or none
    succeeds.

    Args:
        evidence: The evidence so far.
        rule: The stopping rule.
        answer: The answer of the rule.
        succeeded: Number of successful trials so far.
    """
    if isinstance(answer, Decided) or int(evidence.replicates.min()) < rule.pilot:
        return answer
    is_shown = succeeded >= rule.pilot or int(evidence.replicates.sum()) >= FEWEST_FAILED
    ids = [int(variant) for variant in evidence.table.variants]
    contenders = tuple(each for each in ids if each not in answer.progress.dropped)
    if not (is_shown and contenders and valueless_measures(evidence)):
        return answer
    return Decided(reason=Reason.NO_VALUE, variant=None, contenders=contenders, progress=answer.progress)
