"""Terms that stand for unknown ones: the function ``first_known`` in values, findings and substitutions."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from rgss.measures import (
    MeasureSet,
    Substitution,
    evaluate,
    may_substitute,
    replaceable_symbols,
    substitutions_in,
    trial_values,
    undefined_measures,
)
from rgss.measures.expressions import Expression
from rgss.measures.functions import Value
from rgss.measures.parsing import parse_expression

Loader = Callable[..., MeasureSet]
Writer = Callable[..., str]

MEAN = "{statistic: mean, over: all}"
FIXED: dict[str, float | str] = {"design.d2": 3.0, "design.d7": 0.5}


def parsed(text: str) -> Expression:
    expression = parse_expression(text)
    assert isinstance(expression, Expression), expression
    return expression


@pytest.mark.parametrize(
    ("values", "expected"),
    [
        ({"a": 2.0, "b": 0.5, "c": 7.0}, 4.0),
        ({"a": None, "b": 0.5, "c": 7.0}, 7.0),
        ({"a": 2.0, "b": 0.0, "c": 7.0}, 7.0),
        ({"a": None, "b": 0.5, "c": None}, 1.0),
    ],
)
def test_the_first_term_that_has_a_value_is_taken(values: dict[str, Value], expected: float) -> None:
    assert parsed("first_known(a / b, c, 1)").evaluate(values) == expected


def test_nothing_is_known_where_no_term_is() -> None:
    assert parsed("first_known(a, b)").evaluate({"a": None, "b": None}) is None
    assert parsed("1 + first_known(a, b)").evaluate({"a": None, "b": None}) is None


@pytest.fixture
def measures(load_entries: Loader, entry: Writer) -> MeasureSet:
    return load_entries(
        entry("taken", "first_known(share * m, weight / g)", "kg", estimate=MEAN),
        entry("whole", "2 * taken", "kg", estimate=MEAN),
        entry("weight", "m * g", "N"),
        entry("plain", "share * m", "kg", estimate=MEAN),
    )


def test_a_substitution_names_what_is_missing_and_what_is_taken(measures: MeasureSet) -> None:
    design = {"g": 10.0, "m": 3.0, "v": 0.5, "weight": 30.0}

    def found(measure: str, **trial: float) -> tuple[Substitution, ...]:
        return substitutions_in(measures, measure, trial_values(measures, design=design, trial=trial))

    instead = (Substitution(measure="taken", missing=("share",), taken=("weight", "g")),)
    assert found("taken", share=0.5) == found("plain") == ()
    # A measure has those of what it depends on.
    assert found("taken") == found("whole") == instead
    assert [may_substitute(measures, name) for name in ("taken", "whole", "weight", "plain")] == [
        True,
        True,
        False,
        False,
    ]


def test_a_mean_has_the_substitute_of_each_trial_without_a_value(measures: MeasureSet) -> None:
    trials: tuple[dict[str, float], ...] = ({"share": 0.5}, {})

    estimates = evaluate(measures, fixed=FIXED, trials=trials, variant=1)

    assert estimates["taken"].value == pytest.approx((1.5 + 3.0) / 2)
    assert (estimates["plain"].value, estimates["plain"].n) == (1.5, 1)


def test_symbols_before_the_last_term_may_be_unknown() -> None:
    assert replaceable_symbols(parsed("min(a, first_known(b / c, first_known(d, e)))")) == {"b", "c", "d"}
    assert replaceable_symbols(parsed("a + b")) == frozenset()


def test_a_term_that_is_never_defined_is_no_fault_if_another_stands_for_it(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("sound", "first_known(share / (m - m), share / m)", "1/kg", estimate=MEAN),
        entry("unsound", "first_known(share / (m - m), share / (2 * m - 2 * m))", "1/kg", estimate=MEAN),
    )

    assert undefined_measures(measures, fixed=FIXED) == ("unsound",)
