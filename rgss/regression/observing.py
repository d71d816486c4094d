"""Values of metrics in a record, over the whole trial or in one phase, and fingerprints of records."""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from dataclasses import replace
from operator import attrgetter

from rgss.documents import digest
from rgss.evidence import Metric, PhaseOutcome, PhaseRecord, TrialRecord
from rgss.evidence.records import record_digest
from rgss.regression.comparing import WHOLE_TRIAL

SUCCESS = "success"
"""The metric that is 1 where a trial, or a phase that was reached, was completed, and 0 where not."""

_OF_PLANNING = {
    "planning_time_s": attrgetter("time_s"),
    "path_length_m": attrgetter("path_length_m"),
    "planning_checks": attrgetter("checks"),
}

_SHORT = 12


def observed(record: TrialRecord, metric: str, phase: str) -> float | None:
    """The value of a metric; None where the record has none.

    Args:
        record: The trial's record.
        metric: The metric.
        phase: The phase, or ``trial``.
    """
    if phase == WHOLE_TRIAL:
        return _number(record.metrics.get(metric))
    state = next(one for one in record.phases if one.phase == phase)
    if metric == SUCCESS:
        return None if state.outcome is PhaseOutcome.NOT_RUN else float(state.outcome is PhaseOutcome.COMPLETED)
    if metric == "duration_s":
        return _number(state.duration_s)
    if metric in _OF_PLANNING:
        planned = next((one for one in record.planning if one.subtask == phase), None)
        if planned is None or state.outcome is PhaseOutcome.NOT_RUN:
            return None
        return _number(_OF_PLANNING[metric](planned))
    return _number(state.metrics.get(metric))


def fingerprint(
    record: TrialRecord, *, metrics: Container[str] | None = None, phase_metrics: Container[str] | None = None
) -> str:
    """The digest of a record and, behind it, a short one of each phase in order, with blanks between.

    They are equal only if every bit of every number is.

    Args:
        record: The record.
        metrics: The metrics of the trial that count; all if None.
        phase_metrics: The metrics of phases that count; all if None.

    Raises:
        EvidenceError: The record cannot be written.
    """
    record = replace(
        record,
        metrics=_among(record.metrics, metrics),
        phases=tuple(replace(one, metrics=_among(one.metrics, phase_metrics)) for one in record.phases),
    )
    planning = {one.subtask: one for one in record.planning}
    parts = []
    for one in record.phases:
        planned = planning.get(one.phase)
        said = "" if planned is None else repr(planned)
        parts.append(digest([_plain(one), said])[:_SHORT])
    return " ".join([record_digest(record), *parts])


def first_difference(before: str, now: str, phases: Sequence[str]) -> str:
    """The first phase in which two fingerprints differ; ``trial`` if only the whole does.

    Args:
        before: The one.
        now: The other.
        phases: Names of the phases in order.
    """
    pairs = zip(before.split()[1:], now.split()[1:], strict=False)
    names = [phase for phase, (was, is_now) in zip(phases, pairs, strict=False) if was != is_now]
    return names[0] if names else WHOLE_TRIAL


def _plain(phase: PhaseRecord) -> list[object]:
    return [phase.phase, phase.outcome, phase.duration_s, dict(phase.metrics)]


def _among(found: Mapping[str, Metric], names: Container[str] | None) -> Mapping[str, Metric]:
    return found if names is None else {name: value for name, value in found.items() if name in names}


def _number(value: object) -> float | None:
    return float(value) if isinstance(value, (int, float)) else None


def mean_of(series: Mapping[int, Mapping[int, float | None]]) -> float | None:
    """Mean of the known values by variant and seed; None if there are none."""
    known = [value for row in series.values() for value in row.values() if value is not None]
    return math.fsum(known) / len(known) if known else None
