"""Registry of all metrics, by name."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

from rgss.trials.metrics.choice_metrics import CHOICE_METRICS
from rgss.trials.metrics.descriptor import Aggregation, MetricDescriptor
from rgss.trials.metrics.grasp_metrics import CARRY_METRICS, GRASP_METRICS
from rgss.trials.metrics.phase_metrics import PHASE_ONLY_METRICS
from rgss.trials.metrics.task_metrics import TASK_METRICS

_AT_GRASP = tuple(
    replace(
        metric,
        name=f"at_grasp_{metric.name.removeprefix('grasp_')}",
        trial=Aggregation.AT_GRASP,
        phase=None,
        source=metric.name,
    )
    for metric in GRASP_METRICS
)
_EVERY = (*TASK_METRICS, *GRASP_METRICS, *CARRY_METRICS, *_AT_GRASP, *PHASE_ONLY_METRICS, *CHOICE_METRICS)

METRICS: Mapping[str, MetricDescriptor] = MappingProxyType({one.name: one for one in _EVERY if one.trial is not None})
"""Metrics of a trial as a whole: the keys of a record's metrics, in their order; measures may refer to them."""

PHASE_METRICS: Mapping[str, MetricDescriptor] = MappingProxyType(
    {one.name: one for one in _EVERY if one.phase is not None}
)
"""Metrics of a phase, including those that are fields of its record."""
