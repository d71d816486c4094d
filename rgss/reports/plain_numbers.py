"""Numbers of a report's JSON document: finite, and rounded to their significant digits."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

Plain = dict[str, Any]
"""Part of a report's document, which `json.dumps` accepts even with ``allow_nan=False``."""

SHOWN_DIGITS = 7
"""Digits of a quantity; a page shows four of them."""

FEWER_DIGITS = 5
"""Digits of the many measures that are neither weighted nor used by stakeholders."""

WORTH_DIGITS = 12
"""Digits of the values of measures, by which a page ranks."""


def plain_number(value: float | None, digits: int = SHOWN_DIGITS) -> float | int | None:
    """Number with so many digits; None if it is unknown or infinite.

    Args:
        value: The number.
        digits: Significant digits that are kept.
    """
    if value is None or not math.isfinite(value):
        return None
    rounded = float(f"{value:.{digits}g}")
    # Integers are written without ".0", which saves space in a table of 10,000 designs.
    return int(rounded) if rounded.is_integer() and abs(rounded) < 1e15 else rounded


def plain_numbers(values: Iterable[float | None], digits: int = SHOWN_DIGITS) -> list[float | int | None]:
    """Numbers with so many digits each."""
    return [plain_number(value, digits) for value in values]


def condensed(values: Sequence[Any]) -> Any:
    """The single value of a constant column; otherwise the column."""
    first = values[0] if len(values) else None
    return first if all(value == first for value in values) else list(values)
