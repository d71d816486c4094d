from __future__ import annotations

import math
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.measures.expressions import Expression
from rgss.measures.functions import Value
from rgss.measures.parsing import parse_expression

NUMBERS = st.floats(min_value=-1e6, max_value=1e6, allow_nan=False)
ROWS = st.lists(NUMBERS, min_size=1, max_size=6).map(tuple)


def parsed(text: str) -> Expression:
    expression = parse_expression(text)
    assert isinstance(expression, Expression), expression
    return expression


def value(text: str, **values: Value) -> Value:
    return parsed(text).evaluate(values)


def scalar_texts() -> st.SearchStrategy[str]:
    leaves = st.sampled_from(["a", "b", "c", "2", "0.5", "1e-3", "17"])

    def grow(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
        return st.one_of(
            st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda parts: f"({parts[0]} {parts[1]} {parts[2]})"),
            st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda parts: f"{parts[0]}{parts[1]}{parts[2]}"),
            inner.map(lambda text: f"-{text}"),
            inner.map(lambda text: f"abs({text})"),
            st.tuples(inner, inner).map(lambda parts: f"min({parts[0]}, {parts[1]})"),
            st.tuples(inner, inner, inner).map(lambda parts: f"max({', '.join(parts)})"),
            st.tuples(inner, st.sampled_from(["2", "3", "-1", "0.5"])).map(lambda parts: f"({parts[0]}) ** {parts[1]}"),
            inner.map(lambda text: f"sqrt({text})"),
        )

    return st.recursive(leaves, grow, max_leaves=12)


@given(text=scalar_texts(), a=NUMBERS, b=NUMBERS, c=NUMBERS)
def test_numbers_compute_as_python_does(text: str, a: float, b: float, c: float) -> None:
    names = {"a": a, "b": b, "c": c, "abs": abs, "min": min, "max": max, "sqrt": math.sqrt}
    try:
        expected = eval(text, {"__builtins__": {}}, names)  # noqa: S307 - the oracle; the text is made here
    except (ZeroDivisionError, ValueError, OverflowError):
        expected = None
    # Where Python answers with a complex root or an infinity, the value is unknown here.
    if isinstance(expected, complex) or (expected is not None and not math.isfinite(expected)):
        expected = None
    expression = parse_expression(text)
    if not isinstance(expression, Expression):
        assert len(text) > 500
        return
    result = expression.evaluate({"a": a, "b": b, "c": c})
    if expected is None:
        assert result is None
    else:
        # An unknown part makes the whole unknown, even where Python recovers from an infinity.
        assert result is None or result == pytest.approx(expected, rel=1e-12, abs=0.0)


@given(row=ROWS, other=NUMBERS)
def test_rows_compute_entry_by_entry(row: tuple[float, ...], other: float) -> None:
    assert value("x * k", x=row, k=other) == tuple(entry * other for entry in row)
    assert value("k - x", x=row, k=other) == tuple(other - entry for entry in row)
    assert value("x + x", x=row) == tuple(2 * entry for entry in row)
    assert value("-x", x=row) == tuple(-entry for entry in row)
    assert value("x ** 2", x=row) == tuple(math.pow(entry, 2) for entry in row)
    assert value("abs(x)", x=row) == tuple(abs(entry) for entry in row)


@given(row=ROWS)
def test_rows_reduce_to_numbers(row: tuple[float, ...]) -> None:
    assert value("sum(x)", x=row) == math.fsum(row)
    assert value("mean(x)", x=row) == math.fsum(row) / len(row)
    assert value("min(x)", x=row) == min(row)
    assert value("max(x)", x=row) == max(row)
    assert value("norm(x)", x=row) == math.hypot(*row)
    assert value("count(x)", x=row) == len(row)


@pytest.mark.parametrize("text", ["sum(x)", "mean(x)", "min(x)", "max(x)", "norm(x)", "sum(x / k)"])
def test_an_unknown_entry_makes_a_reduction_unknown(text: str) -> None:
    assert value(text, x=(1.0, None, 3.0), k=2.0) is None
    assert value(text, x=None, k=2.0) is None


def test_count_counts_the_known_entries() -> None:
    assert value("count(x)", x=(1.0, None, 3.0)) == 2.0
    assert value("count(x)", x=None) is None


@pytest.mark.parametrize(
    "text", ["x + 1", "1 - x", "-x", "x ** 2", "sqrt(x)", "abs(x)", "min(x, 1)", "max(1, 2, x)", "x / r", "r * x"]
)
def test_an_unknown_number_makes_the_result_unknown(text: str) -> None:
    assert value(text, x=None, r=(1.0, 2.0)) is None


def test_unknown_entries_stay_where_they_are() -> None:
    assert value("-x + k * y", x=(1.0, None, 3.0), y=(None, 1.0, 1.0), k=2.0) == (None, None, -1.0)


@pytest.mark.parametrize("text", ["1 / x", "sqrt(x - 1)", "(x - 1) ** 0.5", "x ** -1", "1e308 * 10", "1e300 ** 6"])
def test_undefined_arithmetic_is_unknown(text: str) -> None:
    assert value(text, x=0.0) is None


def test_precedence_is_that_of_python() -> None:
    assert value("-x ** 2 + 6 / 3 * 2", x=3.0) == -5.0


def test_an_expression_survives_pickling() -> None:
    expression = parsed("sum(x) / k")
    assert pickle.loads(pickle.dumps(expression)).evaluate({"x": (1.0, 2.0), "k": 2.0}) == 1.5  # noqa: S301 - ours
