"""Quantities: what is read, into which unit, and what is refused with which advice."""

from __future__ import annotations

import math

import pytest

from rgss.errors import QuantityError
from rgss.quantities import conversion_factor, dimension, parse_quantity, same_dimension, written_unit

OTHER_CURRENCY = (
    "EUR is another currency than USD, and none is converted "
    "(give every amount in one currency; a rate is stated in 'rationale' or 'source')"
)
AMOUNT = '(write an amount of money with the code of its currency behind it, such as "5200 EUR")'


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("35 mm", "m", 0.035),
        ("35mm", "m", 0.035),
        ("  -1.5e2   cm ", "m", -1.5),
        ("+.5 kg", "kg", 0.5),
        ("2. s", "s", 2.0),
        ("1 cm**3", "m**3", 1e-6),
        ("1 cm^3", "m**3", 1e-6),
        ("1 cm³", "m^3", 1e-6),
        ("10 s⁻¹", "Hz", 10.0),
        ("1 µm", "m", 1e-6),
        ("1 μm", "m", 1e-6),
        ("9.81 m/s^2", "m/s**2", 9.81),
        ("9.81 m / s ** 2", "m/s**2", 9.81),
        ("9.81 N/kg", "m/s**2", 9.81),
        ("56 N·m", "N*m", 56.0),
        ("56 N m", "N*m", 56.0),
        ("0.1 kg*m**2", "kg*m**2", 0.1),
        ("3 kg*(m/s)^2", "J", 3.0),
        ("3 W/(m*K)", "W/(K*m)", 3.0),
        ("36 km/hour", "m/s", 10.0),
        ("1 inch", "m", 0.0254),
        ("1 lb", "kg", 0.45359237),
        ("1 delta_degC", "K", 1.0),
        ("180 deg", "rad", math.pi),
        ("180°", "rad", math.pi),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("95 %", "1", 0.95),
        ("0.7", "1", 0.7),
        ("50 %", "%", 50.0),
        ("1250 USD", "USD", 1250.0),
        ("1250 $", "USD", 1250.0),
        ("1.25 kUSD", "USD", 1250.0),
        ("3 USD/kg", "$/g", 0.003),
        ("90 1/h", "1/h", 90.0),
        ("90 /h", "1/h", 90.0),
        ("90/h", "1/hour", 90.0),
        ("90 1 / hour", "1/h", 90.0),
        ("901/h", "1/h", 901.0),
        ("1/h", "1/h", 1.0),
        ("2 1/min", "Hz", 1 / 30),
        ("3 /(kg*m)", "1/(m*kg)", 3.0),
        ("0 m", "m", 0.0),
        ("1e-999", "1", None),
    ],
)
def test_reading(text, unit, value):
    if value is None:
        with pytest.raises(QuantityError, match="too small"):
            parse_quantity(text, unit)
    else:
        assert parse_quantity(text, unit) == value


@pytest.mark.parametrize(
    ("text", "torque_nm"),
    [("5 Nm", 5.0), ("5 mNm", 0.005), ("2 kNm", 2000.0), ("30 Ncm", 0.3), ("30 Nmm", 0.03), ("5 N m", 5.0)],
)
def test_torques_are_read_as_data_sheets_write_them(text, torque_nm):
    assert parse_quantity(text, "N*m") == torque_nm


