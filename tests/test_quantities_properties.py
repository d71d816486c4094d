"""Quantities against exact arithmetic, and against texts that are made to hurt."""

from __future__ import annotations

import contextlib
import math
import re
from fractions import Fraction

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from rgss.common_units import _ATOMS
from rgss.errors import QuantityError
from rgss.quantities import conversion_factor, dimension, parse_quantity
from rgss.scenes.uncertainty import QUANTITIES
from rgss.trials.metrics import METRICS

# Exact by definition; an oracle that shares nothing with the units library.
PREFIXES = {"G": 9, "M": 6, "k": 3, "d": -1, "c": -2, "m": -3, "µ": -6, "n": -9}
EXACT = {
    ("inch", "m"): Fraction(254, 10_000),
    ("foot", "m"): Fraction(3048, 10_000),
    ("lb", "kg"): Fraction(45_359_237, 100_000_000),
    ("min", "s"): Fraction(60),
    ("hour", "s"): Fraction(3600),
    ("km/hour", "m/s"): Fraction(10, 36),
    ("kgf", "N"): Fraction(980_665, 100_000),
    ("%", "1"): Fraction(1, 100),
    ("bar", "Pa"): Fraction(100_000),
    ("tonne", "kg"): Fraction(1000),
    ("liter", "m**3"): Fraction(1, 1000),
}
NUMBERS = st.decimals(-(10**9), 10**9, allow_nan=False, places=6) | st.decimals(-1, 1, allow_nan=False, places=18)


@given(NUMBERS, st.sampled_from(sorted(PREFIXES)), st.sampled_from(["m", "s", "N", "W", "Hz"]), st.integers(1, 3))
def test_prefixes_convert_exactly(number, prefix, unit, power):
    exact = Fraction(number) * Fraction(10) ** (PREFIXES[prefix] * power)

    assert parse_quantity(f"{number:f} {prefix}{unit}**{power}", f"{unit}**{power}") == float(exact)


@given(NUMBERS, st.sampled_from(sorted(EXACT)))
def test_units_convert_exactly(number, units):
    source, target = units

    assert parse_quantity(f"{number:f} {source}", target) == float(Fraction(number) * EXACT[units])


@given(NUMBERS, st.sampled_from(["km", "kN", "kUSD", "kW"]), st.sampled_from(["ms", "mm", "mm**2"]))
def test_quotients_convert_exactly(number, above, below):
    scale = Fraction(10) ** (3 + 3 * (2 if below.endswith("2") else 1))
    target = f"{above[1:]}/{below[1:]}"

    assert parse_quantity(f"{number:f} {above}/{below}", target) == float(Fraction(number) * scale)


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_is_the_float_that_was_written(value):
    assert parse_quantity(repr(value), "1") == value
    assert parse_quantity(f"{value!r} m", "m") == value


@pytest.mark.parametrize(("one", "other"), EXACT)
def test_factors_are_inverse_to_each_other(one, other):
    assert dimension(one) == dimension(other)
    assert conversion_factor(one, other) * conversion_factor(other, one) == pytest.approx(1.0, rel=1e-15)


HOSTILE = st.text("mskgNradUSD%$°µ²³⁻·*/^()-+.0123456789eE _\n\t\\'\"{}[]@;,", max_size=64) | st.text(max_size=40)


@given(HOSTILE, st.sampled_from(["m", "1", "N*m", "%"]))
def test_any_text_is_a_number_or_a_refusal(text, unit):
    with contextlib.suppress(QuantityError):
        assert math.isfinite(parse_quantity(text, unit))


@given(HOSTILE)
def test_any_unit_is_a_dimension_or_a_refusal(text):
    with contextlib.suppress(QuantityError):
        assert isinstance(dimension(text), tuple)


@pytest.mark.parametrize(
    "piece", ["a", "a ", "a*", "a**1 ", "(a ", "(a)", "(a a", "1/", " ", "a²", "a^-", "a ^ 1 ", "m/"]
)
@pytest.mark.parametrize("ending", ["", "99", "!", ")", "(", "**", "^^"])
def test_no_text_takes_long(piece, ending):
    text = (piece * 60)[: 60 - len(ending)] + ending

    # A search that goes through all ways to divide the text would not end.
    with contextlib.suppress(QuantityError):
        dimension(text)
    with contextlib.suppress(QuantityError):
        parse_quantity(f"1 {text}"[:60], "m")


NAMES = st.sampled_from(["m", "mm", "kg", "s", "h", "hour", "N", "rad", "deg", "USD", "$", "%", "°", "µm", "K"])
FACTORS = st.tuples(NAMES, st.sampled_from(["", "", "**2", "^2", "^-1", "²", "⁻¹"])).map("".join)
PRODUCTS = st.recursive(
    FACTORS, lambda inner: st.tuples(inner, st.sampled_from(["*", "/", "·", " "]), FACTORS).map("".join), max_leaves=4
)
UNITS = st.tuples(st.sampled_from(["", "", "1/", "1 / "]), PRODUCTS).map("".join)
# What pages print: units of metrics, of what designs set, of what is uncertain.
PRINTED = sorted(
    {one.unit for one in METRICS.values()}
    | {one.unit for one in QUANTITIES.values()}
    | {name for name in _ATOMS if name != "1"}
    | {f"1/{name}" for name in _ATOMS if name != "1"}
)


@given(UNITS | st.sampled_from(PRINTED))
def test_every_unit_can_be_written_after_a_number_and_hints_show_what_is_read(unit):
    assume(unit != "1")
    assert parse_quantity(f"1 {unit}", unit) == 1.0
    for wrong in ("", "much", "1,5 m", "7"):
        with pytest.raises(QuantityError) as caught:
            parse_quantity(wrong, unit)
        for example in re.findall(r'"(.*)"', caught.value.hint):
            assert parse_quantity(example, unit) in (1.0, 7.0)


@given(st.sampled_from([one for one in PRINTED if one.startswith("1/")]))
def test_a_reciprocal_unit_needs_no_one(unit):
    assert parse_quantity(f"90 {unit[1:]}", unit) == parse_quantity(f"90{unit[1:]}", unit) == 90.0
