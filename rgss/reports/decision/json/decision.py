"""A decision as plain values for JSON."""

from __future__ import annotations

import math
from collections.abc import Iterable

from rgss.tradeoff import Check, Conflicts, Contribution, Decision, InfeasibleAlternative, LimitChange, RequirementCount
from rgss.tradeoff.programs import Certificate


def decision_to_json(decision: Decision) -> dict[str, object]:
    """Turn a decision into dictionaries, lists, strings, numbers and None.

    Returns:
        A document that `json.dumps` takes as it is, even with ``allow_nan=False``.
    """
    return {
        "program": decision.program,
        "objectives": list(decision.objectives),
        "status": decision.status.value,
        "chosen": decision.chosen,
        "runner_up": decision.runner_up,
        "ties": list(decision.ties),
        "surpassed": list(decision.surpassed),
        "near_ties": list(decision.near_ties),
        "ranking": [
            {"variant": ranked.variant, "value": ranked.value, "objectives": list(ranked.objectives)}
            for ranked in decision.ranking
        ],
        "infeasible": _infeasible(decision.infeasible),
        "excluded_better": _infeasible(decision.excluded_better),
        "deciding_requirements": _counts(decision.deciding_requirements),
        "contributions": {
            "chosen": _contributions(decision.chosen_contributions),
            "runner_up": _contributions(decision.runner_up_contributions),
        },
        "conflicts": _conflicts(decision.conflicts),
        "flat_measures": [
            {
                "measure": flat.measure,
                "weight": flat.weight,
                "low": flat.low,
                "high": flat.high,
                "among_feasible": flat.among_feasible,
            }
            for flat in decision.flat_measures
        ],
        "demands": dict(decision.demands),
        "counts": {
            "alternatives": decision.counts.alternatives,
            "feasible": decision.counts.feasible,
            "excluded_better": decision.counts.excluded_better,
        },
        "certificate": certificate_to_json(decision.certificate),
    }


def certificate_to_json(certificate: Certificate) -> dict[str, object]:
    """Turn a certificate into plain values."""
    return {
        "enumeration_agrees": certificate.enumeration_agrees.value,
        "recomputation_agrees": certificate.recomputation_agrees,
        "checks": checks_to_json(certificate.checks),
        "status": certificate.status.value,
        "solver": certificate.solver,
        "program": certificate.program,
        "alternatives": certificate.alternatives,
        "considered": certificate.considered,
        "stages": [
            {"name": stage.name, "variant": stage.variant, "objective": stage.objective, "gap": stage.gap}
            for stage in certificate.stages
        ],
        "solver_choice": certificate.solver_choice,
        "objective": certificate.objective,
        "objective_recomputed": certificate.objective_recomputed,
        "gap": certificate.gap,
        "residuals": [
            {
                "name": residual.name,
                "residual": residual.residual if math.isfinite(residual.residual) else None,
                "margin": residual.margin,
            }
            for residual in certificate.residuals
        ],
    }


def checks_to_json(checks: Iterable[Check]) -> list[dict[str, object]]:
    """Turn the independent checks of an answer into plain values."""
    return [{"kind": check.kind.value, "agrees": check.agrees, "detail": check.detail} for check in checks]


def _infeasible(alternatives: Iterable[InfeasibleAlternative]) -> list[dict[str, object]]:
    return [
        {"variant": alternative.variant, "requirements": list(alternative.requirements), "value": alternative.value}
        for alternative in alternatives
    ]


def _counts(counts: Iterable[RequirementCount]) -> list[dict[str, object]]:
    return [{"requirement": count.requirement, "excluded": count.excluded} for count in counts]


def _contributions(contributions: Iterable[Contribution]) -> list[dict[str, object]]:
    return [
        {
            "measure": contribution.measure,
            "quantity": contribution.quantity,
            "value": contribution.value,
            "weight": contribution.weight,
            "contribution": contribution.contribution,
        }
        for contribution in contributions
    ]


def _conflicts(conflicts: Conflicts | None) -> dict[str, object] | None:
    if conflicts is None:
        return None
    survival = conflicts.survival
    return {
        "excluded_by": _counts(conflicts.excluded_by),
        "minimal_conflict": list(conflicts.minimal_conflict),
        "minimal_conflicts": [list(each) for each in conflicts.minimal_conflicts],
        "complete": conflicts.complete,
        "corrections": [list(each) for each in conflicts.corrections],
        "nearest": {
            "variant": conflicts.nearest.variant,
            "requirements": list(conflicts.nearest.requirements),
        },
        "repairs": [
            {
                "requirement": repair.requirement,
                "changes": _changes(repair.changes),
                "unlocked": repair.unlocked,
                "winner": repair.winner,
            }
            for repair in conflicts.repairs
        ],
        "joint_repairs": [
            {
                "requirements": list(repair.requirements),
                "changes": _changes(repair.changes),
                "unlocked": repair.unlocked,
                "winner": repair.winner,
            }
            for repair in conflicts.joint_repairs
        ],
        "survival": None
        if survival is None
        else {
            "resamples": survival.resamples,
            "exact": survival.exact,
            "nothing_feasible": survival.nothing_feasible,
            "conflicts": list(survival.conflicts),
        },
    }


def _changes(changes: Iterable[LimitChange]) -> list[dict[str, object]]:
    return [
        {
            "requirement": change.requirement,
            "demand": change.demand,
            "limit": change.limit,
            "needed": change.needed,
            "unit": change.unit,
            "relative": change.relative,
        }
        for change in changes
    ]
