"""Trials of a report: outcomes, and selection of the notable ones."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.assessment import VariantMeasures
from rgss.evidence import Failure, PhaseOutcome, TrialRecord
from rgss.reports.plain_numbers import Plain, condensed, plain_number, plain_numbers
from rgss.reports.study.worst_failure import worst_failure
from rgss.trace.evidence import KEY_DIGITS

MOST_TIMELINES = 1_000
"""With more trials than this, only the notable ones have a timeline."""


@dataclass(frozen=True, slots=True, kw_only=True)
class NotableTrial:
    """Trial that is worth looking at.

    Attributes:
        key: Its key in the evidence.
        record: Its record.
        why: The reason, in a few words.
        worst: A sentence on why it is the worst failure; empty for other trials.
    """

    key: str
    record: TrialRecord
    why: str
    worst: str = ""


def notable_trials(measured: Sequence[VariantMeasures], chosen: int | None) -> tuple[NotableTrial, ...]:
    """The deciding trial, the worst failure, and a trial of each other kind of failure.

    The deciding trial is the first success of the chosen variant in the order of the seeds, or its
    first trial if none succeeded; it may be the worst failure itself, see `worst_failure`. Another kind of
    failure is shown by its first trial, in the order of variants and seeds, in which a state was completed,
    so that it shows motion; otherwise by its first trial.

    Args:
        measured: Every variant with its trials, by ascending id.
        chosen: The chosen variant; None if there is none.
    """
    found: list[NotableTrial] = []
    worst = worst_failure(measured, chosen)
    for entry in measured:
        if entry.variant.id == chosen and entry.records:
            pairs = list(zip(entry.trials, entry.records, strict=True))
            key, record = next((pair for pair in pairs if pair[1].success), pairs[0])
            why = "the deciding trial: the chosen variant"
            shown_worst = "" if worst is None or worst.key != key else worst.why
            found.append(NotableTrial(key=key, record=record, why=why, worst=shown_worst))
    shown = {one.key for one in found}
    if worst is not None and worst.key not in shown:
        kind = _words(worst.failure.value)
        found.append(
            NotableTrial(key=worst.key, record=worst.record, why=f"the worst failure, {kind}", worst=worst.why)
        )
    kinds = {one.record.failure for one in found}
    first: dict[Failure, NotableTrial] = {}
    for entry in measured:
        for key, record in zip(entry.trials, entry.records, strict=True):
            failure = record.failure
            if failure is None or failure in kinds:
                continue
            there = first.get(failure)
            if there is None or (_moved(record) and not _moved(there.record)):
                why = f"a failure of the kind “{_words(failure.value)}”"
                first[failure] = NotableTrial(key=key, record=record, why=why)
    return (*found, *(first[failure] for failure in Failure if failure in first))


def trial_columns(measured: Sequence[VariantMeasures], notable: Sequence[NotableTrial]) -> Plain:
    """Every trial with its outcome, and the timelines of as many as fit a page.

    Args:
        measured: Every variant with its trials.
        notable: The trials that always have a timeline.
    """
    rows = [
        (place, key, record)
        for place, entry in enumerate(measured)
        for key, record in zip(entry.trials, entry.records, strict=True)
    ]
    failures = list(Failure)
    phases = list(dict.fromkeys(phase.phase for _, _, record in rows for phase in record.phases))
    wanted = {one.key for one in notable}
    every = len(rows) <= MOST_TIMELINES
    return {
        "key_digits": KEY_DIGITS,
        "failures": [_words(one.value) for one in failures],
        "phases": [_words(one) for one in phases],
        "variant": [place for place, _, _ in rows],
        "seed": [record.seed for _, _, record in rows],
        "key": [key[:KEY_DIGITS] for _, key, _ in rows],
        "failure": condensed([-1 if r.failure is None else failures.index(r.failure) for _, _, r in rows]),
        "failed_phase": condensed([-1 if r.failed_phase is None else phases.index(r.failed_phase) for _, _, r in rows]),
        "notable": [
            {
                "trial": next(index for index, (_, key, _) in enumerate(rows) if key == one.key),
                "why": one.why,
                "detail": one.record.failure_detail,
            }
            for one in notable
        ],
        "worst": next(
            (
                {"trial": next(index for index, (_, key, _) in enumerate(rows) if key == one.key), "why": one.worst}
                for one in notable
                if one.worst
            ),
            None,
        ),
        "timelines": {
            str(index): _timeline(record) for index, (_, key, record) in enumerate(rows) if every or key in wanted
        },
        "every_timeline": every,
    }


def _moved(record: TrialRecord) -> bool:
    return any(phase.outcome is PhaseOutcome.COMPLETED for phase in record.phases)


def _timeline(record: TrialRecord) -> Plain:
    planning = {planned.subtask: planned.time_s for planned in record.planning}
    return {
        "outcome": [phase.outcome.value for phase in record.phases],
        "duration_s": plain_numbers(phase.duration_s for phase in record.phases),
        "planning_s": [plain_number(planning.get(phase.phase)) for phase in record.phases],
    }


def _words(name: str) -> str:
    return name.replace("_", " ")
