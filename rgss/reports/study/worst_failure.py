"""Worst failure of a study: the failed trial that a report shows first, with the reason."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures
from rgss.evidence import Failure, TrialRecord


@dataclass(frozen=True, slots=True, kw_only=True)
class WorstFailure:
    """Failed trial that a report shows first.

    Attributes:
        key: Its key in the evidence.
        record: Its record.
        failure: Its kind.
        why: A sentence on why this trial is shown.
    """

    key: str
    record: TrialRecord
    failure: Failure
    why: str


def worst_failure(measured: Sequence[VariantMeasures], chosen: int | None) -> WorstFailure | None:
    """The worst failure; None if no trial failed.

    It is a failure of the chosen variant, or of all variants if that has none; of the most frequent kind,
    where a planning limit counts only if there is no other kind, since it stops the robot but does no harm;
    of equally frequent kinds the first in the order of `Failure`; of that kind the trial of the smallest
    seed, then of the smallest variant.

    Args:
        measured: Every variant with its trials, by ascending id.
        chosen: The chosen variant; None if there is none.
    """
    failed = [
        (key, record, record.failure)
        for entry in measured
        for key, record in zip(entry.trials, entry.records, strict=True)
        if record.failure is not None
    ]
    if not failed:
        return None
    own = [one for one in failed if one[1].variant == chosen]
    pool = own or failed
    counted = Counter(kind for _, _, kind in pool)
    limits = counted.pop(Failure.PLANNING_LIMIT, 0)
    if not counted:
        counted, limits = Counter({Failure.PLANNING_LIMIT: limits}), 0
    most = max(counted.values())
    first, *others = [kind for kind in Failure if counted[kind] == most]
    key, record, _ = min((one for one in pool if one[2] is first), key=lambda one: (one[1].seed, one[1].variant))
    whose = f"variant {chosen}" if own else "all variants"
    spared = "" if own or chosen is None else f"no trial of variant {chosen} failed; "
    if len(pool) == 1:
        why = f"{spared}the only failed trial of {whose}"
    else:
        kind = "one of the most frequent kinds" if others else "the most frequent kind"
        apart = f", apart from planning limits ({limits})," if limits else ""
        why = (
            f"{spared}{len(pool)} trials of {whose} failed; {kind}{apart} is {first.value.replace('_', ' ')} ({most}), "
            "and this is the one with the smallest seed"
        )
    return WorstFailure(key=key, record=record, failure=first, why=f"{why[0].upper()}{why[1:]}.")
