"""Design parameters, with parsing and formatting of their values."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum

from rgss.currencies import CODES, currency_dimension
from rgss.errors import QuantityError
from rgss.findings import shown
from rgss.quantities import conversion_factor, dimension, parse_quantity

ParameterValue = float | int | str
"""Magnitude in SI, count, or name."""

_BASE_UNITS: Mapping[str, str] = {
    "current": "A",
    "length": "m",
    "luminosity": "cd",
    "mass": "kg",
    "substance": "mol",
    "temperature": "K",
    "time": "s",
    **{currency_dimension(code): code for code in CODES},
}
_USUAL_UNITS = ("1", "rad", "rad/s", "rad/s**2", "Hz", "N", "N*m", "N/m", "Pa", "W", "V", "m/s", "m/s**2")


class ParameterKind(str, Enum):
    """Kind of the values of a design parameter."""

    QUANTITY = "quantity"
    COUNT = "count"
    NAME = "name"


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignParameter:
    """Quantity chosen by the designer.

    Attributes:
        id: Its id, such as ``m_f``.
        name: Its name in columns, such as ``finger_mass``.
        symbol: Its symbol in equations.
        kind: Kind of its values.
        unit: The SI unit of its values; ``"1"`` for counts and ratios, empty for names.
        role: Role of the components that it names; empty for other kinds.
        sets: Quantity of `SETTABLE_QUANTITIES` that it sets, or ``catalogue.<role>``; may be empty.
        description: Description, in a sentence.
        assumption: Assumption about it, with the reason; may be empty.
    """

    id: str
    name: str
    symbol: str
    kind: ParameterKind
    unit: str
    role: str = ""
    sets: str = ""
    description: str = ""
    assumption: str = ""

    @property
    def column(self) -> str:
        """Name of its column in tables: id, name and unit, such as ``m_f_finger_mass_kg``."""
        unit = "" if self.unit == "1" else re.sub(r"[^a-z0-9]+", "_", self.unit.lower()).strip("_")
        return "_".join(part for part in dict.fromkeys((self.id, self.name, unit)) if part)

    def read(self, written: ParameterValue) -> ParameterValue:
        """Parse a value of a file.

        Args:
            written: A quantity with its unit, an integer, or a name.

        Returns:
            The value in SI.

        Raises:
            QuantityError: The text is not a value of this parameter.
        """
        if self.kind is ParameterKind.NAME:
            if not isinstance(written, str):
                raise QuantityError(
                    f"{written!r} is not a name", hint=f"write the name of a {self.role or 'component'}"
                )
            return written
        if self.kind is ParameterKind.COUNT:
            if not isinstance(written, int) or written < 0:
                raise QuantityError(
                    f"a whole number from 0 is expected, got {shown(written)}", hint="write a count, such as 2"
                )
            return written
        return read_magnitude(written, self.unit)


def read_magnitude(written: ParameterValue, unit: str) -> float:
    """Parse a quantity in a unit.

    Raises:
        QuantityError: The text is not a quantity of that dimension.
    """
    # "-0" is the same design as "0".
    return parse_quantity(written if isinstance(written, str) else repr(written), unit) + 0.0


def is_si(unit: str) -> bool:
    """True if a unit is coherent with SI, such as ``N`` but not ``mm``.

    Raises:
        QuantityError: The unit is unknown, or has no SI equivalent.
    """
    return conversion_factor(unit, _base_units(unit)) == 1.0


def si_unit(unit: str) -> str:
    """Symbol of the SI unit (its currency for money) of the same dimension as a unit.

    Raises:
        QuantityError: The unit is unknown, or has no SI equivalent.
    """
    for usual in _USUAL_UNITS:
        try:
            parse_quantity(f"1 {unit}", usual)
        except QuantityError:
            continue
        return usual
    return _base_units(unit)


def unit_of(powers: Iterable[tuple[str, float]]) -> str:
    """Symbol of the SI unit of base dimensions with their exponents; ``"1"`` for none.

    Args:
        powers: Base dimensions with the names of `rgss.quantities.dimension`.
    """
    base = "*".join(_BASE_UNITS[name] if power == 1 else f"{_BASE_UNITS[name]}**{power:g}" for name, power in powers)
    return si_unit(base or "1")


def _base_units(unit: str) -> str:
    parts = []
    for name, power in dimension(unit):
        if name not in _BASE_UNITS:
            raise QuantityError(f"unit {unit!r} has no SI equivalent", hint="use units such as mm, kg, s, N")
        parts.append(_BASE_UNITS[name] if power == 1 else f"{_BASE_UNITS[name]}**{power:g}")
    return "*".join(parts) or "1"


def format_value(value: ParameterValue, unit: str = "") -> str:
    """Shortest text of a value that is parsed back exactly: ``0.3``, ``10``, ``RRT``."""
    text = repr(value).removesuffix(".0") if isinstance(value, float) else str(value)
    return f"{text} {unit}" if unit not in ("", "1") else text
