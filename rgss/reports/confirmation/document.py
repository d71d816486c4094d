"""A confirmation as plain data."""

from __future__ import annotations

from typing import Any

from rgss.confirmation import COMPARED_METRICS, Confirmation, ConfirmedTrial, SettingResult
from rgss.reports.confirmation.sentences import choice_sentence, decision_sentence, outcome_sentence, verdict_sentence
from rgss.reports.plain_numbers import plain_number


def confirmation_to_json(confirmation: Confirmation) -> dict[str, Any]:
    """The confirmation as plain data; metrics are in the unit at the end of their name."""
    selection = confirmation.selection
    return {
        "study": confirmation.study,
        "holds": confirmation.holds,
        "decision": decision_sentence(confirmation),
        "choice": choice_sentence(confirmation),
        "verdicts": verdict_sentence(confirmation),
        "outcomes": outcome_sentence(confirmation),
        "arm_is_pybullet": confirmation.arm_is_pybullet,
        "chosen": selection.chosen,
        "variants": [variant.id for variant in selection.variants],
        "designs": confirmation.designs,
        "rivals_left_out": list(selection.left_out),
        "seeds": list(confirmation.seeds),
        "trials_before_physics": confirmation.before_physics,
        "failures": {
            "before_physics": selection.planned_failures,
            "in_physics": selection.physical_failures,
            "sampled": [{"variant": variant, "seed": seed} for variant, seed in selection.sample],
        },
        "settings": [_setting(result) for result in confirmation.results],
        "differing_verdicts": [
            {
                "variant": one.variant,
                "requirement": one.requirement,
                "setting": confirmation.results[one.setting].setting.label,
                "study": one.study.value,
                "other": one.other.value,
            }
            for one in confirmation.differing_verdicts
        ],
        "trials": [_trial(confirmation, trial) for trial in confirmation.trials],
        "run": confirmation.made,
        "evidence": confirmation.evidence,
    }


def _setting(result: SettingResult) -> dict[str, Any]:
    physics = result.setting.physics
    return {
        "setting": result.setting.label,
        "varies": result.setting.aspect.value,
        "rate_hz": physics.rate_hz,
        "solver_iterations": physics.solver_iterations,
        "first": result.first,
        "ties": list(result.ties),
        "ranking": [{"variant": variant, "value": plain_number(value)} for variant, value in result.ranking],
        "verdicts": [
            {"variant": variant, "requirement": requirement, "verdict": verdict.value}
            for variant, verdicts in result.verdicts.items()
            for requirement, verdict in verdicts.items()
        ],
    }


def _trial(confirmation: Confirmation, trial: ConfirmedTrial) -> dict[str, Any]:
    return {
        "variant": trial.variant,
        "seed": trial.seed,
        "sample": trial.is_sample,
        "differs": bool(trial.differing),
        "settings": [
            {
                "setting": result.setting.label,
                "outcome": trial.outcome(index),
                "detail": trial.records[index].failure_detail,
                "metrics": {name: plain_number(trial.metric(name, index)) for name in COMPARED_METRICS},
            }
            for index, result in enumerate(confirmation.results)
        ],
    }
