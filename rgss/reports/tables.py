"""Tables of plain cells, independent of the output format."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from rgss.errors import DefinitionError

Cell = str | int | float | None
"""A text, a number, or nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Table:
    """A table.

    Attributes:
        name: Its name in file names and options, such as ``verification``.
        title: Its title.
        heads: The head of each column.
        rows: The cells of each row, as many as there are heads.
        note: A note on it; may be empty.
        marks_from: Index of the first of the columns that contain only marks; None without any.
    """

    name: str
    title: str
    heads: tuple[str, ...]
    rows: Sequence[tuple[Cell, ...]]
    note: str = ""
    marks_from: int | None = None


def cell_text(cell: Cell) -> str:
    """Text of a cell with every digit of a number; empty for None."""
    return "" if cell is None else cell if isinstance(cell, str) else repr(cell)


def chosen_table(tables: tuple[Table, ...], name: str) -> tuple[Table, ...]:
    """The table with a name alone; all of them for an empty name.

    Raises:
        DefinitionError: There is no such table.
    """
    chosen = tuple(one for one in tables if name in ("", one.name))
    if not chosen:
        known = ", ".join(one.name for one in tables)
        raise DefinitionError(f"unknown table {name!r}", hint=f"tables: {known}")
    return chosen
