"""Findings about requirements that no trade-off can hold, since its programs have no strict comparisons."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import Finding, Severity
from rgss.studies.project import Project


def strict_findings(project: Project) -> Iterator[Finding]:
    """Warn of criteria with ``<`` or ``>``, at which `rgss trade` would end after all trials."""
    for requirement in project.requirements.system:
        criterion = requirement.criterion
        if criterion is None or not criterion.comparison.is_strict:
            continue
        place = project.requirements.places[requirement.id]
        yield place.document.finding(
            "study.strict-comparison",
            f"{requirement.id} has the strict comparison {criterion.comparison.value!r}, which no trade-off can hold",
            (*place.location, "criterion", "comparison"),
            severity=Severity.WARNING,
            hint="write >= or <=",
        )
