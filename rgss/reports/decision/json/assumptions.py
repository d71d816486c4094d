"""Modelling assumptions that are questioned, in the JSON document of a decision."""

from __future__ import annotations

from typing import Any

from rgss.decision.assumptions import AssumptionOutcome


def modelling_assumption_to_json(one: AssumptionOutcome) -> dict[str, Any]:
    """The choice under one alternative of one assumption."""
    return {
        "assumption": one.question.about,
        "taken_as": one.taken_as,
        "alternative": one.question.alternative,
        "chosen": one.chosen,
        "ties": list(one.ties),
        "feasible": one.feasible,
        "changes_choice": None if one.is_same is None else not one.is_same,
        "unseparated": one.is_unseparated,
        "excluded_by": list(one.excluded_by),
        "missed_by_choice": list(one.missed_by_choice),
        "trials": one.trials,
        "missing_trials": one.missing,
        "read_off": one.read_off,
        "trials_gained": one.otherwise[0],
        "trials_lost": one.otherwise[1],
        "of_the_choice": one.otherwise_of_choice,
        "failed_in_motion": None
        if one.in_motion is None
        else {kind.value: count for kind, count in one.in_motion.by_kind.items()},
        "failed_in_motion_of_the_choice": None if one.in_motion is None else one.in_motion.of_choice,
        "admitted": None
        if one.admitted is None
        else {
            "designs": one.admitted.count,
            "best": one.admitted.best,
            "gain": one.admitted.gain,
            "measure": one.admitted.measure,
            "loss": one.admitted.loss,
        },
        "reason": one.reason,
    }
