"""Decision of a study as one JSON document; docs/robustness.md describes it."""

from __future__ import annotations

from typing import Any

from rgss.decision.study_decision import StudyDecision
from rgss.reports.decision.json.assumptions import modelling_assumption_to_json
from rgss.reports.decision.json.conclusion import conclusion_to_json
from rgss.reports.decision.json.decision import checks_to_json, decision_to_json
from rgss.reports.decision.json.elicitation import elicitation_to_json
from rgss.reports.decision.json.robustness import robustness_to_json, scenario_to_json
from rgss.reports.decision.json.screening import screening_to_json
from rgss.reports.decision.json.sensitivity import sensitivity_to_json
from rgss.reports.failure_drivers import cases_to_json, drivers_to_json
from rgss.tradeoff import PortfolioDecision

SCHEMA = 3
"""Version of the schema; it rises when a key is removed or changes its meaning, not for new keys."""


def trade_document(made: StudyDecision) -> dict[str, Any]:
    """The document."""
    what_if, screened = made.what_if, made.screened
    document: dict[str, Any] = {"schema": SCHEMA, "study": made.study, **decision_to_json(made.decision)}
    document["double_counting"] = [
        {"whole": overlap.whole, "part": overlap.part, "instead": overlap.instead} for overlap in made.double_counted
    ]
    document["shared_parts"] = [
        {"first": shared.first, "second": shared.second, "parts": list(shared.parts)} for shared in made.shared_parts
    ]
    document["model_gaps"] = [
        {
            "measure": gap.measure,
            "simulated_as": gap.simulated_as,
            "unit": gap.unit,
            "by_equation": gap.by_equation,
            "simulated": gap.simulated,
        }
        for gap in made.gaps
    ]
    document["verified_by_equation"] = _equations_to_json(made)
    document["substitutions"] = _substitutions_to_json(made)
    document["readings"] = [
        {
            "measure": one.reading.measure,
            "alternative": one.reading.alternative,
            "rationale": one.reading.rationale,
            "chosen": one.chosen,
            "feasible": one.feasible,
            "reason": one.reason,
        }
        for one in made.readings
    ]
    document["modelling_assumptions"] = [modelling_assumption_to_json(one) for one in made.assumptions]
    document["failure_drivers"] = None if made.drivers is None else drivers_to_json(made.drivers)
    document["cases"] = cases_to_json(made.cases)
    document["conclusion"] = conclusion_to_json(made)
    document["robustness"] = None if made.robustness is None else robustness_to_json(made.robustness.analysis)
    document["sensitivity"] = None if made.sensitivity is None else sensitivity_to_json(made.sensitivity)
    document["elicitation"] = elicitation_to_json(made.elicited, made.elicited_by)
    document["portfolio"] = None if made.portfolio is None else portfolio_to_json(made.portfolio)
    document["what_if"] = (
        None
        if what_if is None
        else {
            **scenario_to_json(what_if.scenario),
            "readings": [{"measure": one.measure, "alternative": one.alternative} for one in what_if.scenario.readings],
            "settings": [{"id": one.id, "before": one.before, "after": one.after} for one in what_if.scenario.settings],
            "decision_before": decision_to_json(what_if.before.decision),
            "separated": what_if.separated,
        }
    )
    document["evidence"] = made.evidence
    reopened = () if what_if is None else what_if.reopened
    document["screening"] = None if screened is None else {**screening_to_json(screened), "would_go_on": list(reopened)}
    return document


def _equations_to_json(made: StudyDecision) -> list[dict[str, Any]]:
    return [
        {
            "requirement": one.requirement,
            "measure": one.measure,
            "simulated_as": one.simulated_as,
            "compared": one.compared,
            "otherwise": list(one.otherwise),
            "greatest_difference": one.greatest,
        }
        for one in made.equations
    ]


def _substitutions_to_json(made: StudyDecision) -> list[dict[str, Any]]:
    return [
        {
            "measure": one.measure,
            "requirements": list(one.requirements),
            "missing": list(one.substitution.missing),
            "taken": list(one.substitution.taken),
            "variants": list(one.variants),
            "trials": one.trials,
        }
        for one in made.substitutions
    ]


def portfolio_to_json(portfolio: PortfolioDecision) -> dict[str, Any]:
    """The choice of a portfolio as plain values."""
    return {
        "status": portfolio.status.value,
        "members": list(portfolio.members),
        "assignments": [
            {"study": one.task, "member": one.member, "variant": one.variant, "value": one.value}
            for one in portfolio.assignments
        ],
        "value": portfolio.objective,
        "value_recomputed": portfolio.objective_recomputed,
        "gap": portfolio.gap,
        "by_size": list(portfolio.by_size),
        "by_size_gap": list(portfolio.by_size_gap),
        "unserved": list(portfolio.unserved),
        "enumeration_agrees": portfolio.enumeration_agrees.value,
        "checks": checks_to_json(portfolio.checks),
        "cut": None if portfolio.cut is None else portfolio.cut.value,
    }
