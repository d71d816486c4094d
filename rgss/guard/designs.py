"""Designs that a guard watches, with findings on their names in the study."""

from __future__ import annotations

from pathlib import Path

from rgss.designs import DesignVariant, picked
from rgss.documents import read_document
from rgss.errors import DefinitionError
from rgss.findings import Finding
from rgss.studies import Project, WatchedRun


def watched_designs(project: Project, run: WatchedRun) -> tuple[DesignVariant, ...]:
    """The designs of a run.

    Raises:
        DefinitionError: It names no design.
    """
    return picked(project.designs, [run.variants], option=f"variants of run {run.id}")


def guard_findings(project: Project) -> tuple[Finding, ...]:
    """Findings on runs that name no design.

    They stop only the guard, so that other designs can be tried without correcting its runs first.

    Args:
        project: The project, whose study may guard nothing.
    """
    guard = project.study.regression
    if guard is None:
        return ()
    label = project.study.label
    path = project.folder / label
    document = read_document(path if path.is_file() else Path(label), label=label)
    findings = []
    for place, run in enumerate(guard.runs):
        try:
            watched_designs(project, run)
        except DefinitionError as error:  # noqa: PERF203 - each run by itself
            at = ("regression", "runs", place, "variants")
            findings.append(document.finding("study.regression", error.message, at, hint=error.hint))
    return tuple(findings)
