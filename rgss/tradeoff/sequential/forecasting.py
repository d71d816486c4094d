"""Forecast of the replicates that would settle open questions at the end of replication."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from rgss.tradeoff.sequential.comparison import verdict_evidence
from rgss.tradeoff.sequential.evidence import SequentialEvidence
from rgss.tradeoff.sequential.rule import SequentialRule
from rgss.tradeoff.sequential.settling import Progress, is_accepted, unsettled

MOST_FORECAST = 12_800
"""Replicates of an alternative beyond which nothing is forecast."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Forecast:
    """Forecast number of replicates for a settled decision, assuming further trials like the past ones.

    Attributes:
        rivals: By alternative that may be better than the choice by the margin, the total replicates of it and the
        choice to settle that; None beyond `MOST_FORECAST`.
        requirements: By open requirement of the choice, the total replicates to settle its verdict.
        accepted: The replicates of the choice to prove that it violates no threshold by more than the slack.
        trials: Number of further trials of all alternatives to settle the decision; None if any number is unknown.
    """

    rivals: Mapping[int, int | None] = field(hash=False)
    requirements: Mapping[str, int | None] = field(hash=False)
    accepted: int | None
    trials: int | None


def forecast(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, chosen: int, open_: Collection[int]
) -> Forecast:
    """Forecast the replicates that settle a choice, by repeating the existing ones in order and testing again.

    Numbers are doubled until the tests settle, so they are accurate within a factor of two if further trials are like
    the past ones: an order of magnitude for a budget, without a guarantee.

    Args:
        evidence: The evidence.
        rule: The rule.
        progress: Results of the looks.
        chosen: The choice.
        open_: The alternatives that may be better than it by the margin.
    """
    row = evidence.table.row_of(chosen)
    ran = int(evidence.replicates[row])
    rivals: dict[int, int | None] = {}
    for shared in sorted({min(ran, _ran(evidence, variant)) for variant in open_}):
        group = frozenset(variant for variant in open_ if min(ran, _ran(evidence, variant)) == shared)
        rivals.update(_rivals(evidence, rule, progress, chosen, group, shared))
    accepted = _first(ran, lambda count: is_accepted(_continued(evidence, ran, count), rule, progress, chosen))
    needed = [accepted, *rivals.values()]
    most = None if None in needed else max(count for count in needed if count is not None)
    trials = None
    if most is not None:
        more = [max(0, (count or 0) - _ran(evidence, variant)) for variant, count in rivals.items()]
        trials = max(0, most - ran) + sum(more)
    return Forecast(
        rivals={variant: rivals[variant] for variant in sorted(rivals)},
        requirements=_requirements(evidence, rule, progress, row, ran),
        accepted=accepted,
        trials=trials,
    )


def _ran(evidence: SequentialEvidence, variant: int) -> int:
    return int(evidence.replicates[evidence.table.row_of(variant)])


def _rivals(
    evidence: SequentialEvidence,
    rule: SequentialRule,
    progress: Progress,
    chosen: int,
    group: frozenset[int],
    shared: int,
) -> dict[int, int | None]:
    """The replicates that settle alternatives which share so many seeds with the choice."""
    found: dict[int, int | None] = dict.fromkeys(group)
    left, count = group, shared
    while left and count <= MOST_FORECAST:
        still = unsettled(_continued(evidence, shared, count), rule, progress, chosen, left)
        found.update(dict.fromkeys(left - still, count))
        left, count = still, 2 * count
    return found


def _requirements(
    evidence: SequentialEvidence, rule: SequentialRule, progress: Progress, row: int, ran: int
) -> dict[str, int | None]:
    variant = int(evidence.table.variants[row])
    needed = -np.log(rule.error_rate / 2.0)
    found: dict[str, int | None] = {}
    for place, one in enumerate(evidence.observed):
        for at, threshold in one.thresholds.items():
            if (variant, at) in progress.settled:
                continue

            def is_settled(count: int, place: int = place, at: int = at) -> bool:
                observed = _continued(evidence, ran, count).observed[place]
                limit = observed.thresholds[at]
                return any(verdict_evidence(observed, row, limit, met=met) >= needed for met in (True, False))

            found[threshold.requirement] = _first(ran, is_settled)
    return found


def _first(count: int, holds: Callable[[int], bool]) -> int | None:
    """The first of a number and its doublings for which something holds."""
    while count <= MOST_FORECAST:
        if holds(count):
            return count
        count *= 2
    return None


def _continued(evidence: SequentialEvidence, first: int, count: int) -> SequentialEvidence:
    """Evidence whose alternatives all repeat their first replicates until they have so many."""
    places = np.arange(count) % first
    return replace(
        evidence,
        observed=tuple(replace(one, values=one.values[:, :first][:, places]) for one in evidence.observed),
        replicates=np.full(len(evidence.table), count, dtype=np.int64),
    )
