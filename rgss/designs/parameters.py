"""Design parameters, and the reading and writing of their values."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import Enum

from rgss.errors import QuantityError
from rgss.findings import shown
from rgss.quantities import conversion_factor, dimension, parse_quantity

ParameterValue = float | int | str
"""A magnitude in SI, a count, or a name."""

_BASE_UNITS: Mapping[str, str] = {
    "current": "A",
    "currency": "USD",
    "length": "m",
    "luminosity": "cd",
    "mass": "kg",
    "substance": "mol",
    "temperature": "K",
    "time": "s",
}
_USUAL_UNITS = ("1", "rad", "rad/s", "rad/s**2", "Hz", "N", "N*m", "N/m", "Pa", "W", "V", "m/s", "m/s**2")


class ParameterKind(str, Enum):
    """Kind of the values of a design parameter."""

    QUANTITY = "quantity"
    COUNT = "count"
    NAME = "name"


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignParameter:
    """One quantity that a designer chooses.

    Attributes:
        id: Its id, such as ``m_f``.
        name: Its name in columns, such as ``finger_mass``.
        symbol: Its symbol in equations.
        kind: Kind of its values.
        unit: The SI unit of its values; ``"1"`` for counts and ratios, empty for names.
        role: The role of the components that it names; empty unless it has names.
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
        """Its column in tables: id, name and unit, such as ``m_f_finger_mass_kg``."""
        unit = "" if self.unit == "1" else re.sub(r"[^a-z0-9]+", "_", self.unit.lower()).strip("_")
        return "_".join(part for part in dict.fromkeys((self.id, self.name, unit)) if part)

    def read(self, written: ParameterValue) -> ParameterValue:
        """Read a value as it is written in a file.

        Args:
            written: A quantity with its unit, a whole number, or a name.

        Returns:
            The value in SI.

        Raises:
            QuantityError: It is not a value of this parameter.
        """
        if self.kind is ParameterKind.NAME:
            if not isinstance(written, str):
                raise QuantityError(
                    f"{written!r} is not a name", hint=f"write the name of a {self.role or 'component'}"
                )
            return written
        if self.kind is ParameterKind.COUNT:
            if not isinstance(written, int) or written < 0:
                raise QuantityError(f"{shown(written)} is not a whole number from 0", hint="write a count, such as 2")
            return written
        return read_magnitude(written, self.unit)


def read_magnitude(written: ParameterValue, unit: str) -> float:
    """Read a quantity in a unit.

    Raises:
        QuantityError: It is not one.
    """
    # A written "-0" is the same design as "0".
    return parse_quantity(written if isinstance(written, str) else repr(written), unit) + 0.0


def is_si(unit: str) -> bool:
    """True if magnitudes in a unit are magnitudes in SI, as for ``N`` and not for ``mm``.

    Raises:
        QuantityError: The unit is unknown, or measures what has no unit in SI.
    """
    return conversion_factor(unit, _base_units(unit)) == 1.0


def si_unit(unit: str) -> str:
    """The SI unit (US dollars for money) of the same dimension as a unit, as it is written.

    Raises:
        QuantityError: The unit is unknown, or measures what has no unit in SI.
    """
    for usual in _USUAL_UNITS:
        try:
            parse_quantity(f"1 {unit}", usual)
        except QuantityError:
            continue
        return usual
    return _base_units(unit)


def unit_of(powers: Iterable[tuple[str, float]]) -> str:
    """The SI unit of base dimensions with their exponents, as it is written; ``"1"`` for none.

    Args:
        powers: Base dimensions as `rgss.quantities.dimension` names them.
    """
    base = "*".join(_BASE_UNITS[name] if power == 1 else f"{_BASE_UNITS[name]}**{power:g}" for name, power in powers)
    return si_unit(base or "1")


def _base_units(unit: str) -> str:
    parts = []
    for name, power in dimension(unit):
        if name not in _BASE_UNITS:
            raise QuantityError(f"unit {unit!r} measures what has no unit in SI", hint="use units such as mm, kg, s, N")
        parts.append(_BASE_UNITS[name] if power == 1 else f"{_BASE_UNITS[name]}**{power:g}")
    return "*".join(parts) or "1"


def format_value(value: ParameterValue, unit: str = "") -> str:
    """Write a value as briefly as it can be read back: ``0.3``, ``10``, ``RRT``."""
    text = repr(value).removesuffix(".0") if isinstance(value, float) else str(value)
    return f"{text} {unit}" if unit not in ("", "1") else text
