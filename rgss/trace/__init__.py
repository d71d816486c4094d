"""Traceability: the graph of links, the rules that it must keep, and its matrices."""

from rgss.trace.model import MeasureKind, MeasureTrace, TraceModel, build_trace_model
from rgss.trace.rules import FAMILIES, RULES, check_trace, rule_of
from rgss.trace.views import (
    TraceMatrix,
    matrix_of,
    stakeholder_by_effectiveness,
    system_by_architecture,
    system_by_stakeholder,
)
