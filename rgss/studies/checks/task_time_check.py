"""Findings about the bound of a task's time: measures that declare less than the task allows."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.documents import read_document
from rgss.findings import Finding, Severity
from rgss.studies.project import Project
from rgss.studies.project_folders import measures_of

_SOURCE = "trial.task_time_s"


def task_time_findings(project: Project) -> Iterator[Finding]:
    """Warn of measures of the task's time whose greatest value is not kept by the task's time limit.

    A trial beyond the bound of a measure is refused, and with it every page that reads it.
    """
    limit_s = project.study.task.time_limit_s
    times = {symbol.id for symbol in project.measures.inputs if symbol.source == _SOURCE}
    label = measures_of(project.study.requirements)
    for index, measure in enumerate(project.measures.measures):
        if measure.most is None or measure.expression.text.strip() not in times:
            continue
        most_s = measure.most * measure.si_per_unit
        if limit_s is not None and limit_s <= most_s:
            continue
        allowed = "states no time limit" if limit_s is None else f"may take {limit_s:g} s"
        yield read_document(project.folder / label, label=label).finding(
            "measures.task-time",
            f"{measure.id} is declared to be at most {most_s:g} s, but task {project.study.task.id!r} {allowed}: "
            "a longer trial would be refused",
            ("measures", index, "estimate", "most"),
            severity=Severity.WARNING,
            hint=f"state 'time_limit: {most_s:g} s' in the task's file, or remove 'most'",
        )
