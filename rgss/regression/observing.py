"""What a trial's record says of a metric, over the whole trial or in one phase."""

from __future__ import annotations

from rgss.documents import digest
from rgss.evidence import Phase, PhaseOutcome, PhaseRecord, TrialRecord
from rgss.evidence.records import record_digest
from rgss.regression.comparing import WHOLE_TRIAL

SUCCESS = "success"
"""The metric that is 1 where a trial, or a phase that was reached, was completed, and 0 where not."""

OF_PHASES = {"duration_s": "s", "planning_time_s": "s", "path_length_m": "m", "planning_checks": "1"}
"""Units of what is known of a phase beside its own metrics."""

_SHORT = 12


def observed(record: TrialRecord, metric: str, phase: str) -> float | None:
    """The value of a metric; None where the trial does not tell.

    Args:
        record: The trial's record.
        metric: The metric.
        phase: The phase, or ``trial``.
    """
    if phase == WHOLE_TRIAL:
        return _number(record.metrics.get(metric))
    state = next(one for one in record.phases if one.phase.value == phase)
    if metric == SUCCESS:
        return None if state.outcome is PhaseOutcome.NOT_RUN else float(state.outcome is PhaseOutcome.COMPLETED)
    if metric == "duration_s":
        return _number(state.duration_s)
    if metric in OF_PHASES:
        planned = next((one for one in record.planning if one.subtask.value == phase), None)
        if planned is None or state.outcome is PhaseOutcome.NOT_RUN:
            return None
        return _number(
            {
                "planning_time_s": planned.time_s,
                "path_length_m": planned.path_length_m,
                "planning_checks": planned.checks,
            }[metric]
        )
    return _number(state.metrics.get(metric))


def fingerprint(record: TrialRecord) -> str:
    """The digest of a record and, behind it, a short one of each phase in order, with blanks between.

    They are equal only if every bit of every number is.

    Raises:
        EvidenceError: The record cannot be written.
    """
    planning = {one.subtask: one for one in record.planning}
    parts = []
    for one in record.phases:
        planned = planning.get(one.phase)
        said = "" if planned is None else repr(planned)
        parts.append(digest([_plain(one), said])[:_SHORT])
    return " ".join([record_digest(record), *parts])


def first_difference(before: str, now: str) -> str:
    """The first phase in which two fingerprints differ; ``trial`` if only the whole does."""
    pairs = zip(before.split()[1:], now.split()[1:], strict=False)
    names = [phase.value for phase, (was, is_now) in zip(Phase, pairs, strict=False) if was != is_now]
    return names[0] if names else WHOLE_TRIAL


def _plain(phase: PhaseRecord) -> list[object]:
    return [phase.phase, phase.outcome, phase.duration_s, dict(phase.metrics)]


def _number(value: object) -> float | None:
    return float(value) if isinstance(value, (int, float)) else None
