"""Check of a whole store: its pages, every row, its ledger, and the references of trials."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, closing, contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError
from rgss.evidence.records import StoredTrial
from rgss.evidence.store.connection import PROBLEMS, Database, connect, in_our_words, is_writable, problem_of
from rgss.evidence.store.ledger import differences, write_ledger
from rgss.evidence.store.salvaging import copy_rows, numbered_row, readable_rows, row_numbers
from rgss.evidence.store.schema import prepare, require_own_schema, require_present
from rgss.evidence.store.tables import INPUTS, PIECES, TABLES, TRIALS, Table, brief

PAGES = "pages"
"""Kind of damage of the file itself."""

LEDGER = "ledger"
"""Kind of damage where rows are missing or were added, though each is sound."""

_MOST_PAGE_PROBLEMS = 20


@dataclass(frozen=True, slots=True, kw_only=True)
class Damage:
    """One damage of a store.

    Attributes:
        what: What kind of row it is, such as ``trial``; ``pages`` of the file; or its ``ledger``.
        key: What the row is known by, as messages show it; the table, for the ledger; empty for pages.
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
    """Result of the check of a store.

    Attributes:
        damages: Damage: pages first, then row by row.
        sound: The number of sound rows of each kind.
        orphaned_pieces: Pieces that no trial refers to, such as those of a sweep that was interrupted.
        orphaned_inputs: Named inputs that no trial refers to.
    """

    damages: tuple[Damage, ...]
    sound: Mapping[str, int]
    orphaned_pieces: int
    orphaned_inputs: int

    @property
    def pages_are_damaged(self) -> bool:
        """True if the file itself is damaged, so that a row cannot simply be taken out of it."""
        return any(damage.what == PAGES for damage in self.damages)


def verify(path: Path, *, label: str) -> Verification:
    """Check pages, digests, seals, contents, references and ledger.

    Args:
        path: The file.
        label: Its name in messages.

    Raises:
        EvidenceError: It is not there, is not a store, or is one of a newer rgss.
    """
    if not path.exists():
        raise EvidenceError(f"there is no evidence in {label}", hint="run the sweep first")
    with in_our_words(label), _opened(path, label) as (connection, problem):
        if connection is None:
            return Verification(damages=(_pages(problem),), sound={}, orphaned_pieces=0, orphaned_inputs=0)
        return _Check(Database(connection, label), problem).verification()


@contextmanager
def _opened(path: Path, label: str) -> Iterator[tuple[sqlite3.Connection | None, str]]:
    """Open a store for reading, whatever its pages are like; None if nothing of it can be read.

    With it comes what was in the way of opening it as others do; empty if nothing was.
    """
    if path.stat().st_size == 0:
        yield None, "the file is empty, which no evidence store is"
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
    """A check of one store, table by table."""

    def __init__(self, database: Database, problem: str) -> None:
        self._database = database
        self._damages: list[Damage] = [_pages(problem)] if problem else []
        self._sound: dict[str, set[str]] = {}
        self._used_pieces: set[str] = set()
        self._used_inputs: list[tuple[str, str, int]] = []

    def verification(self) -> Verification:
        self._damages.extend(_page_damages(self._database.connection))
        # Trials come first: what they refer to was put before them, even while a sweep goes on.
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
                problem = f"its inputs {brief(name)} are not there"
                self._damages.append(Damage(what=TRIALS.what, key=brief(key), problem=problem, row=number))
        return Verification(
            damages=tuple(self._damages),
            sound={what: len(keys) for what, keys in self._sound.items()},
            orphaned_pieces=len(self._sound[PIECES.what] - self._used_pieces),
            orphaned_inputs=len(inputs - {name for name, _, _ in self._used_inputs}),
        )

    def _check_ledger(self) -> None:
        try:
            with self._database.transaction("DEFERRED"):
                for table, problem in differences(self._database.connection):
                    self._damages.append(Damage(what=LEDGER, key=table, problem=problem, row=None))
        except EvidenceError as error:
            # Where pages are damaged, they are the damage.
            if not self._damages:
                self._damages.append(_pages(error.message))

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


def take_away(path: Path, verification: Verification, *, label: str) -> int:
    """Remove the damaged rows and write the ledger anew, so that the next sweep makes what was in them.

    Args:
        path: The file, whose pages are sound.
        verification: Result of `verify`.
        label: Its name in messages.

    Returns:
        How many rows were removed.

    Raises:
        EvidenceError: The file cannot be written.
    """
    tables = {table.what: table for table in TABLES}
    with in_our_words(label):
        database = Database(connect(path), label)
    try:
        with database.transaction():
            removed = sum(
                database.change(f"{tables[damage.what].delete} WHERE rowid = ?", [damage.row])
                for damage in verification.damages
                if damage.row is not None
            )
            write_ledger(database.connection)
            return removed
    finally:
        database.close()


def salvage(path: Path, verification: Verification, to: Path, *, label: str) -> int:
    """Copy the sound rows of a store whose pages are damaged into a new one.

    Args:
        path: The damaged file.
        verification: Result of `verify`.
        to: The new file, which must not be there.
        label: The damaged file's name in messages.

    Returns:
        How many rows were copied.

    Raises:
        EvidenceError: Nothing of it can be read, or the new file is there already or cannot be written.
    """
    if to.exists():
        raise EvidenceError(f"{to} is there already", hint="move it away first")
    damaged_rows = {(damage.what, damage.row) for damage in verification.damages}
    with in_our_words(label), _opened(path, label) as (damaged, _):
        if damaged is None:
            hint = "move it away with the files beside it that begin with its name, and run the sweep again"
            raise EvidenceError(f"nothing of {label} can be read any more", hint=hint)
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
