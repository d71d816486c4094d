"""Estimates and verdicts of every variant from stored evidence."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from types import MappingProxyType

from rgss.assessment.recorded_verdicts import Basis, Book, RecordedVerdict, VerdictRecord, study_key
from rgss.assessment.staleness import BasisReader, causes_since, outdated_trials
from rgss.assessment.stored_replicates import read_specs
from rgss.designs import DesignVariant, sources
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, TrialRecord
from rgss.measures import Estimate, Measure, MeasureKind, StaleCause, Verdict, evaluate, judge
from rgss.requirements import Criterion, Requirement
from rgss.studies import Project
from rgss.trials.code import assume_engines
from rgss.trials.pieces import TrialSpec

_UNDECIDED = (Verdict.NOT_RUN, Verdict.STALE)


@dataclass(frozen=True, slots=True, kw_only=True)
class VariantMeasures:
    """Estimates and verdicts of one variant.

    Attributes:
        variant: The variant.
        trials: The keys of its trials, in the order of their seeds.
        records: Their records.
        missing: Number of its trials without evidence.
        estimates: The estimate of each measure by its id.
        verdicts: The verdict on each requirement with a criterion, by its id.
        outdated: Number of missing trials with evidence of an earlier model, code or engine.
        causes: For each requirement with a stale verdict, the changes since its evidence.
        bases: Inputs of each verdict, by the requirement's id.
    """

    variant: DesignVariant
    trials: tuple[str, ...]
    records: tuple[TrialRecord, ...]
    missing: int
    estimates: Mapping[str, Estimate]
    verdicts: Mapping[str, Verdict]
    outdated: int = 0
    causes: Mapping[str, tuple[StaleCause, ...]] = field(default_factory=lambda: MappingProxyType({}))
    bases: Mapping[str, Basis] = field(default_factory=lambda: MappingProxyType({}))


def measure_variants(
    project: Project,
    store: EvidenceStore | None,
    *,
    recorded: VerdictRecord | None = None,
    among: Sequence[DesignVariant] | None = None,
) -> tuple[VariantMeasures, ...]:
    """Estimates of every measure of every variant from the stored evidence, with verdicts on the requirements.

    `rgss.assessment.stored_replicates` determines the trials: variants may have different numbers.
    Only evidence of the present project, code and engines is used. A verdict is stale if it needs a
    trial with only older evidence, or if its requirement, measure or design changed since it was
    recorded from the same evidence. A verdict on a measure that is observed in trials is not run if
    no trial was run, and inconclusive if trials were run and none gives a value.

    Args:
        project: The project with its study.
        store: The evidence; None if there is none yet.
        recorded: The recorded verdicts; None to ignore changes of requirements and
            measures.
        among: The variants; all by default.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store is damaged.
    """
    assume_engines(() if store is None else (trial.provenance.versions for trial in store.iterate()))
    variants = project.designs.expand() if among is None else among
    specs = read_specs(project, store, variants)
    found: Mapping[str, TrialRecord] = {}
    outdated: dict[int, list[tuple[StaleCause, ...]]] = {}
    if store is not None:
        found = store.records([key for row in specs.values() for key in row])
        missing = [spec for row in specs.values() for key, spec in row.items() if key not in found]
        for (variant_id, _), causes in outdated_trials(missing, store, study=project.study.label).items():
            outdated.setdefault(variant_id, []).append(causes)
    book = _book_of(project, recorded)
    reader = BasisReader(project)
    return tuple(
        _judged(
            project, _measured(project, variant, specs[variant.id], found), book, outdated.get(variant.id, ()), reader
        )
        for variant in variants
    )


def record_of(
    project: Project,
    measured: Sequence[VariantMeasures],
    recorded: VerdictRecord,
    *,
    variants: Collection[int] | None = None,
    stored: Mapping[int, frozenset[str]] = MappingProxyType({}),
) -> VerdictRecord:
    """The record with updated verdicts of some variants.

    They are given by the present requirements, measures and evidence. A verdict whose evidence
    is missing or outdated is kept as it was recorded.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        recorded: The record so far.
        variants: Ids of the variants; all by default.
        stored: Keys of the stored trials of each variant, of which the study may read a part.
    """
    key = study_key(project.study.label, project.study.fidelity.value)
    before = recorded.of_study(key)
    there = {entry.variant.id for entry in measured}
    book: dict[str, Mapping[int, RecordedVerdict]] = {}
    for requirement, criterion in _criteria(project):
        kept = {variant: one for variant, one in before.get(requirement.id, {}).items() if variant in there}
        for entry in measured:
            if variants is not None and entry.variant.id not in variants:
                continue
            if entry.outdated and project.measures.measure(criterion.measure).from_trials:
                continue
            verdict = _verdict(criterion, entry, stale=False)
            if verdict not in _UNDECIDED:
                kept[entry.variant.id] = RecordedVerdict(
                    verdict=verdict,
                    basis=entry.bases[requirement.id],
                    evidence=stored.get(entry.variant.id, frozenset()).union(entry.trials),
                )
        if kept:
            book[requirement.id] = MappingProxyType(kept)
    return VerdictRecord(studies=MappingProxyType({**recorded.studies, key: MappingProxyType(book)}))


def require_complete(measured: Sequence[VariantMeasures], *, sweep: str = "rgss sweep") -> None:
    """Check that every trial of the study has evidence.

    Raises:
        EvidenceError: Some have none.
    """
    missing = sum(variant.missing for variant in measured)
    total = missing + sum(len(variant.records) for variant in measured)
    if missing:
        outdated = sum(variant.outdated for variant in measured)
        old = f"; {outdated} of them have evidence of an earlier model, code or engine" if outdated else ""
        raise EvidenceError(
            f"{missing} of {total} trials have no evidence for the project as it is now{old}",
            hint=f"run '{sweep}' first",
        )


def requirements_with_criteria(project: Project) -> tuple[Requirement, ...]:
    """The system requirements with a criterion."""
    return tuple(requirement for requirement, _ in _criteria(project))


def verdicts_on(project: Project, entry: VariantMeasures, *, stale: Collection[str] = ()) -> dict[str, Verdict]:
    """The verdict on each requirement with a criterion, from the estimates of a variant."""
    return {one.id: _verdict(criterion, entry, stale=one.id in stale) for one, criterion in _criteria(project)}


def judged_measures(project: Project) -> frozenset[str]:
    """Ids of the measures of effectiveness, and of those that a requirement's criterion bounds."""
    effectiveness = {measure.id for measure in project.measures.of_kind(MeasureKind.EFFECTIVENESS)}
    bounded = {criterion.measure for _, criterion in _criteria(project)}
    return frozenset(effectiveness | bounded)


