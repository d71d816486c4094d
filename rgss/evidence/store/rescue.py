"""Rescue of a store whose file was removed, replaced or damaged while it was open."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence.store.connection import PROBLEMS, Row
from rgss.evidence.store.salvaging import copy_rows, readable_rows
from rgss.evidence.store.tables import TABLES, Table

_MOST_FILES = 100


@dataclass(frozen=True, slots=True, kw_only=True)
class Rescue:
    """Summary of a rescue.

    Attributes:
        text: Amount and place of the saved rows.
        hint: Advice.
        rows: Number of rows.
    """

    text: str
    hint: str
    rows: int = 0


def rescued(connection: sqlite3.Connection, path: Path, pending: Sequence[tuple[Table[Any], Row]]) -> Rescue:
    """Save the readable rows of an open store in a new file beside it.

    A removed or replaced file is still complete for a process that has it open. Of a truncated file the rows are saved
    that are still in its log or in memory.

    Args:
        connection: The open store.
        path: Its path.
        pending: Rows that were to be inserted.
    """
    try:
        # The folder may have been removed with the file; its parent does not belong to the store.
        path.parent.mkdir(exist_ok=True)
        target = _free_name(path)
        rows = copy_rows(_all(connection, pending), target)
    except (OSError, EvidenceError, *PROBLEMS) as error:
        problem = error.message if isinstance(error, EvidenceError) else str(error)
        return Rescue(text=f"nothing of it could be saved: {problem}", hint="run the sweep again")
    if not rows:
        with suppress(OSError):
            target.unlink()
        return Rescue(text="nothing of it could be read any more", hint="run the sweep again")
    return Rescue(
        text=f"{rows} readable rows are saved in {target.name} beside it",
        hint=f"remove the rest of {path.name}, rename {target.name} to {path.name} and run the sweep again",
        rows=rows,
    )


def _all(connection: sqlite3.Connection, pending: Sequence[tuple[Table[Any], Row]]) -> Iterable[tuple[Table[Any], Row]]:
    for table in TABLES:
        for _, row in readable_rows(connection, table):
            yield table, row
    yield from pending


def _free_name(path: Path) -> Path:
    names = (f"{path.name}.rescued{f'-{number}' if number > 1 else ''}" for number in range(1, _MOST_FILES))
    free = next((path.with_name(name) for name in names if not path.with_name(name).exists()), None)
    if free is None:
        raise EvidenceError(f"{_MOST_FILES} rescued files are beside it already")
    return free
