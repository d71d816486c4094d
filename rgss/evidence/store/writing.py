"""Writing to a store: rows with their ledger in one transaction, and verification that they reached the file."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Sequence
from contextlib import closing, contextmanager
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError, StorageError
from rgss.evidence.store.connection import Database, Row, connect, is_of_lock, translated_errors
from rgss.evidence.store.file_identity import FileIdentity
from rgss.evidence.store.ledger import LedgerChanges, require_ledger
from rgss.evidence.store.rescue import Loss, Rescue, rescued
from rgss.evidence.store.schema import require_own_schema, require_sound_pages
from rgss.evidence.store.tables import FAILURES, TABLES, Table

Rows = Sequence[tuple[Table[Any], Row]]


class RowChanges:
    """Row changes within one transaction."""

    def __init__(self, database: Database) -> None:
        """Start without changes.

        Args:
            database: The file, in a transaction.
        """
        self._database = database
        self.ledger = LedgerChanges()
        self.written: dict[tuple[str, str], bytes] = {}

    def put(self, table: Table[Any], row: Row) -> bool:
        """Insert a row unless its key exists; returns True if it was inserted.

        Raises:
            EvidenceError: The file cannot be written.
        """
        if self._database.change(table.put, row) != 1:
            return False
        self.ledger.added(table, row)
        # A failure may be removed by any process that succeeds later.
        if table is not FAILURES:
            self.written[table.name, row[0]] = _fingerprint(row)
        return True

    def remove(self, table: Table[Any], key: str) -> int:
        """Delete a row by key; returns the number of deleted rows.

        Raises:
            EvidenceError: The file cannot be written.
        """
        row = self._database.one(table.by_key, [key])
        if row is None:
            return 0
        self.ledger.removed(table, row)
        return self._database.change(f"{table.delete} WHERE {table.key} = ?", [key])


class EvidenceWriter:
    """Writer of an open store."""

    def __init__(self, database: Database, path: Path) -> None:
        """Record the present state of the files.

        Args:
            database: The open file.
            path: Its path.

        Raises:
            EvidenceError: The file was removed since it was opened.
        """
        self._database = database
        self._written: dict[tuple[str, str], bytes] = {}
        self._lost: StorageError | None = None
        try:
            self._identity = FileIdentity(path)
        except OSError as error:
            raise EvidenceError(f"the evidence store {database.name} cannot be used: {error.strerror}") from error

    @contextmanager
    def transaction(self, pending: Rows = ()) -> Iterator[RowChanges]:
        """Transaction of changes, with an identity check of the file.

        Args:
            pending: Rows to be inserted, which are saved elsewhere if the store was lost.

        Raises:
            StorageError: The disk is full or fails; or the store was lost or remained locked, and the message names the
            file with the rescued rows.
            EvidenceError: The file cannot be written.
        """
        if self._lost is not None:
            raise self._lost
        changes = RowChanges(self._database)
        try:
            with self._database.transaction():
                yield changes
                changes.ledger.write(self._database)
        except EvidenceError as error:
            problem = self._identity.problem()
            if problem:
                raise self._loss(problem, pending) from error
            if pending and is_of_lock(error):
                raise self._loss("was locked by another process", pending, Loss.LOCKED) from error
            raise
        problem = self._identity.problem()
        if problem:
            raise self._loss(problem)
        self._written.update(changes.written)

    def confirm(self) -> None:
        """Read back the rows written since the last call through a new connection, and check the whole file.

        Raises:
            StorageError: The store was lost; the message names the file with the rescued rows.
        """
        if self._lost is not None:
            raise self._lost
        problem = self._identity.problem() or (self._difference() if self._written else "")
        if problem:
            raise self._loss(problem)
        self._written.clear()

    def _difference(self) -> str:
        """Difference of the file from the written rows, read through a connection without cached pages."""
        try:
            with (
                translated_errors(self._database.name),
                closing(connect(self._identity.path)) as connection,
            ):
                require_own_schema(connection, "it")
                require_sound_pages(connection, "it")
                again = Database(connection, "it")
                require_ledger(again)
                missing = sum(1 for _ in self._missing(again))
        except StorageError:
            raise
        except EvidenceError as error:
            return f"cannot be read back: {error.message}"
        return f"lacks {missing} of {len(self._written)} written rows" if missing else ""

    def _missing(self, again: Database) -> Iterable[str]:
        tables = {table.name: table for table in TABLES}
        for (name, key), fingerprint in self._written.items():
            row = again.one(tables[name].by_key, [key])
            if row is None or _fingerprint(row) != fingerprint:
                yield key

    def _loss(self, problem: str, pending: Rows = (), loss: Loss = Loss.BROKEN) -> StorageError:
        """Error for a lost store, raised after the rescue of its rows."""
        if self._identity.is_replaced:
            loss = Loss.REPLACED
        name = self._database.name
        saved = rescued(self._database.connection, self._identity.path, pending, label=name, loss=loss)
        if not (saved.rows or pending) and self._identity.moved_to is not None:
            saved = Rescue(text="everything that was finished is in it", hint="run the sweep again there")
        if saved.rows:
            self._identity.discard_orphaned_logs()
        self._lost = StorageError(
            f"the evidence store {name} {problem} while it was in use; {saved.text}", hint=saved.hint
        )
        return self._lost


def _fingerprint(row: Row) -> bytes:
    hashed = hashlib.blake2b(digest_size=16)
    for value in row:
        content = value if isinstance(value, bytes) else repr(value).encode("utf-8", "backslashreplace")
        hashed.update(b"%d:" % len(content) + content)
    return hashed.digest()
