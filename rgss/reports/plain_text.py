"""Plain text for terminals: aligned tables."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from rgss.findings import printable


def aligned_table(titles: Sequence[str], rows: Iterable[Sequence[str]], *, right: Iterable[int] = ()) -> list[str]:
    """Lines of a table whose columns are aligned.

    Args:
        titles: The head of each column.
        rows: The cells.
        right: Columns that are aligned to the right.
    """
    cells = [[printable(text) for text in row] for row in (titles, *rows)]
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
    return lines
