"""Every rule of traceability, and the check of a project against them."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.findings import Finding
from rgss.requirements import RequirementSet
from rgss.trace import coverage, criteria, links
from rgss.trace.measure_trace import MeasureTrace
from rgss.trace.model import build_trace_model
from rgss.trace.rule import Rule

RULES: tuple[Rule, ...] = (*coverage.RULES, *links.RULES, *criteria.RULES)
"""The rules, family by family."""


def check_trace(requirements: RequirementSet, measures: Sequence[MeasureTrace]) -> tuple[Finding, ...]:
    """Check that everything asked for is answered, measured, allocated and verifiable.

    Args:
        requirements: The requirements and the architecture of a project.
        measures: Its measures.

    Returns:
        The findings in the order of their positions; none but infos for a sound project.
    """
    model = build_trace_model(requirements, measures)
    return tuple(sorted(finding for rule in RULES for finding in rule.findings(model)))
