"""Entries of the columns in a report's document; a constant column is a single value."""

from __future__ import annotations

from typing import Any

from rgss.trace.views import value_in_words


def entry_at(column: Any, place: int) -> Any:
    """One entry of a column.

    Args:
        column: A list, or the single value of a constant column.
        place: The index of the entry.
    """
    return column[place] if isinstance(column, list) else column


def entry_text(value: float | str | None, unit: str = "1") -> str:
    """Text of an entry.

    Args:
        value: A number, the name of a level, or None if it is unknown.
        unit: Unit of a number; empty for none.
    """
    return value if isinstance(value, str) else value_in_words(value, unit or "1")
