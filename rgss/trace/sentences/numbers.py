"""Notations of numbers in sentences: decimal points and commas, groups of digits, powers.

A number is read whole or not at all. Where a notation has several meanings, such as ``1,500``, each of them is kept.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

_SUPERSCRIPTS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻\u2212", "0123456789+--")
_TIMES = r"\s?[×x*·⋅∙]\s?"
_EXPONENT = r"[+\-\u2212]?\d{1,3}"
_RAISED = r"[⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]{1,3}"

NUMBER = rf"""
    (?P<sign>[+\-\u2212]?)
    (?:(?P<spaced>\d{{1,3}}(?P<gap>[\ \u00a0\u2009\u202f'’])\d{{3}}(?:(?P=gap)\d{{3}})*(?:[.,]\d+)?)  # 10 000.5
      |(?P<grouped>\d{{1,3}}(?:,\d{{3}})+(?:\.\d+)?)                                                # 10,000.5
      |(?P<pointed>\d{{1,3}}(?:\.\d{{3}})+,\d+)                                                     # 10.000,5
      |(?P<simple>\d+(?:[.,]\d+)?))                                                                 # 0.5, 0,5
    (?![.,'’]?\d)                                                                                   # 4.3.1; 1,2,3
    (?:[eE](?P<exponent>{_EXPONENT})                                                                # 1e3
      |{_TIMES}10(?:(?:\^|\*\*)\(?(?P<power_of_ten>{_EXPONENT})\)?|(?P<raised_ten>{_RAISED}))       # 5 × 10^3
      |(?:\^|\*\*)\(?(?P<power>{_EXPONENT})\)?|(?P<raised>{_RAISED}))?                              # 10^3, 10³
    (?!\d|\^|\*\*|[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]|{_TIMES}10(?:\^|\*\*|[⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻]))                                # 10^n
    (?P<scale>\ thousand\b|\ million\b|\ billion\b|k(?!\w))?
"""
"""Pattern of a number, in verbose notation."""

NOT_WITHIN = r"(?<![\w.^\u2212-])(?<!\d[,'’/:])"
"""Condition before a number: that it is not within a name such as UR10 or KG-2, or within 4.3.1, 1/2 or 0:25."""

_SCALES: Mapping[str | None, float] = MappingProxyType(
    {None: 1.0, "k": 1e3, " thousand": 1e3, " million": 1e6, " billion": 1e9}
)


def readings(groups: Mapping[str, str | None], *, is_money: bool, is_pure: bool) -> tuple[float, ...]:
    """The values that a number may have, the most likely first; empty if it has none.

    Args:
        groups: The groups of a match of `NUMBER`.
        is_money: True for an amount of money, which has no three decimals.
        is_pure: True for a number without a unit, which may be a list such as ``joints 1,2``.
    """
    sign = "-" if (groups["sign"] or "+") != "+" else ""
    decimals = _decimals(groups)[: 1 if is_money else None]
    if is_pure and "," in (groups["simple"] or ""):
        decimals += tuple((groups["simple"] or "").split(","))
    found = dict.fromkeys(_value(sign + text, groups) for text in decimals)
    return tuple(value for value in found if value is not None)


def _decimals(groups: Mapping[str, str | None]) -> tuple[str, ...]:
    """The number with a decimal point and without groups of digits, in each of its meanings."""
    if (spaced := groups["spaced"]) is not None:
        whole = spaced.replace(groups["gap"] or "", "").replace(",", ".")
        last = spaced.rpartition(" ")[2].replace(",", ".")
        # "2 100 mm fingers" may be two of them.
        return (whole,) if groups["gap"] != " " or last.startswith("0") else (whole, last)
    if (grouped := groups["grouped"]) is not None:
        whole = grouped.replace(",", "")
        decimal = grouped.replace(",", ".")
        if grouped.count(",") > 1 or "." in grouped:
            return (whole,)
        return (decimal,) if grouped.startswith("0") else (whole, decimal)
    if (pointed := groups["pointed"]) is not None:
        return (pointed.replace(".", "").replace(",", "."),)
    simple = groups["simple"] or ""
    return (simple.replace(",", "."),)


def _value(decimal: str, groups: Mapping[str, str | None]) -> float | None:
    def of(name: str) -> str | None:
        return text.translate(_SUPERSCRIPTS) if (text := groups[name]) is not None else None

    scale = _SCALES[groups["scale"]]
    exponent = of("exponent") or of("power_of_ten") or of("raised_ten")
    if exponent is not None:
        return float(f"{decimal}e{exponent}") * scale
    power = of("power") or of("raised")
    if power is None:
        return float(decimal) * scale
    if decimal == "10":
        return float(f"1e{power}") * scale
    try:
        return float(float(decimal) ** int(power)) * scale
    except (OverflowError, ZeroDivisionError):
        return None
