"""Quantities with units: the only place where one unit becomes another.

A float that crosses a file carries its unit in the text (``"120 mm"``); inside rgss every
float is in SI (money in US dollars) and says so in its name.
"""

from __future__ import annotations

import re
from decimal import Decimal
from functools import lru_cache
from typing import TYPE_CHECKING

from rgss.errors import QuantityError

if TYPE_CHECKING:
    import pint

_LONGEST_TEXT = 60
_QUANTITY = re.compile(
    r"""\s*(?P<number>[+-]?(?:\d+(?:\.\d*)?|\.\d+)(?:[eE][+-]?\d{1,3})?)
        \s*(?P<unit>[A-Za-zµμ°%$][A-Za-z0-9µμ°%$*/^·.()\ -]*)?\s*""",
    re.VERBOSE,
)
_UNIT_WITH_SMALL_EXPONENTS = re.compile(r"[^*^0-9]*(?:(?:\*\*?|\^)?-?\d?[^*^0-9]+)*(?:\*\*|\^)?-?\d?")


def parse_quantity(text: str, unit: str) -> float:
    """Read a quantity and express it in a unit.

    Args:
        text: A number and a unit, such as ``"120 mm"``.
        unit: The unit wanted, such as ``"m"``; ``"1"`` for a pure number or a percentage.

    Returns:
        The magnitude in that unit. Decimal prefixes convert exactly: ``"35 mm"`` is the
        float nearest to 0.035.

    Raises:
        QuantityError: The text is not a number with a unit, the unit is unknown, or it
            measures something else.
    """
    match = _QUANTITY.fullmatch(text) if len(text) <= _LONGEST_TEXT else None
    if match is None:
        raise QuantityError(
            f"{_shorten(text)!r} is not a quantity", hint=f'write a number and a unit, such as "1 {unit}"'
        )
    number, written = match["number"], (match["unit"] or "").strip()
    if not written:
        if unit == "1":
            return float(number)
        raise QuantityError(f"{text!r} has no unit", hint=f'write "{number} {unit}"')
    if unit == "1" and written != "%":
        raise QuantityError(f"{text!r} has a unit where a pure number is expected", hint=f"write {number}")
    return float(Decimal(number) * Decimal(repr(_factor(written, unit))))


def conversion_factor(from_unit: str, to_unit: str) -> float:
    """The number by which a magnitude in one unit is multiplied to be in another.

    Raises:
        QuantityError: A unit is unknown, or the two measure different things.
    """
    return _factor(from_unit, to_unit)


def same_dimension(unit: str, other: str) -> bool:
    """Tell whether two units measure the same thing.

    Raises:
        QuantityError: A unit is unknown.
    """
    return dimension(unit) == dimension(other)


@lru_cache(maxsize=512)
def dimension(unit: str) -> tuple[tuple[str, float], ...]:
    """The base dimensions of a unit with their exponents, sorted; empty for a pure number.

    Raises:
        QuantityError: The unit is unknown.
    """
    powers = _unit(unit).dimensionality
    return tuple(sorted((name.strip("[]"), float(power)) for name, power in powers.items()))


@lru_cache(maxsize=1)
def _registry() -> pint.UnitRegistry:
    import pint

    registry: pint.UnitRegistry = pint.UnitRegistry(autoconvert_offset_to_baseunit=False, cache_folder=None)
    registry.define("US_dollar = [currency] = USD = dollar")
    return registry


@lru_cache(maxsize=512)
def _unit(text: str) -> pint.Unit:
    import pint

    cleaned = text.replace("·", "*").replace("^", "**").replace("$", "USD").replace("%", "percent")
    if len(text) > _LONGEST_TEXT or not _UNIT_WITH_SMALL_EXPONENTS.fullmatch(text):
        raise QuantityError(f"{_shorten(text)!r} is not a unit")
    try:
        if cleaned == "1":
            return _registry().Unit("dimensionless")
        return _registry().Unit(cleaned)
    except (pint.errors.PintError, ValueError, TypeError, SyntaxError, AttributeError, KeyError) as error:
        raise QuantityError(f"unknown unit {text!r}", hint="use units such as mm, kg, s, N, deg, USD") from error


@lru_cache(maxsize=512)
def _factor(from_unit: str, to_unit: str) -> float:
    source, target = _unit(from_unit), _unit(to_unit)
    if source.dimensionality != target.dimensionality:
        raise QuantityError(
            f"unit {from_unit!r} does not measure what {to_unit!r} measures",
            hint=f"give it in {to_unit} or a multiple of it",
        )
    registry = _registry()
    zero = float(registry.Quantity(0.0, source).to(target).magnitude)
    if zero != 0.0:
        raise QuantityError(f"unit {from_unit!r} has an offset zero", hint="use kelvin for temperatures")
    return float(registry.convert(1.0, source, target))


def _shorten(text: str) -> str:
    return text if len(text) <= _LONGEST_TEXT else text[: _LONGEST_TEXT - 1] + "…"
