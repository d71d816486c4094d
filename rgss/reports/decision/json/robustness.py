"""The robustness of a decision as plain values for JSON; docs/robustness.md describes them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from rgss.decision.robustness import (
    AssumptionFinding,
    CostBox,
    Part,
    RequirementPrice,
    Robustness,
    WeightRobustness,
)
from rgss.decision.what_if import Change, Scenario
from rgss.reports.decision.json.effects import effects_to_json
from rgss.tradeoff.robustness import Acceptability, RankReversal
from rgss.tradeoff.weights import WeightRegion

Plain = dict[str, object]


def robustness_to_json(found: Robustness) -> Plain:
    """Turn the analyses into dictionaries, lists, strings, numbers and None.

    Returns:
        A document that `json.dumps` takes as it is, even with ``allow_nan=False``. Alternatives go
        by their variants' ids; an unbounded end is None.
    """
    return {
        "weights": dict(zip(found.measures, found.weights.tolist(), strict=True)),
        "noise": {"draws": found.draws, "resamples": found.resamples, "all_resamples": found.all_resamples},
        "pareto": None if Part.PARETO in found.not_computed else _front(found),
        "weight_changes": None if found.weighting is None else _weighting(found, found.weighting),
        "assumptions": None if Part.ASSUMPTIONS in found.not_computed else assumptions_to_json(found),
        "costs": costs_to_json(found),
        "prices": None if Part.PRICES in found.not_computed else [_price(found, one) for one in found.prices],
        "rank_reversals": {
            "of_the_program": _reversals(found, found.reversals, Part.REVERSALS),
            "if_values_were_stretched_over_the_sample": _reversals(found, found.stretched, Part.STRETCHED),
        },
        "effects": None if Part.EFFECTS in found.not_computed else effects_to_json(found.effects),
        "refused": dict(found.refused),
        "not_computed": not_computed_to_json(found),
    }


def not_computed_to_json(found: Robustness) -> Plain:
    """Reasons of the parts that were not computed, by their place in the document: a part of `robustness_to_json`."""
    return {part.value: {"reason": why.reason, "remedy": why.remedy} for part, why in found.not_computed.items()}


def _front(found: Robustness) -> list[Plain]:
    return [
        {
            "variant": found.variants[point.row],
            "support": point.support.value,
            "shortfall": point.shortfall,
            "dominated_by": None if point.dominated_by is None else found.variants[point.dominated_by],
        }
        for point in found.front.points
    ]


def assumptions_to_json(found: Robustness) -> list[Plain]:
    """Ranges of the assumed numbers: a part of `robustness_to_json`, which is long for many variants."""
    return [_assumption(found, one) for one in found.assumptions]


def costs_to_json(found: Robustness) -> Plain | None:
    """Range of all costs together: a part of `robustness_to_json`."""
    return None if found.costs is None else _costs(found, found.costs)


def scenario_to_json(scenario: Scenario) -> Plain:
    """Turn suppositions into plain values."""
    return {
        "changes": [_change(change) for change in scenario.changes],
        "rescaled": [_change(change) for change in scenario.rescaled],
        "dropped_variants": list(scenario.dropped),
        "simulated_with": list(scenario.simulated),
    }


def _change(change: Change) -> Plain:
    return {"id": change.id, "before": change.before, "after": change.after, "unit": change.unit}


def _weighting(found: Robustness, weighting: WeightRobustness) -> Plain:
    return {
        "within_elicited_bounds": weighting.elicited,
        "regions": None if weighting.regions is None else _regions(found, weighting.regions),
        "nearest": None
        if weighting.shifts is None
        else [
            {
                "variants": _variants(found, shift.rows),
                "distance": shift.distance,
                "weights": _by_measure(found, shift.nearest),
                "moved": shift.sum_distance / 2.0,
                "weights_by_sum": _by_measure(found, shift.nearest_in_sum),
            }
            for shift in weighting.shifts
        ],
        "ranges": None
        if weighting.ranges is None
        else [
            {
                "measure": measure,
                "weight": float(weight),
                "low": one.low,
                "high": one.high,
                "below": _variants(found, one.below),
                "above": _variants(found, one.above),
            }
            for measure, weight, one in zip(found.measures, found.weights, weighting.ranges, strict=True)
        ],
        "acceptability": None
        if weighting.acceptability is None
        else _acceptability(found, weighting, weighting.acceptability),
    }


def _regions(found: Robustness, regions: Sequence[WeightRegion]) -> list[Plain]:
    return [
        {
            "variant": variant,
            "kind": region.kind.value,
            "share": region.share,
            "share_error": region.share_error,
            "share_by": region.share_by.value,
            "centre": _by_measure(found, region.centre),
            "radius": region.radius,
            "low": _by_measure(found, region.low),
            "high": _by_measure(found, region.high),
        }
        for variant, region in zip(found.variants, regions, strict=True)
    ]


def _acceptability(found: Robustness, weighting: WeightRobustness, indices: Acceptability) -> Plain:
    return {
        "iterations": indices.iterations,
        "drawn_by": indices.drawn_by.value,
        "with_noise": weighting.with_noise,
        "alternatives": [
            {
                "variant": variant,
                "ranks": {str(rank): float(share) for rank, share in enumerate(indices.ranks[row], start=1) if share},
                "first": float(indices.first[row]),
                "first_error": float(np.asarray(weighting.first_errors, dtype=np.float64)[row]),
                "unranked": float(indices.unranked[row]),
                "central_weights": _by_measure(found, indices.central_weights[row]),
                "confidence": _finite(float(indices.confidence[row])),
                "confidence_error": _finite(float(indices.confidence_errors[row])),
            }
            for row, variant in enumerate(found.variants)
        ],
    }


def _assumption(found: Robustness, one: AssumptionFinding) -> Plain:
    span = one.range
    return {
        "id": one.number.id,
        "assumed": one.number.value,
        "unit": one.number.unit,
        "rationale": one.number.rationale,
        "measures": list(one.columns),
        "trials_were_simulated_with_it": one.simulated,
        "low": None if span is None else span.low,
        "high": None if span is None else span.high,
        "followed_from": None if span is None else _finite(span.lowest),
        "followed_to": None if span is None else _finite(span.highest),
        "below": [] if span is None else _variants(found, span.below),
        "above": [] if span is None else _variants(found, span.above),
        "exact": None if span is None else span.exact,
        "not_followed_because": one.reason or None,
    }


def _costs(found: Robustness, box: CostBox) -> Plain:
    corner = box.range.corner
    return {
        "measure": box.column,
        "factor": box.range.factor,
        "followed_to": box.range.most,
        "overtaken_by": _variants(found, box.range.overtaken_by),
        "worst_corner": None
        if corner is None
        else {number.id: float(value) for number, value in zip(box.numbers, corner, strict=True)},
        "assumed": {number.id: number.value for number in box.numbers},
        "unmoved": list(box.unmoved),
    }


def _price(found: Robustness, price: RequirementPrice) -> Plain:
    return {
        "requirement": price.condition.requirement,
        "demand": price.condition.demand,
        "limit": price.condition.limit,
        "unit": price.condition.limit_unit,
        "sense": price.condition.sense.value,
        "values_kept": list(price.anchored),
        "steps": [
            {
                "after": _finite(step.loosest),
                "up_to": _finite(step.tightest),
                "best": _variants(found, step.best),
                "value": step.value,
                "feasible": step.feasible,
                "leaving": _variants(found, step.leaving),
            }
            for step in price.steps
        ],
    }


def _reversals(found: Robustness, reversals: Iterable[RankReversal], part: Part) -> list[Plain] | None:
    if part in found.not_computed:
        return None
    return [
        {
            "removed": found.variants[one.removed],
            "best_before": found.variants[one.best_before],
            "best_after": found.variants[one.best_after],
            "swapped": one.swapped,
        }
        for one in reversals
    ]


def _by_measure(found: Robustness, weights: NDArray[np.float64] | None) -> dict[str, float] | None:
    if weights is None or np.isnan(weights).any():
        return None
    return dict(zip(found.measures, weights.tolist(), strict=True))


def _variants(found: Robustness, rows: Sequence[int]) -> list[int]:
    return [found.variants[row] for row in rows]


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
