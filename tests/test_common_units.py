"""Common units are what pint, which they stand for, says that they are."""

from __future__ import annotations

import itertools
from decimal import Decimal

import pint
import pytest

from rgss.common_units import _ATOMS, common_unit
from rgss.currencies import CODES

PRODUCTS = (
    *("N*m", "N·m", "m/s", "m/s**2", "m/s^2", "rad/s^2", "deg/s"),
    *("kg·m·s^-2", "kg·m^2·s^-2", "1/s", "USD/kg", "kg/m**3"),
)
OTHERS = (
    "",
    "furlong",
    "m s",
    "m//s",
    "*m",
    "m*",
    "(m)",
    "1 m",
    "m**10",
    "m2",
    "m/1",
    "°",
    "degC",
    "M",
    "m" + "*m" * 40,
)


@pytest.fixture(scope="module")
def registry() -> pint.UnitRegistry:
    found = pint.UnitRegistry(autoconvert_offset_to_baseunit=False, cache_folder=None, non_int_type=Decimal)
    found.define("US_dollar = [currency] = USD = dollar")
    for code in set(CODES) - {"USD"}:
        found.define(f"{code} = [currency_{code}]")
    return found


def pint_unit(registry, text):
    # To pint itself, Nm is the number of a yarn.
    cleaned = text.replace("·", "*").replace("^", "**").replace("%", "percent").replace("Nm", "N*m")
    return registry.Unit("dimensionless" if text == "1" else cleaned)


@pytest.mark.parametrize("text", [*_ATOMS, *PRODUCTS])
def test_a_common_unit_has_the_dimension_that_pint_gives_it(registry, text):
    powers = pint_unit(registry, text).dimensionality

    assert common_unit(text).dimension == tuple(sorted((name.strip("[]"), float(p)) for name, p in powers.items()))


def test_units_convert_as_pint_converts_them(registry):
    # Currencies are alike, so that three stand for all.
    units = [unit for unit in _ATOMS if unit not in CODES or unit in ("USD", "EUR", "JPY")]
    for one, other in itertools.product([*units, *PRODUCTS], repeat=2):
        first, second = common_unit(one), common_unit(other)
        source, target = pint_unit(registry, one), pint_unit(registry, other)

        assert (first.dimension == second.dimension) == (source.dimensionality == target.dimensionality), (one, other)
        if first.dimension == second.dimension:
            converted = registry.convert(Decimal(1), source, target)
            assert float(first.factor / second.factor) == float(converted), (one, other)
            # Roots tell angles from pure numbers, as root units do.
            same = registry.get_root_units(source)[1] == registry.get_root_units(target)[1]
            assert (first.roots == second.roots) == same, (one, other)


@pytest.mark.parametrize("text", OTHERS)
def test_any_other_text_is_left_to_pint(text):
    assert common_unit(text) is None
