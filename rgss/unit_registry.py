"""pint's registry of units as quantities use it, and which of its units are levels."""

from __future__ import annotations

from decimal import Decimal
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from rgss.currencies import CODES, DOLLAR, currency_dimension

if TYPE_CHECKING:
    import pint

_ROUNDING = Decimal("1e-12")


@lru_cache(maxsize=1)
def unit_registry() -> Any:
    """The registry, with currencies and the torques of data sheets."""
    import pint

    # Decimals keep "35 mm" exact: with floats, cm**3 would be 1.0000000000000002e-06 m**3.
    registry: Any = pint.UnitRegistry(
        autoconvert_offset_to_baseunit=False, cache_folder=None, non_int_type=Decimal, on_redefinition="ignore"
    )
    registry.define(f"US_dollar = [{currency_dimension(DOLLAR)}] = {DOLLAR} = dollar")
    for code in CODES:
        if code != DOLLAR:
            registry.define(f"{code} = [{currency_dimension(code)}]")
    # Torques as data sheets write them. To pint, Nm is the number of a yarn, and Ncm and Nmm are unknown.
    for symbol, length in (("Nm", "meter"), ("Ncm", "centimeter"), ("Nmm", "millimeter")):
        registry.define(f"newton_{length} = newton * {length} = {symbol}")
    return registry


def contains_level(unit: pint.Unit) -> bool:
    """True if a unit is a product or a quotient that contains a logarithmic unit, and so is undefined."""
    powers = dict(unit_registry().Quantity(1, unit).unit_items())
    return (len(powers) > 1 or set(powers.values()) != {1}) and any(map(is_level, powers))


@lru_cache(maxsize=512)
def is_level(name: str) -> bool:
    """True if a unit is logarithmic, such as dB: equal steps are no equal differences, or pint cannot convert it."""
    import pint

    registry = unit_registry()
    unit = registry.Unit(name)
    try:
        base = registry.get_base_units(unit)[1]
        zero, one, two = (Decimal(registry.convert(Decimal(magnitude), unit, base)) for magnitude in (0, 1, 2))
    except (pint.errors.PintError, TypeError):  # TypeError: a logarithm of a Decimal
        return True
    return abs(zero + two - 2 * one) > _ROUNDING * abs(two - zero)
