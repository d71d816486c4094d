"""Printing: JSON for programs, tables for people."""

from __future__ import annotations

import itertools
import json
import os
import sys
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

from rgss.cli.safe_output import typeset
from rgss.documents import is_standard_output
from rgss.findings import printable

_PIECES_AT_ONCE = 100_000


def print_json(value: Any) -> None:
    """Print one JSON document incrementally, so that a large one needs no second copy in memory."""
    pieces = json.JSONEncoder(indent=2, allow_nan=False, ensure_ascii=False).iterencode(value)
    while text := "".join(itertools.islice(pieces, _PIECES_AT_ONCE)):
        print(text, end="")
    print()


def print_lines(lines: Iterable[str]) -> None:
    """Print lines of text as they are made; on a terminal a table is fitted to its width."""
    from rgss.cli.terminal import TerminalPage
    from rgss.reports import TableLine

    page = sys.stdout if isinstance(sys.stdout, TerminalPage) else None
    encoding = getattr(sys.stdout, "encoding", None) or "utf-8"
    for line in lines:
        if page is None or not isinstance(line, TableLine):
            print(typeset(line, encoding))
        elif line.is_first:
            page.show_table(line.table)


def print_table(
    titles: Sequence[str], rows: Iterable[Sequence[str]], *, right: Iterable[int] = (), spare: Sequence[int] = ()
) -> None:
    """Print a table as aligned text.

    Args:
        titles: The head of each column.
        rows: The cells.
        right: Columns that are aligned to the right.
        spare: Columns that a narrow terminal may omit, the first one to omit last.
    """
    from rgss.reports import aligned_table

    print_lines(aligned_table(titles, rows, right=right, spare=spare))


def announce(text: str, file: Path) -> None:
    """Print what was written to a file; to standard error if the file is standard output itself."""
    print(printable(text), file=sys.stderr if is_standard_output(file) else sys.stdout)


def require_writable(path: Path) -> None:
    """Refuse a file that cannot be written, before its content is made.

    Raises:
        DefinitionError: It cannot be written.
    """
    from rgss.documents import why_not_writable
    from rgss.errors import DefinitionError

    problem = why_not_writable(path)
    if problem:
        raise DefinitionError(f"{str(path)!r} cannot be written: {problem}", hint="name a writable file")


def number(value: float | None, digits: int = 4) -> str:
    """Text of a number; a dash for an unknown one."""
    if value is None:
        return "–"
    if abs(value) >= 10.0**digits:
        return f"{value:,.0f}"
    return f"{value:.{digits}g}"


def shown_path(path: Path) -> str:
    """A path relative to the current folder where it lies below it."""
    try:
        return str(_followed(path).relative_to(Path.cwd()))
    # A folder that was removed is no current folder.
    except (ValueError, FileNotFoundError):
        return str(path)


def _followed(path: Path) -> Path:
    """Path without links; that of a circle of links as it is."""
    return Path(os.path.realpath(path))


def path_in_project(path: Path, folder: Path) -> str:
    """A path relative to a project's folder where it lies below it: the same wherever a command runs."""
    try:
        return _followed(path).relative_to(_followed(folder)).as_posix()
    except ValueError:
        return path.name
