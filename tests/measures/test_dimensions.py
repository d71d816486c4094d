from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rgss.measures.dimensions import Kind, kind_of, si_unit
from rgss.measures.expressions import Expression, ExpressionProblem
from rgss.measures.parsing import parse_expression
from rgss.quantities import conversion_factor, dimension

KINDS = {
    "m": Kind(dimension=dimension("kg")),
    "v": Kind(dimension=dimension("m/s")),
    "g": Kind(dimension=dimension("m/s^2")),
    "f": Kind(dimension=dimension("N")),
    "x": Kind(dimension=dimension("m")),
    "c": Kind(dimension=dimension("USD")),
    "row": Kind(dimension=dimension("m"), length=5),
    "pair": Kind(dimension=dimension("m"), length=2),
    "lost": None,
}


def analysed(text: str) -> tuple[Kind | None, tuple[ExpressionProblem, ...]]:
    expression = parse_expression(text)
    assert isinstance(expression, Expression)
    return kind_of(expression, KINDS)


@pytest.mark.parametrize(
    ("text", "unit", "length"),
    [
        ("m * g + f", "N", None),
        ("x / v", "s", None),
        ("sqrt(x ** 2 + x * x)", "m", None),
        ("(x * g) ** 0.5", "m/s", None),
        ("f / (g * m)", "1", None),
        ("row / v", "s", 5),
        ("sum(row / v)", "s", None),
        ("row * row", "m^2", 5),
        ("norm(row) - x", "m", None),
        ("count(row)", "1", None),
        ("mean(row) + max(row) + min(row) + min(x, x)", "m", None),
        ("abs(-row)", "m", 5),
        ("sqrt(row) * sqrt(row)", "m", 5),
        ("c / m", "USD/kg", None),
        ("2 * 3", "1", None),
        ("first_known(f / g, m, 2 * m)", "kg", None),
        ("x ** 0", "1", None),
    ],
)
def test_the_unit_and_shape_follow_from_the_symbols(text: str, unit: str, length: int | None) -> None:
    kind, problems = analysed(text)
    assert problems == ()
    assert kind == Kind(dimension=dimension(unit), length=length)


@pytest.mark.parametrize(
    ("text", "offset", "rule", "message"),
    [
        ("1 * (m + x)", 5, "measures.unit", "cannot add values in kg and m"),
        ("v - g", 0, "measures.unit", "cannot subtract values in m·s^-1 and m·s^-2"),
        ("x + 1", 0, "measures.unit", "cannot add values in m and 1"),
        ("min(m, x, m)", 0, "measures.unit", "min() of values in different units: kg, m"),
        ("row + pair", 0, "measures.shape", "a row of 5 does not go with a row of 2"),
        ("sum(m)", 0, "measures.shape", "sum() of a single number; it needs a row"),
        ("max(m)", 0, "measures.shape", "max() of a single number; it needs a row"),
        ("first_known(row, x)", 0, "measures.shape", "first_known() takes several numbers, and no row"),
        ("first_known(m, x)", 0, "measures.unit", "first_known() of values in different units: kg, m"),
        ("min(row, x)", 0, "measures.shape", "min() takes one row or several numbers, not a mixture"),
    ],
)
def test_contradictions_are_found_where_they_stand(text: str, offset: int, rule: str, message: str) -> None:
    kind, problems = analysed(text)
    assert kind is None
    assert problems == (ExpressionProblem(rule=rule, offset=offset, message=message),)


@pytest.mark.parametrize("text", ["lost + m", "sqrt(lost)", "sum(lost) * m", "-lost", "lost ** 2", "min(m, lost)"])
def test_what_is_not_known_is_not_judged(text: str) -> None:
    assert analysed(text) == (None, ())


@given(
    st.dictionaries(st.sampled_from(["kg", "m", "s", "USD", "A", "K", "mol", "cd"]), st.integers(-4, 4).filter(bool))
)
def test_the_si_unit_has_the_dimension_it_is_of(exponents: dict[str, int]) -> None:
    unit = "*".join(f"{base}**{power}" for base, power in exponents.items()) or "1"
    assert dimension(si_unit(dimension(unit))) == dimension(unit)


def test_the_si_unit_is_coherent() -> None:
    for unit in ("N", "N*m", "W", "Pa", "V", "USD/kg", "rad"):
        assert conversion_factor(unit, si_unit(dimension(unit))) == 1.0
