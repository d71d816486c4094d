"""Numbers of a report's JSON document: finite, and no longer than they are known."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

Plain = dict[str, Any]
"""A part of a report's document: what `json.dumps` takes as it is, even with ``allow_nan=False``."""

SHOWN_DIGITS = 7
"""Digits of a quantity; a page shows four of them."""

FEWER_DIGITS = 5
"""Digits of measures that neither stakeholders nor weights look at, of which there are many."""

WORTH_DIGITS = 12
"""Digits of what a measure is worth, with which a page ranks."""


def plain_number(value: float | None, digits: int = SHOWN_DIGITS) -> float | int | None:
    """A number with so many digits; None for what is unknown or has no end.

    Args:
        value: The number.
        digits: Significant digits that are kept.
    """
    if value is None or not math.isfinite(value):
        return None
    rounded = float(f"{value:.{digits}g}")
    # Without the ".0", which a table of 10,000 designs is full of.
    return int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded


def plain_numbers(values: Iterable[float | None], digits: int = SHOWN_DIGITS) -> list[float | int | None]:
    """Numbers with so many digits each."""
    return [plain_number(value, digits) for value in values]


def condensed(values: Sequence[Any]) -> Any:
    """A column whose values are all the same as this one value; the column otherwise."""
    first = values[0] if len(values) else None
    return first if all(value == first for value in values) else list(values)
