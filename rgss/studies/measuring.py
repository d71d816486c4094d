"""From stored evidence to the estimates and verdicts of every variant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from rgss.designs import DesignVariant, sources
from rgss.errors import EvidenceError
from rgss.evidence import EvidenceStore, TrialRecord
from rgss.measures import Estimate, Verdict, evaluate, judge
from rgss.requirements import Requirement
from rgss.studies.expansion import trial_specs
from rgss.studies.project import Project
from rgss.studies.sweep import key_of


@dataclass(frozen=True, slots=True, kw_only=True)
class VariantMeasures:
    """What is known of one variant.

    Attributes:
        variant: The variant.
        trials: The keys of the trials that it stands on, in the order of their seeds.
        records: Their records.
        missing: How many of its trials have no evidence.
        estimates: The estimate of each measure by its id.
        verdicts: The verdict on each requirement with a criterion, by its id.
    """

    variant: DesignVariant
    trials: tuple[str, ...]
    records: tuple[TrialRecord, ...]
    missing: int
    estimates: Mapping[str, Estimate]
    verdicts: Mapping[str, Verdict]


def measure_variants(project: Project, store: EvidenceStore) -> tuple[VariantMeasures, ...]:
    """Estimate every measure of every variant from the evidence that is there.

    Args:
        project: The project with its study.
        store: The evidence.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store is damaged.
    """
    variants = project.designs.expand()
    keys: dict[int, list[str]] = {}
    for spec in trial_specs(project, variants=variants):
        keys.setdefault(spec.variant, []).append(key_of(spec))
    found = store.records([key for row in keys.values() for key in row])
    return tuple(_measured(project, variant, keys[variant.id], found) for variant in variants)


def require_complete(measured: Sequence[VariantMeasures]) -> None:
    """Make sure that every trial of the study has evidence.

    Raises:
        EvidenceError: Some have none.
    """
    missing = sum(variant.missing for variant in measured)
    total = missing + sum(len(variant.records) for variant in measured)
    if missing:
        raise EvidenceError(
            f"{missing} of {total} trials have no evidence for the project as it is now",
            hint="run 'rgss sweep' first",
        )


def requirements_with_criteria(project: Project) -> tuple[Requirement, ...]:
    """The system requirements that a measure decides."""
    return tuple(requirement for requirement in project.requirements.system if requirement.criterion is not None)


def _measured(
    project: Project, variant: DesignVariant, keys: Sequence[str], found: Mapping[str, TrialRecord]
) -> VariantMeasures:
    there = tuple(key for key in keys if key in found)
    records = tuple(found[key] for key in there)
    estimates = evaluate(
        project.measures,
        fixed=sources(variant),
        trials=[record.metrics for record in records],
        seed=project.study.seed,
        variant=variant.id,
    )
    verdicts = {
        requirement.id: judge(requirement.criterion, estimates[requirement.criterion.measure])
        for requirement in requirements_with_criteria(project)
        if requirement.criterion is not None
    }
    return VariantMeasures(
        variant=variant,
        trials=there,
        records=records,
        missing=len(keys) - len(there),
        estimates=estimates,
        verdicts=verdicts,
    )
