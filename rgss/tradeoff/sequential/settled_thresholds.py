"""Thresholds that are settled under replication, and those still open."""

from __future__ import annotations

import math

from rgss.tradeoff.sequential.comparison import verdict_evidence
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.settling import Progress


def settled_thresholds(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress
) -> dict[tuple[int, int], bool]:
    """Thresholds that are proven to be met or violated, by alternative and place; those of earlier looks remain.

    As of an interval each side is allowed half of the error rate, so that at 5 % a threshold is settled where the
    intervals of 95 % that hold over all looks decide it.
    """
    settled = dict(progress.settled)
    needed = math.log(2.0 / rule.error_rate)
    for one in evidence.observed:
        for place, threshold in one.thresholds.items():
            for row, variant in enumerate(evidence.table.variants.tolist()):
                if (variant, place) in settled:
                    continue
                for met in (True, False):
                    if verdict_evidence(one, row, threshold, met=met) >= needed:
                        settled[variant, place] = met
    return settled


def has_open_threshold(evidence: SequentialEvidence, progress: Progress, row: int) -> bool:
    """True if an observed threshold of an alternative is neither proven to be met nor to be violated.

    Args:
        evidence: The evidence so far.
        progress: Results so far.
        row: The alternative.
    """
    variant = int(evidence.table.variants[row])
    return any((variant, place) not in progress.settled for one in evidence.observed for place in one.thresholds)
