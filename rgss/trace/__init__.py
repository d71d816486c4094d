"""Traceability: the graph of links, the rules that it must keep, and its matrices."""

from rgss.trace.matrices import (
    TraceMatrix,
    matrix_of,
    stakeholder_by_effectiveness,
    system_by_architecture,
    system_by_stakeholder,
)
from rgss.trace.measure_trace import MeasureKind, MeasureTrace
from rgss.trace.model import TraceModel, build_trace_model
from rgss.trace.registry import FAMILIES, RULES, check_trace, rule_of
from rgss.trace.rule import Rule

__all__ = [
    "FAMILIES",
    "RULES",
    "MeasureKind",
    "MeasureTrace",
    "Rule",
    "TraceMatrix",
    "TraceModel",
    "build_trace_model",
    "check_trace",
    "matrix_of",
    "rule_of",
    "stakeholder_by_effectiveness",
    "system_by_architecture",
    "system_by_stakeholder",
]