@pytest.mark.parametrize(
    ("text", "unit", "message"),
    [
        ("", "m", "'' is not a quantity (write a number and a unit, such as \"1 m\")"),
        ("", "1", "'' is not a quantity (write a number, such as 0.5)"),
        ("mm", "m", "'mm' is not a quantity (write a number and a unit, such as \"1 m\")"),
        ("1,5 m", "m", "'1,5 m' is not a quantity (write a number and a unit, such as \"1 m\")"),
        ("1 2 m", "m", "'1 2 m' is not a quantity (write a number and a unit, such as \"1 m\")"),
        ("١٢ m", "m", "'١٢ m' is not a quantity (write a number and a unit, such as \"1 m\")"),
        ("1e5000 m", "m", "'e5000 m' is not a unit (write units such as mm, m/s or kg*m**2)"),
        ("nan m", "m", "'nan m' is not a quantity (write a number and a unit, such as \"1 m\")"),
        ("inf", "1", "'inf' is not a quantity (write a number, such as 0.5)"),
        ("90 1 h", "1/h", "'90 1 h' is not a quantity (write a number and a unit, such as \"1 1/h\")"),
        ("1 1/2", "1/h", "'1 1/2' is not a quantity (write a number and a unit, such as \"1 1/h\")"),
        ("/h", "1/h", "'/h' is not a quantity (write a number and a unit, such as \"1 1/h\")"),
        ("90 2/h", "1/h", "'90 2/h' is not a quantity (write a number and a unit, such as \"1 1/h\")"),
        ("90", "1/h", "'90' has no unit (write \"90 1/h\")"),
        ("90 1/h", "1", "'90 1/h' has a unit where a pure number is expected (write 90)"),
        ("\u221210 mm", "m", "'\u221210 mm' begins with another sign than the minus (write \"-10 mm\")"),
        (" \u2013 0.5", "1", "' \u2013 0.5' begins with another sign than the minus (write \"-0.5\")"),
        ("5", "m", "'5' has no unit (write \"5 m\")"),
        ("5 mm", "1", "'5 mm' has a unit where a pure number is expected (write 5)"),
        ("5 rad", "1", "'5 rad' has a unit where a pure number is expected (write 5)"),
        ("5 kg", "m", "unit 'kg' does not measure what 'm' measures (give it in m or a multiple of it)"),
        ("5 %", "m", "unit '%' does not measure what 'm' measures (give it in m or a multiple of it)"),
        ("5 XYZ", "USD", "unknown unit 'XYZ' (use units such as mm, kg, s, N, deg, USD)"),
        ("5 EUR", "USD", OTHER_CURRENCY),
        ("5 kg/EUR", "kg/USD", OTHER_CURRENCY),
        ("5 kUSD", "EUR", OTHER_CURRENCY.replace("EUR is", "USD is").replace("than USD", "than EUR")),
        ("5 JPY", "kg", "unit 'JPY' does not measure what 'kg' measures (give it in kg or a multiple of it)"),
        ("5 €", "USD", f"'5 €' is not a quantity {AMOUNT}"),
        ("£5", "USD", f"'£5' is not a quantity {AMOUNT}"),
        ("EUR 5", "USD", f"'EUR 5' is not a quantity {AMOUNT}"),
        ("5 m/0", "m", "'m/0' is not a unit (write units such as mm, m/s or kg*m**2)"),
        ("3 dB/m", "1/m", "unknown unit 'dB/m' (use units such as mm, kg, s, N, deg, USD)"),
        ("20 degC", "K", "unit 'degC' is not on a scale that starts at zero (use K)"),
        ("3 dBm", "W", "unit 'dBm' is not on a scale that starts at zero (use W)"),
        ("1e999 m", "m", "'1e999 m' is too large (give a number below 1e308)"),
        ("1e308 km", "m", "'1e308 km' is too large (give a number below 1e308)"),
        ("1e-999 m", "m", "'1e-999 m' is too small to be distinguished from zero (write 0 if zero is meant)"),
        ("1" * 61, "1", f"'{'1' * 59}…' is not a quantity (write a number, such as 0.5)"),
    ],
)
def test_refusal(text, unit, message):
    with pytest.raises(QuantityError) as caught:
        parse_quantity(text, unit)

    assert str(caught.value) == message


@pytest.mark.parametrize(
    ("text", "unit"),
    [("5 mm", "mm"), ("5", ""), ("90 1/h", "1/h"), ("90 / h", "1/h"), ("5 %", "%"), ("90 1 h", None), ("mm", None)],
)
def test_the_unit_of_a_quantity(text, unit):
    assert written_unit(text) == unit


@pytest.mark.parametrize(("text", "unit"), [("1 Hz", "rad/s"), ("60 rpm", "Hz"), ("5 %", "rad"), ("1 rad/s", "1/s")])
def test_an_angle_is_not_a_pure_number(text, unit):
    with pytest.raises(QuantityError, match="does not measure"):
        parse_quantity(text, unit)


def test_conversion_factor():
    assert conversion_factor("mm", "m") == 0.001
    assert conversion_factor("kg*m/s**2", "N") == 1.0
    assert conversion_factor("%", "1") == 0.01
    assert conversion_factor("rad*m", "m") == 1.0
    with pytest.raises(QuantityError, match="does not measure"):
        conversion_factor("mm", "s")
    with pytest.raises(QuantityError, match="does not measure"):
        conversion_factor("USD", "1")


def test_dimension():
    assert dimension("N") == (("length", 1.0), ("mass", 1.0), ("time", -2.0))
    assert dimension("1") == dimension("%") == dimension("rad") == ()
    assert dimension("$") == (("currency", 1.0),)
    assert dimension("1/s") == dimension("Hz")
    assert same_dimension("J", "N*m")
    assert not same_dimension("J", "N")


@pytest.mark.parametrize(
    "unit",
    [
        *("", " ", "2", "1000 m", "m 1", "m/1", "m/0", "m*", "*m", "/s", "m//s", "m..s", "m-s", "m+s", "m;s", "m%2"),
        *("m**0", "m**99", "m**9**9", "9**9**9", "m**-", "m**s", "m**(9)", "m**2.5", "²", "m²²"),
        *("(m", "m)", "m)(m", "((m))", "()", "m(s)(", "[m]", "m\n", "m'", "m @ s", "0x1"),
        *("m.__class__", "__import__('os')", "lambda: m"),
    ],
)
def test_what_is_no_unit(unit):
    with pytest.raises(QuantityError):
        dimension(unit)


def test_long_units_are_refused_unread():
    with pytest.raises(QuantityError, match="is not a unit"):
        dimension("m*" * 100 + "m")
