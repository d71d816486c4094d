"""The trade-off as one JSON document; docs/robustness.md describes it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rgss.decision.robustness import Robustness
    from rgss.decision.what_if import Scenario
    from rgss.studies import Project
    from rgss.tradeoff import Decision, PortfolioDecision

SCHEMA = 2
"""Rises when a key goes or changes its meaning; new keys do not count."""


def trade_document(
    project: Project,
    decision: Decision,
    found: Robustness | None,
    scenario: Scenario | None,
    before: Decision,
    fleet: PortfolioDecision | None,
    evidence: str,
) -> dict[str, Any]:
    """The document.

    Args:
        project: The project, under suppositions if there are any.
        decision: What is decided in it.
        found: How robust that is; None if it was not asked for.
        scenario: The suppositions; None if there are none.
        before: The decision without them.
        fleet: The portfolio; None if the study asks for none.
        evidence: The evidence store.
    """
    from rgss.decision import double_counting, shared_measures
    from rgss.decision.robustness import robustness_to_json, scenario_to_json
    from rgss.tradeoff import decision_to_json

    document: dict[str, Any] = {"schema": SCHEMA, "study": project.study.id, **decision_to_json(decision)}
    document["double_counting"] = [
        {"whole": overlap.whole, "part": overlap.part, "instead": overlap.instead}
        for overlap in double_counting(project)
    ]
    document["shared_parts"] = [
        {"first": shared.first, "second": shared.second, "parts": list(shared.parts)}
        for shared in shared_measures(project)
    ]
    document["robustness"] = None if found is None else robustness_to_json(found)
    document["fleet"] = None if fleet is None else _fleet(fleet)
    document["what_if"] = (
        None if scenario is None else {**scenario_to_json(scenario), "decision_before": decision_to_json(before)}
    )
    document["evidence"] = evidence
    return document


def _fleet(fleet: PortfolioDecision) -> dict[str, Any]:
    from rgss.tradeoff import checks_to_json

    return {
        "status": fleet.status.value,
        "members": list(fleet.members),
        "assignments": [
            {"study": one.task, "member": one.member, "variant": one.variant, "value": one.value}
            for one in fleet.assignments
        ],
        "value": fleet.objective,
        "value_recomputed": fleet.objective_recomputed,
        "gap": fleet.gap,
        "by_size": list(fleet.by_size),
        "by_size_gap": list(fleet.by_size_gap),
        "unserved": list(fleet.unserved),
        "enumeration_agrees": fleet.enumeration_agrees.value,
        "checks": checks_to_json(fleet.checks),
        "cut": None if fleet.cut is None else fleet.cut.value,
    }
