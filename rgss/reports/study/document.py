"""Everything that a study's report shows, as one plain document that stands on stored evidence alone."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.assessment import VariantMeasures
from rgss.decision import ScreeningResult
from rgss.decision.robustness import Robustness
from rgss.evidence import EvidenceStore
from rgss.reports.study.conflicts import conflict_part
from rgss.reports.study.decision import decision_part
from rgss.reports.study.effects import effect_columns, factor_columns
from rgss.reports.study.numbers import Plain
from rgss.reports.study.planning import planning_columns
from rgss.reports.study.provenance import assumptions_of, provenance_of
from rgss.reports.study.trials import notable_trials, trial_columns
from rgss.reports.study.variants import (
    measure_columns,
    parameter_columns,
    requirement_columns,
    variant_columns,
    weight_columns,
)
from rgss.studies import DEFAULT_STUDY, Project
from rgss.tradeoff import Decision, PortfolioDecision

SCHEMA = 1
"""Rises when a key goes or changes its meaning; new keys do not count."""


def report_document(
    project: Project,
    measured: Sequence[VariantMeasures],
    decision: Decision,
    found: Robustness,
    store: EvidenceStore,
    *,
    evidence: str,
    screened: ScreeningResult | None = None,
    fleet: PortfolioDecision | None = None,
) -> Plain:
    """Gather what a report shows; nothing is simulated.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and verdicts, by ascending id.
        decision: What was decided.
        found: How robust that is.
        store: The evidence.
        evidence: Its name as people see it.
        screened: What became of the designs in screening; None if there was none.
        fleet: The portfolio that the study asks for; None if it asks for none.

    Returns:
        A document of dictionaries, lists, texts and finite numbers. Columns have an entry for each
        variant in the order of ``variants.id``, or are one value that all variants share.

    Raises:
        EvidenceError: The store is damaged, or an input file cannot be read.
    """
    notable = notable_trials(measured, decision.chosen)
    return {
        "schema": SCHEMA,
        "study": project.study.id,
        "study_file": project.study.label,
        "default_study": DEFAULT_STUDY,
        "design_space": project.study.design_space,
        "catalogue": project.study.catalogue,
        "evidence": evidence,
        "fidelity": project.study.fidelity.value,
        "variants": variant_columns(measured, decision, found),
        "parameters": parameter_columns(project, measured, found),
        "measures": measure_columns(project, measured),
        "requirements": requirement_columns(project, measured, decision),
        "weights": weight_columns(project, found),
        "decision": decision_part(project, measured, decision, found, screened=screened, fleet=fleet),
        "conflicts": conflict_part(decision),
        "factors": factor_columns(measured, found.effects),
        "effects": effect_columns(found.effects),
        "trials": trial_columns(measured, notable),
        "planning": planning_columns(project, measured),
        "assumptions": assumptions_of(project),
        "provenance": provenance_of(project, measured, store, evidence=evidence),
    }
