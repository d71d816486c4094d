"""Recovery of the valid rows of a damaged store into a new one."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence.store.connection import PROBLEMS, Database, Row, connect, problem_of, translated_errors
from rgss.evidence.store.creation import create_store
from rgss.evidence.store.ledger import write_ledger
from rgss.evidence.store.schema import prepare
from rgss.evidence.store.tables import Table


def copy_rows(rows: Iterable[tuple[Table[Any], Row]], to: Path) -> int:
    """Insert rows into a new store, without duplicate keys.

    Returns:
        The number of copied rows.

    Raises:
        EvidenceError: The new file cannot be written.
    """
    create_store(to, label=str(to))
    with translated_errors(str(to)):
        new = Database(connect(to), str(to))
        try:
            prepare(new.connection, new.name)
            with new.transaction():
                copied = sum(new.change(table.put, row) for table, row in rows)
                write_ledger(new.connection)
                return copied
        finally:
            new.close()


def readable_rows(connection: sqlite3.Connection, table: Table[Any]) -> Iterator[tuple[int, Row]]:
    """Valid rows of a table, each with its row number."""
    for number in row_numbers(connection, table)[0]:
        try:
            row = numbered_row(connection, table, number)
            table.read(row)
        except (*PROBLEMS, EvidenceError):
            continue
        yield number, row


def row_numbers(connection: sqlite3.Connection, table: Table[Any]) -> tuple[list[int], list[str]]:
    """Row numbers of a table, and the error of reading them, if any.

    They are stored both in the table and in the index of its keys, so that if pages of one are damaged the other still
    lists the rows on the valid pages.
    """
    statement = table.present.replace("SELECT 1", "SELECT rowid", 1)
    found: set[int] = set()
    problems = []
    for order in ("rowid", table.key):
        try:
            for (number,) in connection.execute(f"{statement} ORDER BY {order}"):
                found.add(number)
        except PROBLEMS as error:  # noqa: PERF203 - what came before it counts
            problems.append(problem_of(error))
    return sorted(found), problems


def numbered_row(connection: sqlite3.Connection, table: Table[Any], number: int) -> Row:
    """Row by number.

    Raises:
        EvidenceError: The row cannot be found.
        sqlite3.Error: It cannot be read.
    """
    row: Row | None = connection.execute(f"{table.select} WHERE rowid = ?", (number,)).fetchone()
    if row is None:
        raise EvidenceError("it cannot be found")
    return row
