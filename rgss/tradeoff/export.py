"""A decision as plain values for JSON."""

from __future__ import annotations

from collections.abc import Iterable

from rgss.tradeoff.certificate import Certificate
from rgss.tradeoff.conflicts import Conflicts, RequirementCount
from rgss.tradeoff.decision import Contribution, Decision, InfeasibleAlternative


def decision_to_json(decision: Decision) -> dict[str, object]:
    """Turn a decision into dictionaries, lists, strings, numbers and None.

    Args:
        decision: The decision.

    Returns:
        A document that `json.dumps` takes as it is, even with ``allow_nan=False``.
    """
    return {
        "status": decision.status.value,
        "chosen": decision.chosen,
        "runner_up": decision.runner_up,
        "ties": list(decision.ties),
        "ranking": [{"variant": ranked.variant, "value": ranked.value} for ranked in decision.ranking],
        "infeasible": _infeasible(decision.infeasible),
        "excluded_better": _infeasible(decision.excluded_better),
        "deciding_requirements": _counts(decision.deciding_requirements),
        "contributions": {
            "chosen": _contributions(decision.chosen_contributions),
            "runner_up": _contributions(decision.runner_up_contributions),
        },
        "conflicts": _conflicts(decision.conflicts),
        "certificate": _certificate(decision.certificate),
    }


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
    return {
        "excluded_by": _counts(conflicts.excluded_by),
        "minimal_conflict": list(conflicts.minimal_conflict),
        "nearest": {
            "variant": conflicts.nearest.variant,
            "requirements": list(conflicts.nearest.requirements),
        },
    }


def _certificate(certificate: Certificate) -> dict[str, object]:
    return {
        "enumeration_agrees": certificate.enumeration_agrees,
        "status": certificate.status.value,
        "solver": certificate.solver,
        "alternatives": certificate.alternatives,
        "considered": certificate.considered,
        "solver_choice": certificate.solver_choice,
        "objective": certificate.objective,
        "objective_recomputed": certificate.objective_recomputed,
        "gap": certificate.gap,
        "residuals": [
            {"name": residual.name, "residual": residual.residual, "margin": residual.margin}
            for residual in certificate.residuals
        ],
    }
