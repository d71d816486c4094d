"""Plain text for terminals: aligned tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from rgss.findings import printable


@dataclass(frozen=True, slots=True, kw_only=True)
class TextTable:
    """Table of texts without terminal control characters.

    Attributes:
        titles: The head of each column.
        rows: The cells.
        right: Columns that are aligned to the right.
        spare: Columns that a narrow terminal may omit, the first one to omit last.
    """

    titles: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    right: frozenset[int]
    spare: tuple[int, ...] = ()


class TableLine(str):
    """Line of an aligned table with a reference to the table, so that a terminal can lay it out itself."""

    __slots__ = ("is_first", "table")

    table: TextTable
    is_first: bool

    @classmethod
    def of(cls, text: str, table: TextTable, *, is_first: bool) -> TableLine:
        """A line of a table.

        Args:
            text: The line.
            table: The table.
            is_first: True for the table's first line.
        """
        line = cls(text)
        line.table, line.is_first = table, is_first
        return line


def aligned_table(
    titles: Sequence[str], rows: Iterable[Sequence[str]], *, right: Iterable[int] = (), spare: Sequence[int] = ()
) -> list[str]:
    """Lines of a table whose columns are aligned, each a `TableLine`.

    Args:
        titles: The head of each column.
        rows: The cells.
        right: Columns that are aligned to the right.
        spare: Columns that a narrow terminal may omit, the first one to omit last.
    """
    cells = [tuple(printable(text) for text in row) for row in (titles, *rows)]
    widths = [max(len(row[column]) for row in cells) for column in range(len(titles))]
    to_right = set(right)
    lines = []
    for row in cells:
        parts = [
            text.rjust(width) if column in to_right else text.ljust(width)
            for column, (text, width) in enumerate(zip(row, widths, strict=True))
        ]
        lines.append("  ".join(parts).rstrip())
    lines.insert(1, "  ".join("─" * width for width in widths))
    table = TextTable(titles=cells[0], rows=tuple(cells[1:]), right=frozenset(to_right), spare=tuple(spare))
    return [TableLine.of(line, table, is_first=place == 0) for place, line in enumerate(lines)]
