"""Ranges that values of measures cannot leave, against values of random expressions of symbols within theirs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from rgss.measures import MeasureSet, Range, evaluate
from rgss.measures.expressions import Expression
from rgss.measures.parsing import parse_expression
from rgss.measures.possible_values import possible_ranges, range_of, symbol_ranges

Loader = Callable[..., MeasureSet]
Writer = Callable[..., str]
INF = math.inf
RANGES = {
    "a": Range(low=-2.0, high=3.0),
    "b": Range(low=0.0, high=4.0),
    "c": Range(low=1.0),
    "d": Range(high=-1.0),
    "e": Range(),
    "row": Range(low=-1.0, high=2.0, length=3),
    "free": Range(low=0.0, length=4),
}
MEAN = "{statistic: mean, over: all}"


def within(one: Range) -> st.SearchStrategy[float]:
    """Numbers of a range, its ends among them."""
    return st.floats(max(one.low, -1e3), min(one.high, 1e3), allow_nan=False)


SYMBOLS = st.fixed_dictionaries(
    {
        name: within(one) if one.length is None else st.tuples(*[within(one)] * one.length)
        for name, one in RANGES.items()
    }
)
LEAVES = st.sampled_from(["a", "b", "c", "d", "e", "0", "0.5", "3"])
ROWS = st.sampled_from(["row", "free", "a * row", "row - row / 2"])


def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    powers = st.sampled_from(["2", "3", "0.5", "1.5", "-1", "-2", "-0.5", "0"])
    return st.one_of(
        st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda one: f"({one[0]} {one[1]} {one[2]})"),
        st.tuples(inner, powers).map(lambda one: f"({one[0]}) ** {one[1]}"),
        inner.map(lambda one: f"(-{one})"),
        st.tuples(st.sampled_from(["abs", "sqrt"]), inner).map(lambda one: f"{one[0]}({one[1]})"),
        st.tuples(st.sampled_from(["max", "min", "first_known"]), inner, inner).map(
            lambda one: f"{one[0]}({one[1]}, {one[2]})"
        ),
        st.tuples(st.sampled_from(["sum", "mean", "max", "min", "norm", "count"]), ROWS, inner).map(
            lambda one: f"{one[0]}({one[1]} * {one[2]})"
        ),
    )


@settings(max_examples=2_000, deadline=None)
@given(st.recursive(LEAVES, grown, max_leaves=6), SYMBOLS)
def test_no_value_is_outside_the_range_of_its_expression(text: str, values: dict[str, float]) -> None:
    parsed = parse_expression(text)
    assume(isinstance(parsed, Expression))
    value, possible = parsed.evaluate(values), range_of(parsed.root, RANGES)
    assume(isinstance(value, float))
    slack = 1e-9 * max(1.0, abs(value))
    assert possible.low - slack <= value <= possible.high + slack


@pytest.mark.parametrize(
    ("text", "low", "high"),
    [
        ("b + 1", 1.0, 5.0),
        ("a - b", -6.0, 3.0),
        ("a * b", -8.0, 12.0),
        ("b / c", 0.0, 4.0),
        ("c / b", 0.25, INF),
        ("b / a", -INF, INF),
        ("a ** 2", 0.0, 9.0),
        ("(-c) ** 2", 1.0, INF),
        ("a ** 3", -8.0, 27.0),
        ("c ** -2", 0.0, 1.0),
        ("sqrt(a)", 0.0, math.sqrt(3.0)),
        ("abs(a)", 0.0, 3.0),
        ("abs(d)", 1.0, INF),
        ("max(a, b)", 0.0, 4.0),
        ("min(a, c)", -2.0, 3.0),
        ("sum(row)", -3.0, 6.0),
        ("sum(free)", 0.0, INF),
        ("mean(row)", -1.0, 2.0),
        ("max(row)", -1.0, 2.0),
        ("norm(row)", 0.0, math.sqrt(12.0)),
        ("count(row)", 0.0, 3.0),
        ("0 * e", 0.0, 0.0),
        ("1 - b / 4", 0.0, 1.0),
        ("first_known(a, b)", -2.0, 4.0),
    ],
)
def test_ranges_worked_by_hand(text: str, low: float, high: float) -> None:
    found = range_of(parse_expression(text).root, RANGES)
    assert (found.low, found.high) == pytest.approx((low, high))


def test_powers_beyond_the_largest_float_are_unbounded() -> None:
    found = range_of(parse_expression("(f * 1) ** 6").root, {"f": Range.of_number(1e200)})
    assert (found.low, found.high) == (INF, INF)
    assert range_of(parse_expression("f ** 3").root, {"f": Range(low=-1e200, high=0.0)}).low == -INF


def test_ranges_are_in_the_unit_of_the_measure_after_its_summary(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(
        entry("near", "time * v", "mm", estimate=MEAN),
        entry("whole", "row", "m", estimate=MEAN, summary="sum"),
        entry("half", "share * near / 2", "mm", estimate=MEAN),
    )
    bounded = replace(
        measures,
        metric_ranges={
            "task_time_s": Range(low=0.0, high=5.0),
            "path_length_m": Range(low=0.0, high=2.0),
            "share": Range(low=0.0, high=1.0),
        },
    )
    design = {"g": 10.0, "m": 1.0, "v": 3.0}
    found = possible_ranges(bounded, symbol_ranges(bounded, design))
    assert (found["near"].low, found["near"].high) == pytest.approx((0.0, 15_000.0))
    assert (found["whole"].low, found["whole"].high, found["whole"].length) == (0.0, 10.0, None)
    assert (found["half"].low, found["half"].high) == pytest.approx((0.0, 7_500.0))
    assert possible_ranges(measures, symbol_ranges(measures, design))["near"] == Range()


def test_an_interval_stays_within_what_is_possible(load_entries: Loader, entry: Writer) -> None:
    measures = load_entries(entry("x", "share", "1", estimate=MEAN), entry("r", "1 - share", "1", estimate=MEAN))
    trials = [{"share": 1.0, "success": 1.0}] * 10
    fixed = {"design.d2": 1.0, "design.d7": 1.0}

    free = evaluate(measures, fixed=fixed, trials=trials, variant=1)
    assert free["x"].low < 0.0
    assert free["x"].high > 1.0

    bounded = replace(measures, metric_ranges={"share": Range(low=0.0, high=1.0)})
    found = evaluate(bounded, fixed=fixed, trials=trials, variant=1)
    # Ten shares of 1 are no proof of more than ten successes of ten.
    assert (found["x"].low, found["x"].high) == (pytest.approx(0.025**0.1), 1.0)
    assert (found["r"].low, found["r"].high) == (0.0, pytest.approx(1.0 - 0.025**0.1))


def test_a_declared_bound_takes_the_place_of_a_possible_one(load_entries: Loader, entry: Writer) -> None:
    rule = "{statistic: mean, over: all, least: 0.9, most: 2}"
    measures = replace(
        load_entries(entry("x", "share", "1", estimate=rule)), metric_ranges={"share": Range(low=0.0, high=1.0)}
    )
    trials = [{"share": 1.0}] * 4
    found = evaluate(measures, fixed={"design.d2": 1.0, "design.d7": 1.0}, trials=trials, variant=1)["x"]
    share = 1.0 - 0.025**0.25
    assert (found.low, found.high) == pytest.approx((1.0 - 0.1 * share, 1.0 + share))
