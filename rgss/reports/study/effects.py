"""Effects of the design's factors on the measures, in the document of the report."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.assessment import VariantMeasures
from rgss.decision.robustness import MeasureEffects, StudyEffects
from rgss.reports.decision import usable_resamples_sentence
from rgss.reports.plain_numbers import Plain, plain_number, plain_numbers


def factor_columns(measured: Sequence[VariantMeasures], effects: StudyEffects) -> list[Plain]:
    """The factors that vary, with the level that each variant has of each; -1 for a value of a range.

    Args:
        measured: Every variant.
        effects: The effects, which name the factors.
    """
    return [
        {
            "id": factor.id,
            "parameters": list(factor.parameters),
            "levels": list(factor.levels),
            "level": [
                factor.levels.index(level) if (level := entry.variant.levels.get(factor.id)) in factor.levels else -1
                for entry in measured
            ],
        }
        for factor in effects.factors
    ]


def effect_columns(effects: StudyEffects) -> list[Plain]:
    """The main effects of all factors on each measure, and the shares of interactions."""
    return [_effects(one) for one in effects.measures]


def _effects(one: MeasureEffects) -> Plain:
    analysis = one.analysis
    terms = [] if analysis is None else list(analysis.effects)
    levels = {factor.id: list(factor.levels) for factor in one.factors}
    return {
        "measure": one.measure,
        "unit": one.unit,
        "designs": one.designs,
        "left_out": list(one.left_out),
        "mean": None if analysis is None else plain_number(analysis.mean),
        "note": "" if analysis is None else usable_resamples_sentence(analysis),
        "not_computed": one.not_computed,
        "main": [
            {
                "factor": term.factors[0],
                "levels": levels[term.factors[0]],
                "effect": plain_numbers(term.levels.tolist()),
                "low": None if term.low is None else plain_numbers(term.low.tolist()),
                "high": None if term.high is None else plain_numbers(term.high.tolist()),
                "share": plain_number(term.share),
            }
            for term in terms
            if len(term.factors) == 1
        ],
        "interactions": [
            {"factors": list(term.factors), "share": plain_number(term.share)}
            for term in terms
            if len(term.factors) > 1 and term.share > 0.0
        ],
        "shares": [
            {
                "factor": factor,
                "share": plain_number(index.share),
                "low": plain_number(index.low),
                "high": plain_number(index.high),
            }
            for factor, index in one.sampled.items()
        ],
    }
