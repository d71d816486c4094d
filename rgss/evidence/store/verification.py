"""Verification of a whole store: pages, every row, ledger, and the references of trials."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence.records import StoredTrial
from rgss.evidence.store.connection import PROBLEMS, Database, connect, is_writable, problem_of, translated_errors
from rgss.evidence.store.ledger import differences, write_ledger
from rgss.evidence.store.permissions import refusal_of
from rgss.evidence.store.place import place_of
from rgss.evidence.store.salvaging import copy_rows, numbered_row, readable_rows, row_numbers
from rgss.evidence.store.schema import prepare, require_own_schema, require_present
from rgss.evidence.store.tables import INPUTS, PIECES, TABLES, TRIALS, Table, brief
from rgss.evidence.store.transactions import snapshot

PAGES = "pages"
"""Kind of damage of the file itself."""

LEDGER = "ledger"
"""Kind of damage if rows are missing or were added, although each is valid."""

_MOST_PAGE_PROBLEMS = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class Damage:
    """One damage of a store.

    Attributes:
        what: Kind of the row, such as ``trial``; ``pages`` of the file; or its ``ledger``.
        key: Key of the row for messages; the table, for the ledger; empty for pages.
        problem: The problem, in one line.
        row: The number of the row in its table; None for pages and the ledger.
    """

    what: str
    key: str
    problem: str
    row: int | None

    def __str__(self) -> str:
        return f"{self.what} {self.key}: {self.problem}" if self.key else f"{self.what}: {self.problem}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Verification:
    """Result of the verification of a store.

    Attributes:
        damages: Damages: pages first, then row by row.
        sound: The number of valid rows of each kind.
        orphaned_pieces: Number of pieces that no trial references, such as those of an interrupted sweep.
        orphaned_inputs: Number of named inputs that no trial references.
    """

    damages: tuple[Damage, ...]
    sound: Mapping[str, int]
    orphaned_pieces: int
    orphaned_inputs: int

    @property
    def pages_are_damaged(self) -> bool:
        """True if the file itself is damaged, so that rows cannot be removed individually."""
        return any(damage.what == PAGES for damage in self.damages)


def verify(path: Path, *, label: str) -> Verification:
    """Check pages, digests, seals, contents, references and ledger.

    Args:
        path: The file.
        label: Its name in messages.

    Raises:
        EvidenceError: The file does not exist, is not a store, or has a newer schema.
    """
    path = place_of(path, label=label)
    if not path.exists():
        raise EvidenceError(f"there is no evidence in {label}", hint="run the sweep first")
    with translated_errors(label, path=path), _opened(path, label) as (connection, problem):
        if connection is None:
            return Verification(damages=(_pages(problem),), sound={}, orphaned_pieces=0, orphaned_inputs=0)
        # A sweep that stores meanwhile also removes rows, namely failures.
        with snapshot(connection):
            return _Check(Database(connection, label), problem).verification()


@contextmanager
def _opened(path: Path, label: str) -> Iterator[tuple[sqlite3.Connection | None, str]]:
    """Open a store for reading despite damaged pages; None if nothing can be read.

    Also returns the error of opening it normally; empty if there was none.
    """
    if path.stat().st_size == 0:
        yield None, "the file is empty, but an evidence store never is"
        return
    connection, problem = _attempt(path, label, though_damaged=False)
    if connection is None:
        connection, _ = _attempt(path, label, though_damaged=True)
    try:
        yield connection, problem
    finally:
        if connection is not None:
            connection.close()


def _attempt(path: Path, label: str, *, though_damaged: bool) -> tuple[sqlite3.Connection | None, str]:
    with ExitStack() as opened:
        try:
            read_only = not is_writable(path)
            connection = connect(path, though_damaged=though_damaged, read_only=read_only)
            opened.enter_context(closing(connection))
            if though_damaged:
                require_own_schema(connection, label)
            elif read_only:
                require_present(connection, label)
            else:
                prepare(connection, label)
        except PROBLEMS as error:
            if isinstance(error, sqlite3.Error) and "malformed" not in str(error):
                raise
            return None, problem_of(error)
        except EvidenceError as error:
            if not though_damaged:
                raise
            return None, error.message
        opened.pop_all()
        return connection, ""


class _Check:
    """Verification of one store, table by table."""

    def __init__(self, database: Database, problem: str) -> None:
        self._database = database
        self._damages: list[Damage] = [_pages(problem)] if problem else []
        self._sound: dict[str, set[str]] = {}
        self._used_pieces: set[str] = set()
        self._used_inputs: list[tuple[str, str, int]] = []

    def verification(self) -> Verification:
        """Check everything, within a transaction of the caller."""
        self._damages.extend(_page_damages(self._database.connection))
        for table in TABLES:
            self._sound[table.what] = set()
            numbers, problems = row_numbers(self._database.connection, table)
            self._damages += [_pages(f"the rows of {table.what} cannot be listed: {problem}") for problem in problems]
            for number in numbers:
                self._check(table, number)
        self._check_ledger()
        inputs = self._sound[INPUTS.what]
        for name, key, number in self._used_inputs:
            if name not in inputs:
                problem = f"its inputs {brief(name)} are missing"
                self._damages.append(Damage(what=TRIALS.what, key=brief(key), problem=problem, row=number))
        return Verification(
            damages=tuple(self._damages),
            sound={what: len(keys) for what, keys in self._sound.items()},
            orphaned_pieces=len(self._sound[PIECES.what] - self._used_pieces),
            orphaned_inputs=len(inputs - {name for name, _, _ in self._used_inputs}),
        )

    def _check_ledger(self) -> None:
        try:
            for table, problem in differences(self._database.connection):
                self._damages.append(Damage(what=LEDGER, key=table, problem=problem, row=None))
        except PROBLEMS as error:
            # Damaged pages are reported instead of the ledger.
            if not self._damages:
                self._damages.append(_pages(problem_of(error)))

    def _check(self, table: Table[Any], number: int) -> None:
        row = None
        try:
            row = numbered_row(self._database.connection, table, number)
            value = table.read(row)
        except (*PROBLEMS, EvidenceError) as error:
            key = f"row {number}" if row is None else brief(row[0])
            self._damages.append(Damage(what=table.what, key=key, problem=_problem(error), row=number))
            return
        self._sound[table.what].add(row[0])
        if isinstance(value, StoredTrial):
            self._used_pieces.update(value.provenance.inputs.values())
            if value.provenance.inputs_digest:
                self._used_inputs.append((value.provenance.inputs_digest, value.key, number))


def remove_damaged_rows(path: Path, *, label: str) -> int:
    """Remove the damaged rows and rewrite the ledger, so that the next sweep computes their content again.

    They are looked up again in the transaction that removes them: since they were found, another process may have
    removed them, and a sweep may have stored others under their numbers.

    Args:
        path: The file, whose pages are valid.
        label: Its name in messages.

    Returns:
        The number of removed rows.

    Raises:
        EvidenceError: The file cannot be written, or its pages are damaged.
    """
    tables = {table.what: table for table in TABLES}
    refusal = refusal_of(path)
    with translated_errors(label, path=path):
        database = Database(connect(path), label, refusal)
    try:
        with database.transaction():
            found = _Check(database, "").verification()
            if found.pages_are_damaged:
                raise EvidenceError(f"{label} was damaged meanwhile", hint="run 'rgss evidence verify' again")
            removed = sum(
                database.change(f"{tables[damage.what].delete} WHERE rowid = ?", [damage.row])
                for damage in found.damages
                if damage.row is not None
            )
            write_ledger(database.connection)
            return removed
    finally:
        database.close()


def salvage(path: Path, verification: Verification, to: Path, *, label: str) -> int:
    """Copy the valid rows of a store with damaged pages to a new store.

    Args:
        path: The damaged file.
        verification: Result of `verify`.
        to: The new file, which must not exist.
        label: The damaged file's name in messages.

    Returns:
        The number of copied rows.

    Raises:
        EvidenceError: Nothing can be read, or the new file exists or cannot be written.
    """
    if to.exists():
        raise EvidenceError(f"{to} already exists", hint="move it away first")
    damaged_rows = {(damage.what, damage.row) for damage in verification.damages}
    with translated_errors(label, path=path), _opened(path, label) as (damaged, _):
        if damaged is None:
            hint = "move it and the files beside it that begin with its name, and run the sweep again"
            raise EvidenceError(f"nothing of {label} can be read", hint=hint)
        sound = (
            (table, row)
            for table in TABLES
            for number, row in readable_rows(damaged, table)
            if (table.what, number) not in damaged_rows
        )
        return copy_rows(sound, to)


def _page_damages(connection: sqlite3.Connection) -> Iterator[Damage]:
    try:
        problems = connection.execute(f"PRAGMA integrity_check({_MOST_PAGE_PROBLEMS})").fetchall()
    except PROBLEMS as error:
        problems = [(problem_of(error),)]
    for (problem,) in problems:
        if problem != "ok":
            yield _pages(str(problem))


def _pages(problem: str) -> Damage:
    return Damage(what=PAGES, key="", problem=" ".join(problem.split())[:200], row=None)


def _problem(error: Exception) -> str:
    return error.message if isinstance(error, EvidenceError) else problem_of(error)
