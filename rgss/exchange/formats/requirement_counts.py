"""Counts of the exported requirements and elements."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.exchange.content import Content
    from rgss.studies import Project


def requirement_counts(project: Project) -> dict[str, int]:
    """Number of requirements."""
    requirements = project.requirements
    return {"requirements": len(requirements.stakeholder) + len(requirements.system)}


def model_counts(project: Project) -> dict[str, int]:
    """Number of requirements and of elements of the architecture."""
    elements = len(project.requirements.architecture.elements)
    return {**requirement_counts(project), "elements of the architecture": elements}


def requirements_content(project: Project) -> Content:
    """The requirements with the measures that they name, and with their verification records."""
    from rgss.exchange.content import content_of
    from rgss.exchange.verification_records import record_cells
    from rgss.trace.evidence import evidence_of_records

    measures = {measure.id: measure.definition for measure in project.measures.measures}
    records = record_cells(evidence_of_records(project.requirements, project.folder))
    return content_of(project.requirements, measures, records)
