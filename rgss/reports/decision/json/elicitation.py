"""Weights that follow from pairwise answers as plain values for JSON; docs/weights.md describes them."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

from rgss.tradeoff.elicitation import Consistency, ElicitedWeights, PairwiseAnswer

Plain = dict[str, object]


def elicitation_to_json(elicited: Iterable[ElicitedWeights], by: Mapping[str, ElicitedWeights]) -> list[Plain]:
    """Weights that follow from pairwise answers, of the study and then of its stakeholders."""
    return [
        *(_elicited(one, stakeholder=None) for one in elicited),
        *(_elicited(one, stakeholder=name) for name, one in by.items()),
    ]


def _elicited(one: ElicitedWeights, *, stakeholder: str | None) -> Plain:
    return {
        "stakeholder": stakeholder,
        "digest": one.digest,
        "method": one.method.value,
        "factor": one.factor,
        "weights": [
            {"criterion": name, "weight": weight, "low": one.low[name], "high": one.high[name]}
            for name, weight in one.weights.items()
        ],
        "answers": [_answer(answer) for answer in one.answers],
        "consistency": None if one.consistency is None else _consistency(one.consistency),
    }


def _answer(answer: PairwiseAnswer) -> Plain:
    return {
        "swing_of": answer.swing_of,
        "over": answer.over,
        "least": answer.least,
        "most": None if math.isinf(answer.most) else answer.most,
    }


def _consistency(one: Consistency) -> Plain:
    triad, worst = one.worst_triad, one.worst_answer
    return {
        "acceptable": one.is_acceptable,
        "criteria": one.criteria,
        "answers": one.answers,
        "checks": one.checks,
        "ratio": one.ratio,
        "index": one.index,
        "index_limit": one.index_limit,
        "bound_factor": one.bound_factor,
        "bound_factor_limit": one.greatest_bound_factor,
        "beyond_bounds": [
            {
                "answer": _answer(beyond.answer),
                "least": beyond.least,
                "most": None if math.isinf(beyond.most) else beyond.most,
            }
            for beyond in one.beyond_bounds
        ],
        "worst_triad": None
        if triad is None
        else {
            "answers": [_answer(answer) for answer in triad.answers],
            "factor": triad.factor,
            "mends": list(triad.mends),
        },
        "worst_answer": None
        if worst is None
        else {
            "answer": _answer(worst.answer),
            "factor": worst.factor,
            "fitted": worst.fitted,
            "implied": worst.implied,
        },
    }
