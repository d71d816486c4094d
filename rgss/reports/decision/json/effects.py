"""Effects of the factors as plain values for JSON; docs/robustness.md describes them."""

from __future__ import annotations

from rgss.decision.robustness import FactorLevels, MeasureEffects, StudyEffects
from rgss.tradeoff.robustness import Effect

Plain = dict[str, object]


def effects_to_json(effects: StudyEffects) -> Plain:
    """Turn the effects on every measure into plain values."""
    return {
        "factors": [_factor(factor) for factor in effects.factors],
        "constant_parameters": list(effects.constants),
        "measures": [_measure_effects(one) for one in effects.measures],
    }


def _factor(factor: FactorLevels) -> Plain:
    return {"id": factor.id, "parameters": list(factor.parameters), "levels": list(factor.levels)}


def _measure_effects(one: MeasureEffects) -> Plain:
    analysis = one.analysis
    return {
        "measure": one.measure,
        "unit": one.unit,
        "designs": one.designs,
        "left_out": list(one.left_out),
        "not_computed": one.not_computed,
        "factors": [_factor(factor) for factor in one.factors],
        "mean": None if analysis is None else analysis.mean,
        "total_sum_of_squares": None if analysis is None else analysis.total_sum_of_squares,
        "first_order": {} if analysis is None else dict(analysis.first_order),
        "total_order": {} if analysis is None else dict(analysis.total_order),
        "higher_order_share": None if analysis is None else analysis.rest,
        "usable_resamples": None if analysis is None else analysis.used,
        "sampled_first_order": {
            factor: {"share": index.share, "low": index.low, "high": index.high}
            for factor, index in one.sampled.items()
        },
        "effects": [] if analysis is None else [_effect(effect) for effect in analysis.effects],
    }


def _effect(effect: Effect) -> Plain:
    return {
        "factors": list(effect.factors),
        "levels": effect.levels.tolist(),
        "low": None if effect.low is None else effect.low.tolist(),
        "high": None if effect.high is None else effect.high.tolist(),
        "sum_of_squares": effect.sum_of_squares,
        "degrees_of_freedom": effect.degrees_of_freedom,
        "share": effect.share,
        "share_low": effect.share_low,
        "share_high": effect.share_high,
    }
