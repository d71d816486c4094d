"""Ratios that contradict orders and ranges: found, named, and judged by the limit of the index."""

from __future__ import annotations

import math
import random

import numpy as np
import pytest
from scipy.optimize import minimize

from rgss.errors import TradeoffError
from rgss.reports.decision.answers_in_words import consistency_sentences, verdict_phrase
from rgss.tradeoff.elicitation import PairwiseAnswer, weights_from_answers

NAMES = ("a", "b", "c", "d")


def answer(one, other, least, most=None):
    return PairwiseAnswer(swing_of=one, over=other, least=least, most=least if most is None else most)


def missed(answers):
    """Least greatest miss of the ratios within the bounds, by a general solver over logarithms."""

    def log(values, name):
        return values[NAMES.index(name)]

    ratios = [one for one in answers if one.is_ratio]
    bounds = [one for one in answers if not one.is_ratio]
    limits = [
        {"type": "ineq", "fun": lambda v, one=one: log(v, one.swing_of) - log(v, one.over) - math.log(one.least)}
        for one in bounds
    ]
    limits += [
        {"type": "ineq", "fun": lambda v, one=one: math.log(one.most) - log(v, one.swing_of) + log(v, one.over)}
        for one in bounds
        if math.isfinite(one.most)
    ]
    for one in ratios:
        for sign in (1.0, -1.0):
            limits.append(
                {
                    "type": "ineq",
                    "fun": lambda v, one=one, sign=sign: (
                        v[-1] - sign * (log(v, one.swing_of) - log(v, one.over) - math.log(one.ratio))
                    ),
                }
            )
    found = minimize(lambda v: v[-1], np.zeros(len(NAMES) + 1), constraints=limits, method="SLSQP")
    assert found.success
    return math.exp(found.fun)


def test_a_ratio_outside_the_range_of_the_same_pair():
    found = weights_from_answers(NAMES[:2], [answer("a", "b", 1, 2), answer("a", "b", 0.001)])
    assert found.consistency.is_acceptable is False
    assert found.consistency.bound_factor == pytest.approx(1000.0)
    assert verdict_phrase(found) == "the answers are too inconsistent"
    assert list(consistency_sentences(found.consistency))[:2] == [
        "The orders and ranges contradict the ratios: the worst is missed by ×1e+03 because of them, limit ×1.84.",
        "a = 0.001 × b, while orders and ranges allow 1 to 2.",
    ]


def test_a_ratio_beyond_a_chain_of_ranges():
    chain = [answer("a", "b", 1, 2), answer("b", "c", 1, 2), answer("c", "d", 1, 2)]
    found = weights_from_answers(NAMES, [*chain, answer("a", "d", 20)]).consistency
    assert (found.is_acceptable, found.bound_factor) == (False, pytest.approx(20 / 8))
    (beyond,) = found.beyond_bounds
    assert (beyond.least, beyond.most) == (pytest.approx(1.0), pytest.approx(8.0))


def test_an_order_that_two_ratios_contradict_together():
    """None of the ratios alone is excluded."""
    found = weights_from_answers(
        NAMES[:3], [answer("a", "b", 4), answer("b", "c", 4), answer("c", "a", 1, math.inf)]
    ).consistency
    assert found.beyond_bounds == ()
    assert found.bound_factor == pytest.approx(4.0)
    assert found.is_acceptable is False


def test_a_small_contradiction_is_accepted_and_named():
    found = weights_from_answers(NAMES[:2], [answer("a", "b", 1, 2), answer("a", "b", 2.2)])
    assert found.consistency.is_acceptable is True
    assert found.consistency.bound_factor == pytest.approx(1.1)
    assert "limit ×1.84" in next(consistency_sentences(found.consistency))


def test_bounds_that_agree_are_no_contradiction():
    found = weights_from_answers(NAMES[:2], [answer("a", "b", 1, 2), answer("a", "b", 1.5)])
    assert found.consistency.is_acceptable is None
    assert verdict_phrase(found) == "no ratio checks another; the orders and ranges agree with them"


@pytest.mark.parametrize("seed", range(12))
def test_the_factor_is_that_of_a_general_solver(seed):
    generator = random.Random(seed)  # noqa: S311
    truth = [generator.uniform(-1, 1) for _ in NAMES]
    ratios, bounds = [], []
    for i in range(3):
        for j in range(i + 1, 4):
            about = math.exp(truth[i] - truth[j])
            if generator.random() < 0.6:
                ratios.append(answer(NAMES[i], NAMES[j], about * math.exp(generator.gauss(0, 0.8))))
            else:
                bounds.append(answer(NAMES[i], NAMES[j], about / 1.2, about * 1.3))
    ratios = ratios or [answer("a", "b", 3.0)]
    named = tuple(name for name in NAMES if any(name in (one.swing_of, one.over) for one in (*ratios, *bounds)))
    found = weights_from_answers(named, [*ratios, *bounds]).consistency
    assert found.bound_factor == pytest.approx(missed([*ratios, *bounds]) / missed(ratios), rel=1e-4)


@pytest.mark.parametrize("value", [1e160, 1e-12, 1e10])
def test_an_extreme_ratio_is_refused(value):
    with pytest.raises(TradeoffError, match="the ratio of 'a' and 'b' must be from 1e-09 to 1e"):
        answer("a", "b", value)
    with pytest.raises(TradeoffError, match="must be from 1e-09"):
        answer("a", "b", 1.0, 1e11) if value > 1 else answer("a", "b", value, math.inf)
