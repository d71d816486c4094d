"""Printing: JSON for programs, tables for people."""

from __future__ import annotations

import itertools
import json
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from rgss.documents import is_standard_output
from rgss.findings import printable

_PIECES_AT_ONCE = 100_000


def print_json(value: Any) -> None:
    """Print one JSON document, as it is written: a hundred megabytes need no second copy in memory."""
    pieces = json.JSONEncoder(indent=2, allow_nan=False, ensure_ascii=False).iterencode(value)
    while text := "".join(itertools.islice(pieces, _PIECES_AT_ONCE)):
        print(text, end="")
    print()


def print_table(titles: Sequence[str], rows: Iterable[Sequence[str]], *, right: Iterable[int] = ()) -> None:
    """Print a table as aligned text.

    Args:
        titles: The head of each column.
        rows: The cells.
        right: Columns that are aligned to the right.
    """
    cells = [[printable(text) for text in row] for row in (titles, *rows)]
    widths = [max(len(row[column]) for row in cells) for column in range(len(titles))]
    to_right = set(right)
    for number, row in enumerate(cells):
        parts = [
            text.rjust(width) if column in to_right else text.ljust(width)
            for column, (text, width) in enumerate(zip(row, widths, strict=True))
        ]
        print("  ".join(parts).rstrip())
        if number == 0:
            print("  ".join("─" * width for width in widths))


def announce(text: str, file: Path) -> None:
    """Print what was written to a file; to standard error if the file is standard output itself."""
    print(printable(text), file=sys.stderr if is_standard_output(file) else sys.stdout)


def number(value: float | None, digits: int = 4) -> str:
    """A number for people; a dash for what is not known."""
    if value is None:
        return "–"
    if abs(value) >= 10.0**digits:
        return f"{value:,.0f}"
    return f"{value:.{digits}g}"


def shown_path(path: Path) -> str:
    """A path relative to the current folder where it lies below it."""
    try:
        return str(path.resolve().relative_to(Path.cwd()))
    except ValueError:
        return str(path)
