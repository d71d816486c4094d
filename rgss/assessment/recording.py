"""Recording of the verdicts of a study, before and after its trials are run or on request."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from types import MappingProxyType

from rgss.assessment.measuring import measure_variants, record_of
from rgss.assessment.recorded_verdicts import (
    Book,
    RecordedVerdict,
    VerdictRecord,
    read_record,
    study_key,
    update_record,
)
from rgss.assessment.stored_replicates import read_specs
from rgss.evidence import EvidenceStore
from rgss.evidence.store import trial_names
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
    stored = _stored_trials(project, store)
    measured = measure_variants(project, store)
    return update_record(
        project.folder, lambda recorded: record_of(project, measured, recorded, variants=variants, stored=stored)
    )


def record_before_sweep(project: Project, store: EvidenceStore) -> VerdictRecord:
    """Remove the trials that are stored no longer from the evidence of the recorded verdicts.

    If a sweep makes them again, their verdicts are drawn from them, even though their keys are the same. A record that
    does not name its trials gets those that are stored.

    Args:
        project: The project with its study.
        store: The evidence.

    Returns:
        All recorded verdicts.

    Raises:
        EvidenceError: The store or the record is damaged, or the record cannot be written.
    """
    key = _key(project)

    def without_lost(recorded: VerdictRecord) -> VerdictRecord:
        book = recorded.of_study(key)
        if not book:
            return recorded
        stored = _stored_trials(project, store)
        kept: Book = {
            requirement: {variant: one.without_lost(stored.get(variant, ())) for variant, one in verdicts.items()}
            for requirement, verdicts in book.items()
        }
        return VerdictRecord(studies=MappingProxyType({**recorded.studies, key: kept}))

    return update_record(project.folder, without_lost)


def record_after_sweep(project: Project, store: EvidenceStore) -> VerdictRecord:
    """Record the verdicts with trials that their record does not know, and those that were never recorded.

    A verdict with older evidence keeps its record, so that a change of its requirement or measure remains visible. What
    decides is the evidence, not the sweep: one that has run nothing may follow one that was interrupted.

    Arguments, result and exceptions are those of `record_verdicts`.
    """
    recorded = read_record(project.folder)
    due = _due(project, store, recorded.of_study(_key(project)))
    return record_verdicts(project, store, variants=due) if due else recorded


def _due(project: Project, store: EvidenceStore, book: Book) -> set[int]:
    by_variant: dict[int, list[RecordedVerdict]] = {}
    for verdicts in book.values():
        for variant, one in verdicts.items():
            by_variant.setdefault(variant, []).append(one)
    specs = read_specs(project, store, project.designs.expand())
    there = store.has([key for keys in specs.values() for key in keys])
    return {
        variant
        for variant, keys in specs.items()
        if variant not in by_variant or _is_any_older(by_variant[variant], there.intersection(keys))
    }


def _is_any_older(verdicts: Iterable[RecordedVerdict], trials: Collection[str]) -> bool:
    return any(one.is_older_than(trials) for one in verdicts)


def _stored_trials(project: Project, store: EvidenceStore) -> Mapping[int, frozenset[str]]:
    """Keys of the stored trials at the study's fidelity, for any inputs, by variant."""
    found: dict[int, set[str]] = {}
    for name in trial_names(store.database):
        if name.fidelity == project.study.fidelity.value:
            found.setdefault(name.variant, set()).add(name.key)
    return {variant: frozenset(keys) for variant, keys in found.items()}


def _key(project: Project) -> str:
    return study_key(project.study.label, project.study.fidelity.value)
