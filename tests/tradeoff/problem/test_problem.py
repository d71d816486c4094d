from __future__ import annotations

import dataclasses
import math

import pytest

from rgss.errors import TradeoffError
from rgss.tradeoff import ChanceBound, Comparison, PiecewiseValue, TailBound, Threshold, TradeProblem


@pytest.mark.parametrize(
    ("comparison", "quantity", "margin", "met"),
    [
        (">=", 1.0, 0.25, True),
        (">=", 0.75, 0.0, True),
        (">=", 0.5, -0.25, False),
        ("<=", 1.0, -0.25, False),
        ("<=", 0.75, 0.0, True),
        ("<=", 0.5, 0.25, True),
        # Rounding does not decide, as it does not in verdicts.
        ("<=", math.nextafter(0.75, 1.0), -math.ulp(0.75), True),
        ("<=", 0.75 * (1 + 3e-9), 0.75 - 0.75 * (1 + 3e-9), False),
    ],
)
def test_threshold(comparison, quantity, margin, met):
    threshold = Threshold(requirement="SYS-012", measure="P", comparison=Comparison(comparison), value=0.75, unit="kg")
    assert threshold.margin(quantity) == margin
    assert threshold.is_met_by(quantity) is met
    assert not threshold.is_met_by(None)
    assert threshold.name == f"SYS-012: P {comparison} 0.75 kg"


@pytest.mark.parametrize("comparison", [Comparison.ABOVE, Comparison.BELOW])
@pytest.mark.parametrize(
    ("condition", "more"), [(Threshold, {}), (ChanceBound, {"probability": 0.5}), (TailBound, {"share": 0.5})]
)
def test_a_condition_of_a_program_is_not_strict(comparison, condition, more):
    message = f"R: a program cannot have the strict comparison '{comparison.value}'"
    with pytest.raises(TradeoffError, match=message) as error:
        condition(requirement="R", measure="P", comparison=comparison, value=1.0, unit="kg", **more)
    assert error.value.hint == "write >= or <="


def test_requirements_in_the_order_of_the_thresholds_then_of_the_weights(build_problem):
    problem = build_problem(
        {1: {"a": 0.0, "b": 0.0, "c": 0.0, "d": None}},
        thresholds=[("R-2", "b", ">=", 0.0), ("R-1", "b", "<=", 1.0), ("R-2", "a", ">=", 0.0)],
        values={"d": (0.0, 1.0), "c": (0.0, 1.0), "a": (0.0, 1.0)},
        weights={"d": 0.0, "c": 0.5, "a": 0.5},
    )
    assert problem.requirements == ("R-2", "R-1", "evidence:c")


@pytest.mark.parametrize(
    ("quantities", "feasible"),
    [
        ({"a": 0.5, "b": 0.5, "c": None}, True),
        ({"a": 0.4, "b": 0.5, "c": 0.5}, False),
        ({"a": None, "b": 0.5, "c": 0.5}, False),
        ({"a": 0.5, "b": None, "c": 0.5}, False),
    ],
)
def test_unknown_measures_make_infeasible_where_they_matter(build_problem, quantities, feasible):
    problem = build_problem(
        {1: quantities},
        thresholds=[("R", "a", ">=", 0.5)],
        values={"b": (0.0, 1.0), "c": (0.0, 1.0)},
        weights={"b": 1.0, "c": 0.0},
    )
    assert problem.is_feasible(problem.alternatives[0]) is feasible


@pytest.mark.parametrize(
    ("measures", "arguments", "message", "hint"),
    [
        ({}, {}, "there are no alternatives to choose from", "run the study's variants first"),
        ({1: {"a": math.nan}}, {}, "'a' of variant 1 must be finite or None, got nan", "give None where it is unknown"),
        (
            {1: {"a": 1.0, "unused": -math.inf}},
            {},
            "'unused' of variant 1 must be finite or None, got -inf",
            "give None",
        ),
        ({1: {"a": 1.0}, 2: {}}, {}, "variant 2 lacks the measure 'a'", "measure every variant alike"),
        (
            {1: {"a": 1.0, "z": 1.0}, 3: {"a": 1.0}},
            {"thresholds": [("R", "z", ">=", 0.0)]},
            "variant 3 lacks the measure 'z'",
            "measure every variant alike",
        ),
        ({1: {"c": 1.0, "b": 1.0}}, {}, "the weights name the unknown measure 'a'", "the alternatives have b, c"),
        ({1: {}}, {}, "the weights name the unknown measure 'a'", "the alternatives have no measures at all"),
        (
            {1: {"a": 1.0}},
            {"thresholds": [("R-7", "z", ">=", 0.0)]},
            "R-7 names the unknown measure 'z'",
            "the alternatives have a",
        ),
        (
            {1: {"a": 1.0}},
            {"thresholds": [("R-7", "a", ">=", math.nan)]},
            "threshold of R-7 on 'a' must be finite, got nan",
            "give a number",
        ),
        (
            {1: {"a": 1.0}},
            {"thresholds": [("evidence:a", "a", ">=", 0.0)]},
            "the requirement id 'evidence:a' is reserved",
            "ids that begin with 'evidence:'",
        ),
        (
            {1: {"a": 1.0, "b": 1.0}},
            {"values": {"a": (0.0, 1.0), "b": (0.0, 1.0)}},
            "'b' has a value function but no weight",
            "give it a weight (0 is allowed)",
        ),
        (
            {1: {"a": 1.0, "b": 1.0}},
            {"weights": {"a": 0.5, "b": 0.5}},
            "'b' has a weight but no value function",
            "say what is worst and best for it",
        ),
    ],
)
def test_ill_posed(build_problem, measures, arguments, message, hint):
    with pytest.raises(TradeoffError) as error:
        build_problem(measures, **arguments)
    assert error.value.message == message
    assert error.value.hint.startswith(hint)
    assert "\n" not in str(error.value)


def test_variant_given_twice(build_problem):
    problem = build_problem({1: {"a": 1.0}})
    with pytest.raises(TradeoffError, match="variant 1 is given twice"):
        dataclasses.replace(problem, alternatives=problem.alternatives * 2)


def test_two_value_functions_for_a_measure(build_problem):
    problem = build_problem({1: {"a": 1.0}})
    with pytest.raises(TradeoffError, match="'a' has two value functions"):
        TradeProblem(
            alternatives=problem.alternatives,
            thresholds=(),
            value_functions=(*problem.value_functions, PiecewiseValue(measure="a", worst=1.0, best=0.0)),
            weighting=problem.weighting,
        )
