"""State of a project: its contents, its evidence, and the next command."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from rgss.counted import counted

if TYPE_CHECKING:
    from pathlib import Path

    from rgss.studies import Project

BEGIN = (
    "There is no project here or above.",
    "",
    "Next: rgss init my_project        a project with a study that can be run",
    "      rgss init --robot arm.urdf  one for a robot of your own",
    "      rgss --help                 every command",
)


def state_lines() -> Iterator[str]:
    """Output of ``rgss`` without a verb.

    Raises:
        DocumentError: Files of the project are wrong.
        EvidenceError: The evidence is damaged.
    """
    from rgss.errors import DefinitionError
    from rgss.studies import find_project, load_project

    try:
        folder = find_project(None)
    except DefinitionError:
        yield from BEGIN
        return
    try:
        project = load_project(folder)
    except DefinitionError as error:
        yield f"Project {folder.name}: {error}"
        return
    yield from _project_lines(folder, project)
    yield ""
    yield from _evidence_lines(project)


def _project_lines(folder: Path, project: Project) -> Iterator[str]:
    study, requirements = project.study, project.requirements
    others = [path.stem for path in sorted((folder / "studies").glob("*.yaml")) if path.stem != study.id]
    variants = len(project.designs.expand())
    yield (
        f"Project {folder.name}: {len(requirements.stakeholder)} stakeholder and {len(requirements.system)} system "
        f"requirements, {counted(len(project.measures.measures), 'measure')}"
    )
    yield f"Study {study.id}: {counted(variants, 'variant')}, {study.fidelity.value} fidelity ({study.label})"
    if others:
        yield f"Other studies: {', '.join(others)}"


def _evidence_lines(project: Project) -> Iterator[str]:
    from rgss.assessment import failed_verifications, read_record
    from rgss.cli.output import shown_path
    from rgss.decision import measure_survivors
    from rgss.evidence import EvidenceStore

    label = shown_path(project.evidence)
    if not project.evidence.exists():
        yield "No trial has been run."
        yield "Next: rgss sweep    runs the study's trials"
        return
    with EvidenceStore.open(project.evidence, create=False, label=label) as store:
        measured, screened = measure_survivors(project, store, recorded=read_record(project.folder))
    stored = sum(len(entry.records) for entry in measured)
    missing = sum(entry.missing for entry in measured)
    yield f"Trials: {stored} stored in {label}" + (f", {missing} missing" if missing else "")
    if missing:
        yield "Next: rgss sweep    runs what is missing"
        return
    from rgss.decision.study_decision import decide_study
    from rgss.reports.decision import headline

    made = decide_study(
        project, measured, evidence=label, analysed=False, screened=screened, failed=failed_verifications(project)
    )
    yield headline(made)
    yield "Next: rgss trade    the reasons, how certain they are, and what would change the decision"
    yield "      rgss report   all of it on one page"
