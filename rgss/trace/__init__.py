"""Traceability: the graph of links, the rules that it must keep, and its matrices."""

from rgss.trace.matrices import (
    TraceMatrix,
    stakeholder_by_effectiveness,
    system_by_architecture,
    system_by_stakeholder,
)
from rgss.trace.measure_trace import MeasureKind, MeasureTrace
from rgss.trace.model import TraceModel, build_trace_model
from rgss.trace.registry import RULES, check_trace
from rgss.trace.rule import Rule

__all__ = [
    "RULES",
    "MeasureKind",
    "MeasureTrace",
    "Rule",
    "TraceMatrix",
    "TraceModel",
    "build_trace_model",
    "check_trace",
    "stakeholder_by_effectiveness",
    "system_by_architecture",
    "system_by_stakeholder",
]
