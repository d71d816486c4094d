"""Columns of the metrics of trials and of phases, made from the metrics' descriptors."""

from __future__ import annotations

from rgss.api.column import Column, Kind
from rgss.trials import METRICS, PHASE_METRICS, MetricDescriptor, PhaseValue

_HAS_ITS_OWN_COLUMN = "success"


def trial_metric_columns() -> tuple[Column, ...]:
    """The columns of a trial's metrics, in the order in which a record has them; a row is one column here."""
    return tuple(
        Column(name=name, unit=metric.unit, meaning=metric.meaning_in_trial, kind=Kind.NUMBER, items=_items(metric))
        for name, metric in METRICS.items()
        if name != _HAS_ITS_OWN_COLUMN
    )


def phase_metric_columns() -> tuple[Column, ...]:
    """The columns of a phase's observed metrics; those that a trial has too are of the phase alone."""
    return tuple(
        Column(name=name, unit=metric.unit, meaning=metric.meaning_in_phase, kind=Kind.NUMBER, items=_items(metric))
        for name, metric in PHASE_METRICS.items()
        if metric.phase is PhaseValue.OBSERVED
    )


def recorded_column(name: str, kind: Kind = Kind.NUMBER) -> Column:
    """The column of a metric that is a field of a phase's record.

    Args:
        name: The metric.
        kind: Kind of its values.
    """
    metric = PHASE_METRICS[name]
    return Column(name=name, unit=metric.unit, meaning=metric.meaning_in_phase, kind=kind)


def _items(metric: MetricDescriptor) -> int | None:
    """Number of entries of a row; 0 where it follows from the project: fingers, planned moves, joints."""
    return None if metric.length is None else max(metric.length, 0)
