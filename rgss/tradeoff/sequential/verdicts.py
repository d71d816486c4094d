"""Verdicts on requirements under replication: thresholds that are settled, and those still open."""

from __future__ import annotations

import math

from rgss.measures import Verdict
from rgss.tradeoff.problem import EVIDENCE_PREFIX
from rgss.tradeoff.sequential.comparison import verdict_evidence
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.settling import Progress


def settled_thresholds(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress
) -> dict[tuple[int, int], bool]:
    """Thresholds that are proven to be met or violated, by alternative and place; those of earlier looks remain.

    Args:
        evidence: The evidence so far.
        rule: The rule.
        progress: Results of earlier looks.
    """
    settled = dict(progress.settled)
    needed = math.log(1.0 / rule.error_rate)
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


def verdicts_of(evidence: SequentialEvidence, progress: Progress) -> dict[int, dict[str, Verdict]]:
    """Verdict of each alternative on each requirement; inconclusive where a threshold is not settled.

    Args:
        evidence: The evidence.
        progress: Results of the looks.
    """
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
