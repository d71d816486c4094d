"""Numbers in sentences."""

from __future__ import annotations

import pytest

from rgss.errors import QuantityError
from rgss.quantities import dimension
from rgss.trace.sentences import units
from rgss.trace.sentences.quantities import quantities_in


@pytest.mark.parametrize(
    ("sentence", "found"),
    [
        ("at least 0.8 kg.", [("0.8 kg", 0.8, "kg")]),
        ("at most 60000 USD", [("60000 USD", 60000.0, "USD")]),
        ("at most 60,000 USD", [("60,000 USD", 60000.0, "USD")]),
        ("a score of 0.9.", [("0.9", 0.9, "1")]),
        ("within 2 % of it", [("2 %", 2.0, "%")]),
        ("5 moves in 20 s, then 3", [("5", 5.0, "1"), ("20 s", 20.0, "s"), ("3", 3.0, "1")]),
        ("2 m/s^2 or 1.5e-3 N*m", [("2 m/s^2", 2.0, "m/s^2"), ("1.5e-3 N*m", 1.5e-3, "N*m")]),
        ("-5 mm", [("-5 mm", -5.0, "mm")]),
        ("10mm", [("10mm", 10.0, "mm")]),
        ("5 N m, 5 Nm, 5 N · m", [("5 N m", 5.0, "N m"), ("5 Nm", 5.0, "Nm"), ("5 N · m", 5.0, "N · m")]),
        ("0.1 kg m² or 0.1 kg m^2", [("0.1 kg m²", 0.1, "kg m²"), ("0.1 kg m^2", 0.1, "kg m^2")]),
        ("3 m / s, 5 kg m s^-2", [("3 m / s", 3.0, "m / s"), ("5 kg m s^-2", 5.0, "kg m s^-2")]),
        ("12 V / 24 V, 2 s / cycle", [("12 V", 12.0, "V"), ("24 V", 24.0, "V"), ("2 s", 2.0, "s")]),
        ("5 N per cup, 3 N might do", [("5 N", 5.0, "N"), ("3 N", 3.0, "N")]),
        ("0.9 at 3 in 4 as 5 a", [("0.9", 0.9, "1"), ("3", 3.0, "1"), ("4", 4.0, "1"), ("5", 5.0, "1")]),
        ("the UR10 with KG-2 of section 4.6.2, SYS-012", []),
        ("no number", []),
    ],
)
def test_numbers_are_found_with_their_units(sentence, found):
    assert [(quantity.text, quantity.values[0], quantity.unit) for quantity in quantities_in(sentence)] == found


@pytest.mark.parametrize(
    ("sentence", "values", "unit"),
    [
        ("0,5 kg", (0.5,), "kg"),
        ("2,5 kg", (2.5,), "kg"),
        ("0,500 kg", (0.5,), "kg"),
        ("1,500 kg", (1500.0, 1.5), "kg"),
        ("1,500.5 kg", (1500.5,), "kg"),
        ("1,500,000 h", (1.5e6,), "h"),
        ("1.500,5 kg", (1500.5,), "kg"),
        ("1 500 g", (1500.0, 500.0), "g"),
        ("1\u00a0500 g", (1500.0,), "g"),
        ("1\u202f500,5 g", (1500.5,), "g"),
        ("10 000 h", (10000.0,), "h"),
        ("10'000 h", (10000.0,), "h"),
        ("5 × 10^2 g", (500.0,), "g"),
        ("5 x 10^-1 kg", (0.5,), "kg"),
        ("2,5·10⁻³ m", (0.0025,), "m"),
        ("5*10**3 N", (5000.0,), "N"),
        ("10^6 cycles", (1e6,), "1"),
        ("10⁶ cycles", (1e6,), "1"),
        ("10^3 N", (1000.0,), "N"),
        ("2^10 bits", (1024.0,), "1"),
        ("1e3 h", (1000.0,), "h"),
        ("10k cycles", (10000.0,), "1"),
        ("1.5 million cycles", (1.5e6,), "1"),
        ("\u22125 mm", (-5.0,), "mm"),
        ("joints 1,2 and none", (1.2, 1.0, 2.0), "1"),
        ("50 Ω", (50.0,), "ohm"),
        ("50 \u2126", (50.0,), "ohm"),
        ("100 kΩ", (100.0,), "kohm"),
        ("2 m/s²", (2.0,), "m/s²"),
        ("2 m/s2", (2.0,), "m/s^2"),
        ("90 s^-1", (90.0,), "s^-1"),
    ],
)
def test_a_number_is_read_whole(sentence, values, unit):
    (quantity,) = quantities_in(f"The arm shall reach {sentence}.")

    assert (quantity.values, quantity.unit) == (values, unit)
    assert sentence.startswith(quantity.text) or quantity.text in sentence


