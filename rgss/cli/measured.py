"""The variants of a study by the evidence that is stored, for the verbs that trace requirements."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse

    from rgss.assessment import VariantMeasures
    from rgss.studies import Project
    from rgss.trace.evidence import EvidenceState


def measured_state(project: Project, junit: Path | None) -> tuple[Sequence[VariantMeasures], EvidenceState]:
    """Every variant with its estimates, and the state of the evidence; a store that does not exist is empty.

    Args:
        project: The project with its study.
        junit: The result of the tests; None for the project's own.

    Raises:
        DefinitionError: There is a result of tests, but the project has no tests.
        EvidenceError: The store cannot be read.
    """
    from rgss.assessment import evidence_state, read_record
    from rgss.cli.output import shown_path
    from rgss.decision import measure_survivors
    from rgss.evidence import EvidenceStore

    recorded = read_record(project.folder)
    if project.evidence.exists():
        with EvidenceStore.open(project.evidence, create=False, label=shown_path(project.evidence)) as store:
            measured, _ = measure_survivors(project, store, recorded=recorded)
    else:
        measured, _ = measure_survivors(project, None, recorded=recorded)
    return measured, evidence_state(project, measured, recorded=recorded, junit=junit)


def require_store(options: argparse.Namespace, project: Project) -> None:
    """Refuse a project of which no trial was run, with the command that runs those of the options.

    Raises:
        EvidenceError: There is no evidence store.
    """
    from rgss.cli.options import sweep_command
    from rgss.cli.output import shown_path
    from rgss.errors import EvidenceError

    if not project.evidence.exists():
        label, hint = shown_path(project.evidence), f"run '{sweep_command(options)}' first"
        raise EvidenceError(f"there is no evidence in {label}", hint=hint)
