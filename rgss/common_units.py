"""Common units without pint, whose import and definitions take half a second.

A test compares each of them, and products of them, with pint; any other unit is converted by pint.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from decimal import Decimal
from functools import lru_cache
from types import MappingProxyType

from rgss.currencies import CODES, currency_dimension

_LENGTH, _MASS, _TIME, _CURRENT, _ANGLE = "length", "mass", "time", "current", "angle"
_FORCE = {_LENGTH: 1, _MASS: 1, _TIME: -2}
_ENERGY = {_LENGTH: 2, _MASS: 1, _TIME: -2}
_PRESSURE = {_LENGTH: -1, _MASS: 1, _TIME: -2}

_ATOMS: Mapping[str, tuple[str, Mapping[str, int]]] = MappingProxyType(
    {
        "1": ("1", {}),
        "%": ("0.01", {}),
        "percent": ("0.01", {}),
        "km": ("1000", {_LENGTH: 1}),
        "m": ("1", {_LENGTH: 1}),
        "cm": ("0.01", {_LENGTH: 1}),
        "mm": ("0.001", {_LENGTH: 1}),
        "um": ("0.000001", {_LENGTH: 1}),
        "kg": ("1", {_MASS: 1}),
        "g": ("0.001", {_MASS: 1}),
        "h": ("3600", {_TIME: 1}),
        "min": ("60", {_TIME: 1}),
        "s": ("1", {_TIME: 1}),
        "ms": ("0.001", {_TIME: 1}),
        "us": ("0.000001", {_TIME: 1}),
        "Hz": ("1", {_TIME: -1}),
        "kHz": ("1000", {_TIME: -1}),
        "N": ("1", _FORCE),
        "mN": ("0.001", _FORCE),
        "kN": ("1000", _FORCE),
        "J": ("1", _ENERGY),
        "kJ": ("1000", _ENERGY),
        "Nm": ("1", _ENERGY),
        "W": ("1", {**_ENERGY, _TIME: -3}),
        "kW": ("1000", {**_ENERGY, _TIME: -3}),
        "Pa": ("1", _PRESSURE),
        "kPa": ("1000", _PRESSURE),
        "MPa": ("1000000", _PRESSURE),
        "A": ("1", {_CURRENT: 1}),
        "mA": ("0.001", {_CURRENT: 1}),
        "V": ("1", {**_ENERGY, _TIME: -3, _CURRENT: -1}),
        "mV": ("0.001", {**_ENERGY, _TIME: -3, _CURRENT: -1}),
        "rad": ("1", {_ANGLE: 1}),
        "deg": ("0.01745329251994329576923690768", {_ANGLE: 1}),
    }
    | {code: ("1", {currency_dimension(code): 1}) for code in CODES}
)
"""Each unit in the root units metre, kilogram, second, ampere and radian, and currencies."""

_LONGEST_TEXT = 60
_FACTOR = re.compile(r"(?P<between>[*/·]?)(?P<name>1|%|[A-Za-z]+)(?:(?:\*\*|\^)(?P<power>-?[1-9]))?")


@dataclass(frozen=True, slots=True, kw_only=True)
class CommonUnit:
    """Product of common units.

    Attributes:
        factor: Its value in root units.
        roots: Exponents of the root dimensions, including angle; sorted, without zeros.
    """

    factor: Decimal
    roots: tuple[tuple[str, int], ...]

    @property
    def dimension(self) -> tuple[tuple[str, float], ...]:
        """Exponents of the base dimensions, without angle."""
        return tuple((name, float(power)) for name, power in self.roots if name != _ANGLE)


@lru_cache(maxsize=512)
def common_unit(text: str) -> CommonUnit | None:
    """Unit from its text, if it is a plain product or quotient of common units.

    Args:
        text: The text, such as ``"mm"``, ``"m/s**2"``, ``"N·m"`` or ``"kg·m·s^-2"``.

    Returns:
        None for any other text, which may still be a unit.
    """
    factor, roots, at = Decimal(1), Counter[str](), 0
    if not 0 < len(text) <= _LONGEST_TEXT:
        return None
    while at < len(text):
        match = _FACTOR.match(text, at)
        # Each except the first follows an operator; adjacent names are left to pint.
        if match is None or bool(match["between"]) != bool(at) or match["name"] not in _ATOMS:
            return None
        if match["name"] == "1" and at:
            return None
        size, powers = _ATOMS[match["name"]]
        power = int(match["power"] or 1) * (-1 if match["between"] == "/" else 1)
        factor *= Decimal(size) ** power
        for name, exponent in powers.items():
            roots[name] += exponent * power
        at = match.end()
    return CommonUnit(factor=factor, roots=tuple(sorted((name, power) for name, power in roots.items() if power)))