@pytest.mark.parametrize(
    ("sentence", "units"),
    [
        ("10^n kg", []),
        ("5 × 10^n kg", []),
        ("1.500.000 h", []),
        ("joints 1,2,3", []),
        ("1/2 kg", ["1"]),
        ("0:25 min", ["1"]),
        ("3\u22125 kg", ["1"]),
        ("channels 1, 2 and 3 m", ["1", "1", "m"]),
        ("2 × 3 m", ["1", "m"]),
    ],
)
def test_no_part_of_a_number_is_a_quantity(sentence, units):
    assert [quantity.unit for quantity in quantities_in(sentence)] == units


@pytest.mark.parametrize(
    ("sentence", "values", "unit"),
    [
        ("60,000 USD", (60000.0,), "USD"),
        ("USD 90000", (90000.0,), "USD"),
        ("$43000", (43000.0,), "USD"),
        ("US$ 43,000", (43000.0,), "USD"),
        ("$43k", (43000.0,), "USD"),
        ("43k USD", (43000.0,), "USD"),
        ("90000 EUR", (90000.0,), "EUR"),
        ("EUR 90 000", (90000.0,), "EUR"),
        ("€5", (5.0,), "EUR"),
        ("5 euros", (5.0,), "EUR"),
        ("90 EUR/h", (90.0,), "EUR/h"),
        ("$5/h", (5.0,), "USD/h"),
        ("3 kg", (3.0,), "kg"),
    ],
)
def test_currencies_before_and_behind_a_number(sentence, values, unit):
    (quantity,) = quantities_in(f"The cell shall cost at most {sentence}.")

    assert (quantity.values, quantity.unit) == (values, unit)
    assert quantity.text == sentence


@pytest.mark.parametrize(
    "thing",
    [
        *("cups", "pins", "links", "poles", "hands", "points", "bags", "counts", "bars"),
        *("grades", "units", "cycles", "turns", "mats", "rods", "dots"),
    ],
)
def test_what_is_counted_is_no_unit(thing):
    (quantity,) = quantities_in(f"The robot shall carry 2 {thing}.")

    assert (quantity.text, quantity.unit) == ("2", "1")


@pytest.mark.parametrize(
    "unit",
    [
        *("metres", "millimeters", "inches", "feet", "seconds", "milliseconds", "minutes", "hours", "days"),
        *("years", "grams", "kilograms", "pounds", "newtons", "kilonewtons", "volts", "amperes", "milliamps"),
        *("ohms", "watts", "kilowatts", "hertz", "kilohertz", "degrees", "radians", "percent", "litres"),
        *("bar", "mbar", "kPa", "psi", "rpm", "deg", "rad", "min", "ppm"),
        *("dollars", "lux", "N*m", "rad/s", "N/mm²", "kg/m^3", "°C"),
    ],
)
def test_names_and_symbols_of_units(unit):
    (quantity,) = quantities_in(f"The robot shall hold 2 {unit}.")

    assert quantity.text == f"2 {unit}"


@pytest.mark.parametrize("word", ["", "an", "be", "by", "if", "is", "it", "no", "of", "on", "or", "to"])
def test_a_short_word_that_is_no_unit_is_not_looked_up(monkeypatch, word):
    with pytest.raises(QuantityError):
        dimension(word)
    monkeypatch.setattr(units, "dimension", None)
    units.unit_of.cache_clear()
    assert units.unit_of(word) is None
