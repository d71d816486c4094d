"""Settled alternatives: those that cannot be worth more than the choice by the margin; acceptance of the choice."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field

from rgss.tradeoff.sequential.comparison import is_acceptable, is_beaten
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule

BEATEN_SHARE = 0.8
"""Share of the error rate for the comparisons of the choice with all others."""

INFEASIBLE, BEATEN = "infeasible", "beaten"

_ACCEPTED_SHARE = 0.1
_RIVALS_SHARE = 0.9


@dataclass(frozen=True, slots=True, kw_only=True)
class Progress:
    """Results of the looks so far; they only grow.

    Attributes:
        looks: Number of looks.
        rivals: The alternatives that others are compared with, with their weights, which sum to 1.
        dropped: The alternatives that cannot be chosen, and why.
        settled: By alternative and place of a threshold, whether it is met, where that is proven.
    """

    looks: int = 0
    rivals: tuple[tuple[int, float], ...] = ()
    dropped: Mapping[int, str] = field(default_factory=dict, hash=False)
    settled: Mapping[tuple[int, int], bool] = field(default_factory=dict, hash=False)


def unsettled(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, chosen: int | None, among: Collection[int]
) -> frozenset[int]:
    """The alternatives that may be worth more than the choice by the margin, as far as is proven.

    Args:
        evidence: The evidence.
        rule: The rule.
        progress: Results of earlier looks.
        chosen: The choice; None if nothing is feasible by the estimates.
        among: The alternatives that are compared with the choice.
    """
    possible = frozenset(variant for variant in among if progress.dropped.get(variant) != INFEASIBLE)
    if chosen is None:
        return possible - {variant for variant, why in progress.dropped.items() if why == BEATEN}
    rivals = dict(progress.rivals)
    share = _RIVALS_SHARE * rivals[chosen] if chosen in rivals else (1.0 - _RIVALS_SHARE) / len(evidence.table)
    level = rule.error_rate * BEATEN_SHARE * share
    # The pilot selected the rivals, so its replicates would bias their comparison.
    after = rule.pilot if chosen in rivals else 0
    place = evidence.table.row_of(chosen)
    return frozenset(
        variant
        for variant in possible - {chosen}
        if not evidence.is_settled_by_design(evidence.table.row_of(variant), place, rule.margin)
        and not beats(evidence, rule, evidence.table.row_of(variant), chosen, level, lead=rule.margin, after=after)
    )


def is_accepted(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, chosen: int) -> bool:
    """True if the choice is proven to violate no threshold by more than the slack.

    Args:
        evidence: The evidence.
        rule: The rule.
        progress: Results of earlier looks.
        chosen: The choice.
    """
    rivals = dict(progress.rivals)
    level = rule.error_rate * _ACCEPTED_SHARE / 2.0
    level /= len(rivals) if chosen in rivals else len(evidence.table)
    after = rule.pilot if chosen in rivals else 0
    return is_acceptable(evidence, evidence.table.row_of(chosen), level=level, slack=rule.slack, after=after)


def beats(
    evidence: SequentialEvidence, rule: SequentialRule, row: int, rival: int, level: float, *, lead: float, after: int
) -> bool:
    """True if an alternative is proven not to be worth choosing before a rival; as `is_beaten`.

    Args:
        evidence: The evidence.
        rule: The rule.
        row: The row of the alternative.
        rival: The rival.
        level: Error probability over all looks, for these two.
        lead: Lead in value that the alternative may have.
        after: So many first replicates are left out.
    """
    place = evidence.table.row_of(rival)
    return is_beaten(evidence, row, place, level=level, after=after, lead=lead, slack=rule.slack)
