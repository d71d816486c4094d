"""Evidence of a study for its traceability: one variant's trials, and the verdicts on all."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.assessment import VariantMeasures
from rgss.decision.choosing import choose
from rgss.designs import sources
from rgss.errors import RgssError
from rgss.evidence import TrialRecord
from rgss.measures import Population, evaluate
from rgss.studies import Project
from rgss.trace.evidence import EvidenceState, TraceEvidence, TrialEvidence, VariantEvidence
from rgss.tradeoff import Decision


def trace_evidence(
    project: Project,
    measured: Sequence[VariantMeasures],
    state: EvidenceState,
    *,
    variant: int | None = None,
    decision: Decision | None = None,
) -> TraceEvidence:
    """Evidence and decision of a project, for its traceability.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        state: The verdicts of all variants, and the results of the tests.
        variant: The variant to show; the one that the trade-off chooses by default.
        decision: Decision of the trade-off, if it was computed already.

    Raises:
        DefinitionError: There is no such variant.
    """
    shown, choice = _chosen(project, measured, variant, decision)
    entry = next((one for one in measured if one.variant.id == shown), None)
    return TraceEvidence(
        shown=None if entry is None else variant_evidence(project, entry),
        choice=choice
        if entry is None or not entry.missing
        else f"{choice}; {entry.missing} of its trials were not run",
        variants=len(measured),
        state=state,
        sweep=project.command("sweep"),
    )


def variant_evidence(project: Project, entry: VariantMeasures) -> VariantEvidence:
    """Evidence on one variant, with the value of each measure in each of its trials."""
    trials = tuple(_trial(project, entry, key, record) for key, record in zip(entry.trials, entry.records, strict=True))
    deciding = {}
    for measure in project.measures.measures:
        rule = measure.estimate
        deciding[measure.id] = tuple(
            trial.key
            for trial, record in zip(trials, entry.records, strict=True)
            if rule is not None and (record.success or rule.over is Population.ALL)
            if trial.values[measure.id] is not None
        )
    return VariantEvidence(
        variant=entry.variant.id,
        trials=trials,
        missing=entry.missing,
        estimates=entry.estimates,
        deciding=deciding,
    )


def _chosen(
    project: Project, measured: Sequence[VariantMeasures], variant: int | None, decision: Decision | None
) -> tuple[int | None, str]:
    if variant is not None:
        return project.designs.variant(variant).id, f"variant {variant}, as requested"
    try:
        decision = choose(project, measured) if decision is None else decision
    except RgssError as error:
        return None, f"no variant is chosen: {error}"
    if decision.chosen is None:
        return None, "no variant is chosen, since none meets every requirement by its estimates"
    return decision.chosen, f"variant {decision.chosen}, which the trade-off chooses"


def _trial(project: Project, entry: VariantMeasures, key: str, record: TrialRecord) -> TrialEvidence:
    return TrialEvidence(
        key=key,
        variant=record.variant,
        seed=record.seed,
        fidelity=record.fidelity.value,
        outcome=_outcome(record),
        values=_values(project, entry, record),
        metrics=record.metrics,
    )


def _outcome(record: TrialRecord) -> str:
    if record.failure is None or record.failed_phase is None:
        return "success"
    return f"{record.failure.value} in {record.failed_phase}"


def _values(project: Project, entry: VariantMeasures, record: TrialRecord) -> dict[str, float | None]:
    """The value of each measure in one trial: its estimate from this trial alone."""
    alone = evaluate(
        project.measures,
        fixed=sources(entry.variant),
        trials=[record.metrics],
        variant=entry.variant.id,
    )
    return {name: estimate.value for name, estimate in alone.items()}
