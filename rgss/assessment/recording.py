"""Recording of the verdicts of a study, after its trials were run or on request."""

from __future__ import annotations

from collections.abc import Collection

from rgss.assessment.measuring import measure_variants, record_of
from rgss.assessment.recorded_verdicts import VerdictRecord, read_record, study_key, update_record
from rgss.evidence import EvidenceStore
from rgss.studies import Project


def record_verdicts(
    project: Project, store: EvidenceStore, *, variants: Collection[int] | None = None
) -> VerdictRecord:
    """Record the verdicts by the present requirements and measures.

    Args:
        project: The project with its study.
        store: The evidence.
        variants: Ids of the variants; all by default.

    Returns:
        All recorded verdicts.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store or the record is damaged, or the record cannot be written.
    """
    measured = measure_variants(project, store)
    return update_record(project.folder, lambda recorded: record_of(project, measured, recorded, variants=variants))


def record_after_sweep(project: Project, store: EvidenceStore, run: Collection[int]) -> VerdictRecord:
    """Record the verdicts with evidence from a sweep, and those that were never recorded.

    A verdict with older evidence keeps its record, so that a change of its requirement or measure
    remains visible. A sweep that has run nothing may follow one that was killed before it recorded anything.

    Args:
        project: The project with its study.
        store: The evidence.
        run: Ids of the variants of which a trial was run.

    Returns:
        All recorded verdicts.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store or the record is damaged, or the record cannot be written.
    """
    recorded = read_record(project.folder)
    book = recorded.of_study(study_key(project.study.label, project.study.fidelity.value))
    there = {variant for variants in book.values() for variant in variants}
    new = {variant.id for variant in project.designs.expand()} - there
    if not (run or new):
        return recorded
    return record_verdicts(project, store, variants={*run, *new})
