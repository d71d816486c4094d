"""Metrics of trials and phases: one descriptor each."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.trials.metrics.descriptor import (
        FOR_EACH_JOINT,
        FOR_EACH_MOVE,
        Aggregation,
        Direction,
        MetricDescriptor,
        PhaseValue,
    )
    from rgss.trials.metrics.grasp_metrics import CARRY_METRICS, GRASP_METRICS
    from rgss.trials.metrics.registry import METRICS, PHASE_METRICS
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
