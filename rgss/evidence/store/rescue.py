"""Rescue of a store whose file was removed, replaced or damaged while it was open."""

from __future__ import annotations

import shlex
import sqlite3
from collections.abc import Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence.store.connection import PROBLEMS, Row
from rgss.evidence.store.ledger import recorded
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


class Loss(Enum):
    """Way in which an open store was lost; the value is what to do before the saved rows are used."""

    BROKEN = "remove the rest of {name}, rename {saved} to {name} and run the sweep again"
    REPLACED = "{name} is another store now: 'rgss evidence merge {place}' adds the saved rows to it"
    LOCKED = "when the other process has ended, 'rgss evidence merge {place}' adds them to {name}"


def rescued(
    connection: sqlite3.Connection,
    path: Path,
    pending: Sequence[tuple[Table[Any], Row]],
    *,
    label: str,
    loss: Loss = Loss.BROKEN,
) -> Rescue:
    """Save the readable rows of an open store in a new file beside it.

    A removed or replaced file is still complete for a process that has it open. Of a truncated file the rows are saved
    that are still in its log or in memory.

    Args:
        connection: The open store.
        path: Its path.
        pending: Rows that were to be inserted.
        label: Its name in messages, such as its path from the current folder.
        loss: Way in which it was lost.
    """
    try:
        # The folder may have been removed with the file; its parent does not belong to the store.
        path.parent.mkdir(exist_ok=True)
        target = _free_name(path)
        # What replaces a sound file must have everything that the file has.
        least = sum(total.rows for total in recorded(connection).values()) if loss is Loss.LOCKED else 0
        rows = copy_rows(_all(connection, pending), target)
        if rows < least:
            target.unlink()
            raise EvidenceError("not every row of it can be read")
    except (OSError, EvidenceError, *PROBLEMS) as error:
        problem = error.message if isinstance(error, EvidenceError) else str(error)
        return Rescue(text=f"nothing of it could be saved: {problem}", hint="run the sweep again")
    if not rows:
        with suppress(OSError):
            target.unlink()
        return Rescue(text="nothing of it could be read any more", hint="run the sweep again")
    return Rescue(
        text=f"{rows} readable rows are saved in {target.name} beside it",
        hint=loss.value.format(
            name=path.name, saved=target.name, place=shlex.quote(str(Path(label).with_name(target.name)))
        ),
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
