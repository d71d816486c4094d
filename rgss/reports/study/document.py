"""Document of a study's report: plain values, from stored evidence alone."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.assessment import VariantMeasures
from rgss.decision.study_decision import StudyDecision
from rgss.evidence import EvidenceStore
from rgss.reports.decision import conflict_part, decision_part, elicitation_sentences, sensitivity_part
from rgss.reports.plain_numbers import Plain
from rgss.reports.study.effects import effect_columns, factor_columns
from rgss.reports.study.planning import planning_columns
from rgss.reports.study.provenance import assumptions_of, provenance_of
from rgss.reports.study.trials import notable_trials, trial_columns
from rgss.reports.study.variants import (
    filter_columns,
    measure_columns,
    parameter_columns,
    requirement_columns,
    variant_columns,
    weight_columns,
)
from rgss.studies import DEFAULT_STUDY, Project

SCHEMA = 1
"""Version of the schema; it rises when a key is removed or changes its meaning, not for new keys."""


def report_document(
    project: Project,
    measured: Sequence[VariantMeasures],
    made: StudyDecision,
    store: EvidenceStore,
    *,
    planners: Plain | None = None,
) -> Plain:
    """Gather the content of a report; nothing is simulated.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and verdicts, by ascending id.
        made: The decision of the study, with its robustness.
        store: The evidence.
        planners: The planners compared on the same moves, from `planner_comparison`; None without a comparison.

    Returns:
        A document of dictionaries, lists, texts and finite numbers. Columns have an entry for each
        variant in the order of ``variants.id``, or are a single value if all entries are equal.

    Raises:
        EvidenceError: The store is damaged, or an input file cannot be read.
    """
    if made.robustness is None:
        raise ValueError("the robustness of the decision must be analysed for a report")
    decision, found = made.decision, made.robustness.analysis
    notable = notable_trials(measured, decision.chosen)
    return {
        "schema": SCHEMA,
        "study": project.study.id,
        "study_file": project.study.label,
        "default_study": DEFAULT_STUDY,
        "design_space": project.study.design_space,
        "catalogue": project.study.catalogue,
        "evidence": made.evidence,
        "fidelity": project.study.fidelity.value,
        "variants": variant_columns(measured, decision, found),
        "parameters": parameter_columns(project, measured, found),
        "filters": filter_columns(project, measured),
        "measures": measure_columns(project, measured),
        "requirements": requirement_columns(project, measured, decision),
        "weights": weight_columns(project, found),
        "decision": decision_part(made),
        "conflicts": conflict_part(decision),
        "sensitivity": sensitivity_part(
            made.sensitivity, with_noise=found.weighting is not None and found.weighting.with_noise
        ),
        "elicitation": list(elicitation_sentences(made.elicited, made.elicited_by)),
        "factors": factor_columns(measured, found.effects),
        "effects": effect_columns(found.effects),
        "trials": trial_columns(measured, notable),
        "planning": planning_columns(project, measured),
        "planning_references": list(project.study.planning.references),
        "planner_comparison": planners,
        "assumptions": assumptions_of(project),
        "provenance": provenance_of(project, measured, store, evidence=made.evidence),
    }
