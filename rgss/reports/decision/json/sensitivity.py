"""Sensitivity of a decision as plain values for JSON; docs/robustness.md describes them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import numpy as np

from rgss.decision.sensitivity import (
    BentEnd,
    BentValue,
    ExchangeRate,
    ExchangeRates,
    FlatWeight,
    Sensitivity,
    Tornado,
    TornadoBar,
    TornadoEnd,
    Worth,
)
from rgss.tradeoff.robustness import KeptAlternative, StakeholderAgreement

Plain = dict[str, object]


def sensitivity_to_json(found: Sensitivity) -> Plain:
    """The sensitivity as dictionaries, lists, strings, numbers and None; designs go by their ids."""
    return {
        "tornado": None if found.tornado is None else tornado_to_json(found.tornado),
        "bent_values": [_bend(one) for one in found.bends],
        "exchange_rates": None if found.exchange is None else _exchange(found.exchange),
        "worth_keeping": None if found.kept is None else _kept(found, found.kept),
        "stakeholders": None if found.agreement is None else _agreement(found, found.agreement),
        "flat_weights": [_flat(one) for one in found.flat],
        "refused": found.refused,
        "not_computed": {
            part.value: {"reason": why.reason, "remedy": why.remedy} for part, why in found.not_computed.items()
        },
    }


def tornado_to_json(tornado: Tornado) -> Plain:
    """The tornado: a part of `sensitivity_to_json`."""
    return {
        "chosen": tornado.chosen,
        "rival": tornado.rival,
        "lead": tornado.lead,
        "tied": list(tornado.tied),
        "inputs": [_bar(bar) for bar in tornado.bars],
        "without_range": list(tornado.without_range),
    }


def _bar(bar: TornadoBar) -> Plain:
    return {
        "input": bar.id,
        "kind": bar.kind.value,
        "unit": bar.unit,
        "base": bar.base,
        "range_is": bar.basis.value,
        "swing": None if math.isinf(bar.swing) else bar.swing,
        "flips_exact": bar.exact,
        "low": _end(bar.low),
        "high": _end(bar.high),
    }


def _end(end: TornadoEnd) -> Plain:
    return {
        "value": end.value,
        "lead": end.lead,
        "feasible": end.feasible,
        "winners": list(end.winners),
        "rival": end.rival,
        "flip": end.flip,
        "flip_winners": list(end.flip_winners),
    }


def _bend(one: BentValue) -> Plain:
    return {
        "measure": one.measure or None,
        "unit": one.unit,
        "convex": _bent_end(one.convex),
        "concave": _bent_end(one.concave),
    }


def _bent_end(end: BentEnd) -> Plain:
    return {
        "curvature": end.curvature,
        "lead": end.lead,
        "winners": list(end.winners),
        "flip": end.flip,
        "flip_winners": list(end.flip_winners),
        "flip_risk_tolerance": end.flip_tolerance,
        "flip_halfway": end.flip_halfway,
    }


def _exchange(found: ExchangeRates) -> Plain:
    return {
        "variant": found.variant,
        "reference": found.reference,
        "unit": found.unit,
        "more_is_better": found.more_is_better,
        "measures": [_rate(rate) for rate in found.rates],
        "rival": found.rival,
        "lead": None if found.lead is None else _worth(found.lead),
    }


def _rate(rate: ExchangeRate) -> Plain:
    better = rate.better
    return {
        "measure": rate.measure,
        "unit": rate.unit,
        "quantity": rate.quantity,
        "step": rate.step,
        "gain": rate.gain,
        "worth": _worth(rate.worth),
        "better_design": None
        if better is None
        else {
            "variant": better.variant,
            "quantity": better.quantity,
            "extra": better.extra,
            "value_change": None if math.isnan(better.value_change) else better.value_change,
            "misses": list(better.misses),
            "is_tied": better.is_tied,
        },
    }


def _worth(worth: Worth) -> Plain:
    return {"amount": worth.amount, "is_bound": worth.is_bound}


def _kept(found: Sensitivity, kept: Sequence[KeptAlternative]) -> Plain:
    return {
        "margin": found.keep_margin,
        "within_elicited_bounds": found.bounded_weights,
        "designs": [
            {
                "variant": found.variants[one.row],
                "kept": one.is_kept,
                "reason": one.reason.value,
                "shortfall": one.shortfall,
                "behind": one.behind,
                "weights": None if one.weights is None else _weights(found.measures, one.weights.tolist()),
                "beaten_by": [found.variants[row] for row in one.beaten_by],
            }
            for one in kept
        ],
    }


def _agreement(found: Sensitivity, agreement: StakeholderAgreement) -> Plain:
    def ids(rows: Iterable[int]) -> list[int]:
        return [found.variants[row] for row in rows]

    def known(number: float) -> float | None:
        return None if math.isnan(number) else float(number)

    judged = [~np.isnan(view.regrets) for view in agreement.views]
    unknown = {row for view in agreement.views for row in view.unknown}
    feasible = sorted(unknown.union(np.flatnonzero(np.logical_or.reduce(judged)).tolist()))
    return {
        "accept_within": found.accept_within,
        "views": [
            {
                "name": view.name,
                "weights": _weights(found.weighed, view.weights.tolist()),
                "chooses": ids(view.best),
                "value": view.best_value,
                "accepts": ids(view.accepted),
                "cannot_judge": ids(view.unknown),
            }
            for view in agreement.views
        ],
        "accepted_by_all": ids(agreement.accepted_by_all),
        "compromise": ids(agreement.compromise),
        "largest_regret": known(agreement.largest_regret),
        "most_regretful": list(agreement.most_regretful),
        "designs": [
            {
                "variant": found.variants[row],
                "regrets": {view.name: known(view.regrets[row]) for view in agreement.views},
                "largest_regret": known(agreement.largest_regrets[row]),
                "borda": known(agreement.borda[row]),
            }
            for row in feasible
        ],
    }


def _flat(one: FlatWeight) -> Plain:
    return {
        "measure": one.measure,
        "unit": one.unit,
        "weight": one.weight,
        "low": one.low,
        "high": one.high,
        "all_low": None if math.isnan(one.all_low) else one.all_low,
        "all_high": None if math.isnan(one.all_high) else one.all_high,
        "among_feasible": one.among_feasible,
        "remedy": one.remedy.value,
        "effective_weights": dict(one.effective),
    }


def _weights(measures: Sequence[str], weights: Sequence[float]) -> dict[str, float]:
    return dict(zip(measures, weights, strict=True))