def leading_measures(project: Project) -> tuple[Measure, ...]:
    """The measures of effectiveness, each by its simulation if that is what a requirement bounds."""
    measures = project.measures
    bounded = {criterion.measure for _, criterion in _criteria(project)}
    found = (
        one.simulated_as if one.id not in bounded and one.simulated_as in bounded else one.id
        for one in measures.of_kind(MeasureKind.EFFECTIVENESS)
    )
    return tuple(measures.measure(name) for name in dict.fromkeys(found) if name is not None)


def _criteria(project: Project) -> tuple[tuple[Requirement, Criterion], ...]:
    return tuple((one, one.criterion) for one in project.requirements.system if one.criterion is not None)


def _book_of(project: Project, recorded: VerdictRecord | None) -> Book:
    if recorded is None:
        return MappingProxyType({})
    return recorded.of_study(study_key(project.study.label, project.study.fidelity.value))


def _measured(
    project: Project, variant: DesignVariant, keys: Mapping[str, TrialSpec], found: Mapping[str, TrialRecord]
) -> VariantMeasures:
    there = tuple(key for key in keys if key in found)
    records = tuple(found[key] for key in there)
    estimates = evaluate(
        project.measures,
        fixed=sources(variant),
        trials=[record.metrics for record in records],
        variant=variant.id,
        over_looks=project.study.is_sequential,
    )
    return VariantMeasures(
        variant=variant,
        trials=there,
        records=records,
        missing=len(keys) - len(there),
        estimates=estimates,
        verdicts=MappingProxyType({}),
    )


def _judged(
    project: Project,
    entry: VariantMeasures,
    book: Book,
    outdated: Sequence[tuple[StaleCause, ...]],
    reader: BasisReader,
) -> VariantMeasures:
    bases, stale = {}, {}
    for requirement, criterion in _criteria(project):
        basis = reader.basis(requirement, criterion, entry.variant)
        found = set(causes_since(book.get(requirement.id, {}).get(entry.variant.id), basis, entry.trials))
        if project.measures.measure(criterion.measure).from_trials:
            found.update(cause for causes in outdated for cause in causes)
        causes = tuple(cause for cause in StaleCause if cause in found)
        if causes:
            stale[requirement.id] = causes
        bases[requirement.id] = basis
    return replace(
        entry,
        verdicts=MappingProxyType(verdicts_on(project, entry, stale=stale)),
        outdated=len(outdated),
        causes=MappingProxyType(stale),
        bases=MappingProxyType(bases),
    )


def _verdict(criterion: Criterion, entry: VariantMeasures, *, stale: bool) -> Verdict:
    """The verdict by the valid evidence; trials without a value leave it inconclusive."""
    verdict = judge(criterion, entry.estimates[criterion.measure], stale=stale)
    return Verdict.INCONCLUSIVE if verdict is Verdict.NOT_RUN and entry.records else verdict
