"""Conclusion from the evidence as plain values for JSON; docs/robustness.md describes them."""

from __future__ import annotations

from rgss.decision.study_decision import DesignStanding, Feasibility, StudyDecision
from rgss.reports.decision.conclusion import headline, rule_sentence, stale_sentence, standing_sentence

Plain = dict[str, object]


def conclusion_to_json(made: StudyDecision) -> Plain:
    """Conclusion from the verdicts and the posterior draws as plain values."""
    found = made.conclusion
    return {
        "headline": headline(made),
        "requirements": standing_sentence(made),
        "stale": stale_sentence(made),
        "rule": {
            "sentence": rule_sentence(made),
            "practical_margin": made.practical_margin,
            "tolerance": made.tolerance,
            "of_equals": "last" if made.last_of_equals else "first",
        },
        "counts": {kind.value: found.count(kind) for kind in Feasibility},
        "open_by": list(found.open_by),
        "unmeasured": list(found.unmeasured),
        "failed_tests": list(found.failed.tests),
        "failed_records": list(found.failed.records),
        "chosen": None if found.chosen is None else _standing(found.chosen),
        "variants": [{"variant": one.variant, "feasibility": one.feasibility.value} for one in found.standings],
        "uncertainty": _uncertainty(made),
        "seeds": [
            {"first": one.first, "last": one.last, "absent": list(one.absent), "variants": list(one.variants)}
            for one in made.seeds
        ],
    }


def _standing(one: DesignStanding) -> Plain:
    return {
        "variant": one.variant,
        "feasibility": one.feasibility.value,
        "met": list(one.met),
        "open": list(one.open),
        "missed": list(one.missed),
        "not_run": list(one.not_run),
        "undecided": list(one.undecided),
    }


def _uncertainty(made: StudyDecision) -> Plain | None:
    weighting = None if made.robustness is None else made.robustness.analysis.weighting
    if made.robustness is None or weighting is None or weighting.uncertainty is None:
        return None
    one, variants = weighting.uncertainty, made.robustness.analysis.variants
    return {
        "best_and_feasible": float(one.best[one.chosen]),
        "feasible": float(one.feasible[one.chosen]),
        "feasible_as_required": one.as_required,
        "within_margin": one.good,
        "none_feasible": one.none_feasible,
        "variants": [
            {"variant": variant, "best": float(best), "feasible": float(feasible)}
            for variant, best, feasible in zip(variants, one.best, one.feasible, strict=True)
        ],
        "ties": [
            {
                "variant": variants[rival.row],
                "probability": rival.probability,
                "within_margin": rival.within_margin,
                "replicates": rival.replicates,
                "separated": rival.separated,
                "measure": rival.measure,
                "by_feasibility": rival.by_feasibility,
                "fixed": rival.fixed,
                "clipped": list(rival.clipped),
            }
            for rival in one.rivals
        ],
        "expected_gains": [{"replicates": count, "gain": gain} for count, gain in one.gains.of_more],
        "perfect_knowledge": one.gains.perfect,
        "scarce": list(one.scarce),
        "heavy_tailed": list(one.heavy_tailed),
    }
