"""Findings about draws of an object that the geometry of the scene excludes."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.studies.project import Project


def draw_findings(project: Project) -> Iterator[Finding]:
    """Warn of draws with the centre of mass outside the object, or with the object beside its support.

    Args:
        project: The project with its study.
    """
    if not project.uncertainty.values:
        return
    try:
        from rgss.trials import draw_problems
    except ImportError:  # the check of the scene says that an engine is missing
        return
    for problem in draw_problems(project.scene, project.uncertainty):
        is_of_study = problem.quantity in project.study.uncertainty.names
        label = project.study.label if is_of_study else project.study.scene
        message = (
            f"{problem.share * 100:.3g} % of the draws of {problem.quantity} have the centre of mass "
            f"{f'beyond the edge of {problem.support}' if problem.support else f'outside {problem.object}'}, "
            f"by up to {problem.farthest_m * 1e3:.4g} mm"
        )
        yield read_document(project.folder / label, label=label).finding(
            "uncertainty.outside",
            message,
            ("uncertainty", problem.quantity),
            severity=Severity.WARNING,
            hint="narrow the distribution, such as by truncated_normal or uniform",
        )
