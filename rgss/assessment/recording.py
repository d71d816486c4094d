"""Recording the verdicts of a study: after its trials were run, or on request."""

from __future__ import annotations

from collections.abc import Collection

from rgss.assessment.measuring import measure_variants, record_of
from rgss.assessment.recorded_verdicts import VerdictRecord, read_record, study_key, write_record
from rgss.evidence import EvidenceStore
from rgss.studies import Project


def record_verdicts(
    project: Project, store: EvidenceStore, *, variants: Collection[int] | None = None
) -> VerdictRecord:
    """Record the verdicts on the requirements and measures as they are now.

    Args:
        project: The project with its study.
        store: The evidence.
        variants: Ids of the variants; all by default.

    Returns:
        Everything that is recorded now.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store or the record is damaged, or the record cannot be written.
    """
    recorded = read_record(project.folder)
    again = record_of(project, measure_variants(project, store), recorded, variants=variants)
    if again != recorded:
        write_record(project.folder, again)
    return again


def record_after_sweep(project: Project, store: EvidenceStore, run: Collection[int]) -> VerdictRecord:
    """Record the verdicts for which a sweep has made evidence, and those that were never recorded.

    A verdict whose evidence was there before keeps what was recorded with it, so that a change of its
    requirement or measure goes on to show.

    Args:
        project: The project with its study.
        store: The evidence.
        run: Ids of the variants of which a trial was run.

    Returns:
        Everything that is recorded now.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store or the record is damaged, or the record cannot be written.
    """
    book = read_record(project.folder).of_study(study_key(project.study.label, project.study.fidelity.value))
    there = {variant for variants in book.values() for variant in variants}
    new = {variant.id for variant in project.designs.expand()} - there
    return record_verdicts(project, store, variants={*run, *new})
