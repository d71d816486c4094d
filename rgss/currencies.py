"""Currencies by their ISO 4217 codes: each is a unit of its own, since rates change and none is converted."""

from __future__ import annotations

from collections.abc import Iterable

DOLLAR = "USD"

CODES = (
    *("AED", "ARS", "AUD", "BGN", "BRL", "CAD", "CHF", "CLP", "CNY", "COP", "CZK", "DKK", "EGP", "EUR", "GBP", "HKD"),
    *("HUF", "IDR", "ILS", "INR", "ISK", "JPY", "KES", "KRW", "MXN", "MYR", "NGN", "NOK", "NZD", "PEN", "PHP", "PKR"),
    *("PLN", "QAR", "RON", "RSD", "RUB", "SAR", "SEK", "SGD", "THB", "TRY", "TWD", "UAH", DOLLAR, "VND", "ZAR"),
)
"""The codes that are units."""

_MONEY = "currency"
_CODES = frozenset(CODES)


def is_currency(unit: str) -> bool:
    """True if a unit is the code of a currency."""
    return unit in _CODES


def currency_dimension(code: str) -> str:
    """Name of the base dimension of a currency."""
    return _MONEY if code == DOLLAR else f"{_MONEY}_{code}"


def currencies_in(dimension: Iterable[tuple[str, float]]) -> tuple[str, ...]:
    """Codes of the currencies among base dimensions."""
    return tuple(_code(name) for name, _ in dimension if _is_money(name))


def without_currency(dimension: Iterable[tuple[str, float]]) -> tuple[tuple[str, float], ...]:
    """Base dimensions with one dimension of money, whatever its currency."""
    return tuple(sorted((_MONEY if _is_money(name) else name, power) for name, power in dimension))


def _is_money(name: str) -> bool:
    return name == _MONEY or name.startswith(f"{_MONEY}_")


def _code(name: str) -> str:
    return DOLLAR if name == _MONEY else name.removeprefix(f"{_MONEY}_")
