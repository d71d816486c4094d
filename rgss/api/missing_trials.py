"""Errors of a study without trials, with the remedy as hint."""

from __future__ import annotations

from rgss.assessment import VariantMeasures
from rgss.errors import EvidenceError
from rgss.studies import Project


def sweep_hint(project: Project) -> str:
    """Instruction to make the evidence of a study."""
    study = project.study
    return (
        f"call sweep(), or run 'rgss sweep {study.label} --project {project.folder} "
        f"--fidelity {study.fidelity.value} --replicates {study.replicates}'"
    )


def with_trials(project: Project, measured: tuple[VariantMeasures, ...]) -> tuple[VariantMeasures, ...]:
    """Variants of which at least one has a trial.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and records.

    Raises:
        EvidenceError: None has a trial.
    """
    if not any(entry.records for entry in measured):
        outdated = sum(entry.outdated for entry in measured)
        old = f"; {outdated} have evidence of an earlier model, code or engine" if outdated else ""
        raise EvidenceError(
            f"no trial of study {project.study.id!r} at {project.study.fidelity.value} fidelity has "
            f"evidence for the project as it is now{old}",
            hint=sweep_hint(project),
        )
    return measured
