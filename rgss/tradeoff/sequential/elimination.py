"""Rivals of the choice, which the pilot names, and the alternatives that are proven not to be the best."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from rgss.tradeoff.sequential.comparison import is_infeasible
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.settling import BEATEN, BEATEN_SHARE, INFEASIBLE, Progress, beats

_INFEASIBLE_SHARE = 0.1
_GROUP_SHARES = (0.75, 0.25)
_TIE = 1e-9
_LEVEL_STEP = 1.3


def rivals_after_pilot(evidence: SequentialEvidence, slack: float) -> tuple[tuple[int, float], ...]:
    """Alternatives of the highest value after the pilot, and those that could be best if the pilot was unlucky.

    The first group has the highest value, ties together. The second covers the case that
    all of it fails: of those that share no trials with it, the group that would have the highest value if
    proportions were as high as the pilot leaves open (optimism in the face of uncertainty; Lai and
    Robbins, "Asymptotically efficient adaptive allocation rules", 1985).

    Args:
        evidence: The evidence of the pilot.
        slack: Share of a threshold by which it may be missed.

    Returns:
        Each rival with its weight; the weights sum to 1.
    """
    promising = [row for row in range(len(evidence.table)) if evidence.is_nearly_feasible(row, slack)]
    hoped = evidence.optimistic_values()
    hopeful = [row for row in range(len(evidence.table)) if not np.isnan(hoped[row])]
    first = highest_rows(promising, evidence.values.tolist())
    second = highest_rows(
        [row for row in hopeful if not first or not _shares_trials(evidence, first[0], row)], hoped.tolist()
    )
    groups = [group for group in (first, second) if group]
    whole = math.fsum(_GROUP_SHARES[: len(groups)])
    return tuple(
        (int(evidence.table.variants[row]), share / whole / len(group))
        for share, group in zip(_GROUP_SHARES, groups, strict=False)
        for row in group
    )


def highest_rows(rows: list[int], values: list[float]) -> list[int]:
    """Rows of the highest value, ties together.

    Args:
        rows: The rows to choose from.
        values: Value of each alternative, by row.
    """
    highest = max((values[row] for row in rows), default=-math.inf)
    return [row for row in rows if values[row] >= highest - _TIE]


def _shares_trials(evidence: SequentialEvidence, row: int, other: int) -> bool:
    """True if some mean is the same in every replicate: the two share plans, or executions."""
    return any(
        np.array_equal(one.values[row], one.values[other], equal_nan=True)
        for one in evidence.observed
        if not one.is_proportion
    )


def eliminated(evidence: SequentialEvidence, rule: SequentialRule, progress: Progress) -> dict[int, str]:
    """Alternatives that cannot be chosen any more, each with the reason.

    The guarantee of the rule does not depend on those that are beaten, only on those that are infeasible.

    Args:
        evidence: The evidence so far.
        rule: The rule.
        progress: Results of earlier looks, and the rivals.
    """
    ids = evidence.table.variants.tolist()
    level = rule.error_rate * _INFEASIBLE_SHARE
    infeasible = {
        variant: INFEASIBLE
        for row, variant in enumerate(ids)
        if progress.dropped.get(variant) == INFEASIBLE or is_infeasible(evidence, row, level)
    }
    rivals = {variant: share for variant, share in progress.rivals if variant not in infeasible}
    dropped = dict(infeasible)
    # An alternative that was beaten by a rival now known to be infeasible is compared anew.
    if not any(variant in infeasible and progress.dropped.get(variant) != INFEASIBLE for variant, _ in progress.rivals):
        dropped = {**progress.dropped, **infeasible}
    for row, variant in enumerate(ids):
        # Only rivals that are left count, and of a higher value: equals must not beat each other until none is left.
        left = {
            rival: share
            for rival, share in rivals.items()
            if rival not in dropped and evidence.values[evidence.table.row_of(rival)] > evidence.values[row] + _TIE
        }
        if variant not in dropped and _is_beaten(evidence, rule, row, left):
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
