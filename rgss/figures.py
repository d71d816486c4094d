"""Numbers in texts: significant digits, separators of thousands and powers of ten, the same wherever they are read."""

from __future__ import annotations

_THOUSANDS = 1e4
"""Least magnitude that is written as a whole number with separators of thousands."""

_POWERS = 1e9
"""Least magnitude that is written with a power of ten."""

_EXACT_DIGITS = 12
"""Digits of a stated number; more are errors of arithmetic, such as those of 1.1 times 43,000."""


def rounded_figure(value: float) -> str:
    """Number with four significant digits; from 10,000 whole, with separators; from 1e9 with a power of ten.

    A page's script writes the same texts (``show`` in ``study/core.js``).

    Args:
        value: A finite number.
    """
    if abs(value) >= _POWERS:
        return _without_padding(f"{value:.4g}")
    rounded = float(f"{value:.4g}")
    # 9,999.96 is 10,000 with four digits.
    return f"{value:,.0f}" if abs(rounded) >= _THOUSANDS else _without_padding(f"{rounded:.4g}")


def exact_figure(value: float) -> str:
    """Stated number, such as a limit: as `rounded_figure` where that loses nothing, otherwise with all its digits.

    Args:
        value: A finite number.
    """
    stated = float(f"{value:.{_EXACT_DIGITS}g}")
    rounded = rounded_figure(stated)
    if float(rounded.replace(",", "")) == stated:
        return rounded
    if _THOUSANDS <= abs(stated) < 10.0**_EXACT_DIGITS:
        return f"{stated:,}".removesuffix(".0")
    return _without_padding(f"{stated:.{_EXACT_DIGITS}g}")


def _without_padding(text: str) -> str:
    """A number without ``+`` and leading zeros in its power of ten: ``2e9`` for ``2e+09``."""
    digits, power, exponent = text.partition("e")
    return f"{digits}e{int(exponent)}" if power else digits
