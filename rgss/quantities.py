"""Quantities with units: parsing and unit conversion.

A float in a file has its unit in the text (``"120 mm"``); inside rgss every float is in SI (money in its
currency), with the unit in its name.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from rgss.common_units import common_unit
from rgss.currencies import CODES, currencies_in, without_currency
from rgss.errors import QuantityError
from rgss.findings import shown
from rgss.unit_registry import contains_level, is_level, unit_registry

if TYPE_CHECKING:
    import pint

_LONGEST_TEXT = 60
_AMOUNT = 'write an amount of money with the code of its currency behind it, such as "5200 EUR"'
_MINUS_LIKE = "\u2212\u2010\u2011\u2012\u2013\u2014\ufe63\uff0d"
"""Signs that look like the minus of numbers, such as a true minus or a dash."""
# A unit may begin with a reciprocal, "90 1/h" or "90 /h"; its 1 is separated from the number.
_QUANTITY = re.compile(
    r"\s*(?P<number>[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?)\s*"
    r"(?P<unit>(?P<per>(?:(?<=\s)1\s*)?/\s*)?[A-Za-zµμ°%$(].*)?"
)

# Units are products and quotients of names with small integer exponents, grouped at most once: matched texts are safe
# input for pint, whose own grammar also accepts numbers and huge powers.
_POWER = r"(?:\s*(?:\*\*|\^)\s*-?[1-9]|⁻?[¹²³⁴⁵⁶⁷⁸⁹])?"
_FACTOR = rf"[A-Za-zµμ°%$_]+{_POWER}"
_BETWEEN = r"(?:\s*[*/·]\s*|\s+)"
_GROUP = rf"\(\s*{_FACTOR}(?:{_BETWEEN}{_FACTOR})*\s*\){_POWER}"
_UNIT = re.compile(rf"1|(?:1\s*/\s*)?(?:{_FACTOR}|{_GROUP})(?:{_BETWEEN}(?:{_FACTOR}|{_GROUP}))*")

# Signs and codes of currencies, in texts that are no quantities.
_MONEY = re.compile(rf"[€£¥₩₹]|(?<![A-Za-z])(?:{'|'.join(CODES)})(?![A-Za-z])")


def parse_quantity(text: str, unit: str) -> float:
    """Parse a quantity and convert it to a unit.

    Angles are distinguished from pure numbers here, so that ``"1 Hz"`` is not 1 rad/s.

    Args:
        text: A number and a unit, such as ``"120 mm"``.
        unit: The target unit, such as ``"m"``; ``"1"`` for a pure number or a percentage.

    Returns:
        The magnitude in that unit. Decimal prefixes convert exactly: ``"35 mm"`` is the
        float nearest to 0.035.

    Raises:
        QuantityError: The text is not a number with a unit, the unit is unknown or of another dimension, or the number
        exceeds the range of floats.
    """
    match = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST_TEXT else None
    if match is None:
        if _MONEY.search(text[:_LONGEST_TEXT]):
            raise QuantityError(f"{shown(text)} is not a quantity", hint=_AMOUNT)
        if (bare := text.lstrip()) and bare[0] in _MINUS_LIKE:
            plain = f"-{bare[1:].lstrip()}"
            raise QuantityError(f"{shown(text)} begins with another sign than the minus", hint=f'write "{plain}"')
        example = "a number, such as 0.5" if unit == "1" else f'a number and a unit, such as "1 {unit}"'
        raise QuantityError(f"{shown(text)} is not a quantity", hint=f"write {example}")
    number, written = match["number"], _written_unit(match)
    if not written and unit != "1":
        raise QuantityError(f"{shown(text)} has no unit", hint=f'write "{number} {unit}"')
    if unit == "1" and written not in ("", "%"):
        raise QuantityError(f"{shown(text)} has a unit where a pure number is expected", hint=f"write {number}")
    written = written or "1"
    if not _measure_the_same(written, unit):
        raise _mismatch(written, unit)
    exact = Fraction(Decimal(number)) * Fraction(_factor(written, unit))
    try:
        value = float(exact)
    except OverflowError:
        raise QuantityError(f"{shown(text)} is too large", hint="give a number below 1e308") from None
    if exact and not value:
        raise QuantityError(
            f"{shown(text)} is too small to be distinguished from zero", hint="write 0 if zero is meant"
        )
    return value


def written_unit(text: str) -> str | None:
    """Unit of a quantity as written, empty for a number alone; None if the text is not a quantity.

    Args:
        text: The text, such as ``"120 mm"`` or ``"90 /h"``, whose unit is ``"1/h"``.
    """
    match = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST_TEXT else None
    return None if match is None else _written_unit(match)


def _written_unit(match: re.Match[str]) -> str:
    unit = (match["unit"] or "").strip()
    return f"1/{unit[len(match['per']) :]}" if match["per"] else unit


def conversion_factor(from_unit: str, to_unit: str) -> float:
    """Factor that converts a magnitude from one unit to another.

    An angle in radians counts as a pure number here, as in equations.

    Raises:
        QuantityError: A unit is unknown, or the dimensions differ.
    """
    return float(_factor(from_unit, to_unit))


def check_scale(value: float, unit: str) -> None:
    """Check that a unit converts to SI by a factor, as thresholds and measures do.

    Args:
        value: The magnitude, for the hint.
        unit: The unit.

    Raises:
        QuantityError: The unit is unknown, has an offset, such as degC, or is logarithmic, such as dB.
    """
    if common_unit(unit) is not None:
        return
    base = _base_unit(unit)
    try:
        _factor(unit, base)
    except QuantityError as error:
        point = _on_scale(value, unit, base)
        if point is None:
            hint = f"write the level as a pure number, {value:.12g}, and give its measure the unit 1"
        else:
            hint = f'write "{point:.12g} {base}", or use delta_{unit} for a difference'
        raise QuantityError(error.message, hint=hint) from error


def possible_magnitudes(value: float, from_unit: str, to_unit: str) -> tuple[float, ...]:
    """Magnitudes that a quantity in a sentence may have in another unit.

    A temperature in degrees Celsius may be a point on the scale or a difference; a level in decibels is written as a
    pure number here.

    Args:
        value: The magnitude.
        from_unit: Its unit.
        to_unit: The other unit, which converts to SI by a factor.

    Returns:
        The magnitudes, the most likely first; none if the units do not convert.

    Raises:
        QuantityError: A unit is unknown.
    """
    try:
        return (value * conversion_factor(from_unit, to_unit),)
    except QuantityError:
        if not same_dimension(from_unit, to_unit):
            return ()
    point, zero = (_on_scale(number, from_unit, to_unit) for number in (value, 0.0))
    if point is None or zero is None:
        return (value,) if to_unit == "1" else ()
    return point, point - zero


def same_dimension(unit: str, other: str) -> bool:
    """True if two units have the same dimension.

    Raises:
        QuantityError: A unit is unknown.
    """
    return dimension(unit) == dimension(other)


@lru_cache(maxsize=512)
def dimension(unit: str) -> tuple[tuple[str, float], ...]:
    """Base dimensions of a unit with their exponents, sorted; empty for a pure number.

    Raises:
        QuantityError: The unit is unknown.
    """
    common = common_unit(unit)
    if common is not None:
        return common.dimension
    powers: Mapping[str, Any] = _unit(unit).dimensionality
    return tuple(sorted((name.strip("[]"), float(power)) for name, power in powers.items()))


@lru_cache(maxsize=512)
def _unit(text: str) -> pint.Unit:
    import pint

    if len(text) > _LONGEST_TEXT or not _UNIT.fullmatch(text):
        raise QuantityError(f"{shown(text)} is not a unit", hint="write units such as mm, m/s or kg*m**2")
    cleaned = text.replace("·", "*").replace("^", "**").replace("$", "USD").replace("%", "percent")
    try:
        unit: pint.Unit = unit_registry().Unit("dimensionless" if text == "1" else cleaned)
        # Of a quotient with a logarithmic unit, such as dB/m, older versions of pint find only here that it is
        # undefined, and newer ones not at all.
        _ = unit.dimensionality
        if contains_level(unit):
            raise ValueError("a product with a level")
    except (pint.errors.PintError, ValueError) as error:
        raise QuantityError(f"unknown unit {shown(text)}", hint="use units such as mm, kg, s, N, deg, USD") from error
    return unit


@lru_cache(maxsize=512)
def _measure_the_same(unit: str, other: str) -> bool:
    """True if two units have the same dimension; an angle differs from a pure number."""
    one, two = common_unit(unit), common_unit(other)
    if one is not None and two is not None:
        return one.roots == two.roots
    return _measure(unit) == _measure(other)


@lru_cache(maxsize=512)
def _measure(unit: str) -> str:
    """Dimension of a unit, including angles, as the product of its root units."""
    return str(unit_registry().get_root_units(_unit(unit))[1])


@lru_cache(maxsize=512)
def _factor(from_unit: str, to_unit: str) -> Decimal:
    common, other = common_unit(from_unit), common_unit(to_unit)
    if common is not None and other is not None:
        if common.dimension != other.dimension:
            raise _mismatch(from_unit, to_unit)
        return common.factor / other.factor
    import pint

    source, target = _unit(from_unit), _unit(to_unit)
    if source.dimensionality != target.dimensionality:
        raise _mismatch(from_unit, to_unit)
    registry = unit_registry()
    try:
        zero, one = (Decimal(registry.convert(Decimal(magnitude), source, target)) for magnitude in (0, 1))
    except (pint.errors.PintError, TypeError):  # TypeError: a logarithm of a Decimal
        zero, one = Decimal(1), Decimal(1)
    if zero:
        raise QuantityError(f"unit {shown(from_unit)} is not on a scale that starts at zero", hint=f"use {to_unit}")
    return one


def _base_unit(unit: str) -> str:
    """Symbol of a unit's base unit, such as K for degC."""
    return f"{unit_registry().get_base_units(_unit(unit))[1]:~}" or "1"


def _on_scale(value: float, from_unit: str, to_unit: str) -> float | None:
    """Magnitude on the scale of another unit, with its zero; None for a level, such as dB."""
    import pint

    source = _unit(from_unit)
    if is_level(str(source)):
        return None
    try:
        return float(unit_registry().convert(Decimal(repr(value)), source, _unit(to_unit)))
    except (pint.errors.PintError, TypeError):
        return None


def _mismatch(written: str, wanted: str) -> QuantityError:
    one, other = dimension(written), dimension(wanted)
    if one != other and without_currency(one) == without_currency(other):
        has, needs = " and ".join(currencies_in(one)), " and ".join(currencies_in(other))
        return QuantityError(
            f"{has} is another currency than {needs}, and none is converted",
            hint="give every amount in one currency; a rate is stated in 'rationale' or 'source'",
        )
    return QuantityError(
        f"unit {shown(written)} does not measure what {shown(wanted)} measures",
        hint=f"give it in {wanted} or a multiple of it",
    )
