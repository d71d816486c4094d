"""Units as sentences write them: superscripts, currencies, and words that are units here and names elsewhere."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import lru_cache
from types import MappingProxyType

from rgss.currencies import CODES
from rgss.errors import QuantityError
from rgss.quantities import dimension

_PROSE = frozenset({"a", "are", "as", "at", "has", "in"})
"""Words that are also the names of units, and far more often are just words."""

_NO_UNITS = frozenset({"", "an", "be", "by", "if", "is", "it", "no", "of", "on", "or", "to"})
"""Short words that follow a number and name no unit: not looked up, since pint takes half a second to start."""

_LENGTHS = frozenset({"foot", "feet", "hectare", "inch", "inches", "meter", "metre", "mile", "yard"})
_MASSES = frozenset({"gram", "gramme", "lb", "mol", "mole", "ounce", "pound", "ton", "tonne"})
_VOLUMES = frozenset({"gallon", "liter", "litre"})
_TIMES = frozenset({"day", "hour", "hr", "min", "minute", "month", "sec", "second", "week", "year", "yr"})
_ANGLES = frozenset({"arcmin", "arcsec", "deg", "degree", "rad", "radian", "rev", "revolution", "steradian"})
_RATES = frozenset({"bps", "fps", "hertz", "kph", "mph", "rpm", "rps"})
_FORCES = frozenset({"atm", "bar", "kgf", "ksi", "lbf", "newton", "pascal", "psi", "torr"})
_ENERGIES = frozenset({"cal", "horsepower", "joule", "watt"})
_HEAT_AND_LIGHT = frozenset({"candela", "celsius", "kelvin", "lumen", "lux", "sievert"})
_ELECTRICITY = frozenset({"amp", "ampere", "coulomb", "farad", "henry", "ohm", "siemens", "tesla", "volt", "weber"})
_DATA = frozenset({"kilobit", "kilobyte", "megabit", "megabyte", "gigabit", "gigabyte", "terabyte", "dpi", "ppi"})
_NUMBERS = frozenset({"decibel", "dollar", "percent", "permille", "ppb", "ppm"})
_SPELT_OUT = frozenset().union(
    *(_LENGTHS, _MASSES, _VOLUMES, _TIMES, _ANGLES, _RATES, _FORCES, _ENERGIES),
    *(_HEAT_AND_LIGHT, _ELECTRICITY, _DATA, _NUMBERS),
)
"""Names of units in small letters; any other word, such as cups, pins or poles, says what is counted."""

_PREFIXES = ("pico", "nano", "micro", "milli", "centi", "deci", "hecto", "kilo", "mega", "giga", "tera", "m", "k")
_NO_PLURAL = frozenset({"bar"})
_WORD = re.compile(r"(?<![^\W\d_])[a-z]{3,}(?![^\W\d_])")
_EXPONENT = re.compile(r"(?<![^\W\d_])(mm|cm|dm|km|m|s|in|ft)([2-4])(?!\w)")
_OF_CHARACTERS = str.maketrans({"\u03a9": "ohm", "\u2126": "ohm", "\u22c5": "·", "\u2219": "·", "\u00b5": "\u03bc"})

CURRENCIES: Mapping[str, str] = MappingProxyType(
    {code: code for code in CODES}
    | {"$": "USD", "US$": "USD", "A$": "AUD", "C$": "CAD", "€": "EUR", "£": "GBP", "¥": "JPY", "₩": "KRW", "₹": "INR"}
    | {"euro": "EUR", "euros": "EUR"}
)
"""Code of each currency by its notations."""

ANY_CURRENCY = "|".join(re.escape(name) for name in sorted(CURRENCIES, key=len, reverse=True))
"""Pattern of the notations of currencies."""

_CURRENCY = re.compile(rf"(?<![^\W\d_])(k?)({ANY_CURRENCY})(?![^\W\d_])")


@lru_cache(maxsize=4096)
def unit_of(text: str) -> str | None:
    """The unit that a text names; None if it names none.

    Args:
        text: The text, such as ``m/s²``, ``Ω`` or ``EUR/h``.

    Returns:
        The unit as quantities are written here, with the codes of currencies.
    """
    unit = _EXPONENT.sub(r"\1^\2", _CURRENCY.sub(_with_code, text.translate(_OF_CHARACTERS)))
    if unit in _PROSE or unit in _NO_UNITS or not all(map(_is_spelt_out, _WORD.findall(unit))):
        return None
    try:
        dimension(unit)
    except QuantityError:
        return None
    return unit


def is_unit(text: str) -> bool:
    """True if a text is the name of a unit, or a product or quotient of such names."""
    return unit_of(text) is not None


def _with_code(match: re.Match[str]) -> str:
    return match[1] + CURRENCIES[match[2]]


def _is_spelt_out(word: str) -> bool:
    singular = word[:-1] if word.endswith("s") and word[:-1] not in _NO_PLURAL else word
    names = {word, singular}
    return any(
        name.removeprefix(prefix) in _SPELT_OUT for name in names for prefix in ("", *_PREFIXES) if name != prefix
    )
