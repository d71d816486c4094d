"""Database file of a store: opening, transactions, translation of SQLite errors."""

from __future__ import annotations

import errno
import os
import sqlite3
import sys
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Any

from rgss.errors import EvidenceError, StorageError
from rgss.evidence.records import LARGEST_TEXT
from rgss.evidence.store.permissions import Refusal, refusal_of
from rgss.evidence.store.transactions import transaction

BUSY_TIMEOUT_S = 30.0
"""Timeout of a connection for another process that is writing."""

LARGEST_ROW = LARGEST_TEXT + 1024 * 1024
"""Greatest size of a row in bytes: an incompressible text plus the other columns."""

Row = tuple[Any, ...]

PROBLEMS = (sqlite3.Error, UnicodeError)
"""Exceptions of a database file; the second if an error's text contains bytes of a damaged schema."""

_HINTS: Mapping[str, str] = {
    "locked": "another process is using it; try again when it is done",
    "readonly": "choose a file and a folder that can be written",
    "unable to open": "check that it is a file in a folder that can be written",
    "not a database": "use another file; this one is unchanged",
    "malformed": "run 'rgss evidence verify' to see what can be recovered",
    "full": "free space on the disk; earlier entries are stored",
    "disk I/O": "free space on the disk or check its health; earlier entries are stored",
    "closed": "open the store again",
    "no index": "run 'rgss evidence' with write access to the file, which merges its log",
    "thread": "open the store in the thread that uses it",
}

_OUTSIDE = ("locked", "full", "disk I/O")
"""External causes of failure, by SQLite's messages."""

_OUTSIDE_LATER = (*_OUTSIDE, "readonly", "unable to open")
"""External causes of failure after the file could be opened and written."""

_MAYBE_REFUSED = ("readonly", "unable to open", "disk I/O")
"""SQLite's messages where permissions may be the reason."""

_NO_SPACE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EMFILE, errno.ENFILE)
SPACE_HINT = "free space on the disk, or raise the limit; earlier entries are stored"


class Database:
    """Open database file; SQLite errors are raised as errors of rgss, with the file's name.

    Attributes:
        connection: The connection, in autocommit mode.
        name: The file's name in messages.
    """

    def __init__(self, connection: sqlite3.Connection, name: str, refusal: Refusal | None = None) -> None:
        """Use an open file.

        Args:
            connection: The connection.
            name: The file's name in messages.
            refusal: What its permissions refused before it was opened; a disk that becomes read-only later has failed.
        """
        self.connection = connection
        self.name = name
        self._refusal = refusal

    def one(self, statement: str, values: Iterable[object] = ()) -> Row | None:
        """First row of a query; None if there is none."""
        with self.translated_errors():
            row: Row | None = self.connection.execute(statement, tuple(values)).fetchone()
        return row

    def rows(self, statement: str, values: Iterable[object] = ()) -> list[Row]:
        """All rows of a query."""
        with self.translated_errors():
            return self.connection.execute(statement, tuple(values)).fetchall()

    def change(self, statement: str, values: Iterable[object] = ()) -> int:
        """Execute a change; returns the number of changed rows."""
        with self.translated_errors():
            return self.connection.execute(statement, tuple(values)).rowcount

    def size_bytes(self) -> int:
        """Size of all pages in bytes, including those in the log and free ones."""
        return int(self.one("PRAGMA page_count")[0]) * int(self.one("PRAGMA page_size")[0])  # type: ignore[index]

    @contextmanager
    def transaction(self, kind: str = "IMMEDIATE") -> Iterator[None]:
        """Atomic transaction.

        Args:
            kind: ``IMMEDIATE`` to write, ``DEFERRED`` to read.

        Raises:
            EvidenceError: The database cannot be read or written.
        """
        with self.translated_errors(), transaction(self.connection, kind):
            yield

    def close(self) -> None:
        """Close the file; calling twice is allowed."""
        with self.translated_errors():
            self.connection.close()

    def translated_errors(self) -> AbstractContextManager[None]:
        """Context that translates SQLite errors after the file was opened."""
        return translated_errors(self.name, outside=_OUTSIDE_LATER, refusal=self._refusal)


def is_writable(path: Path) -> bool:
    """True if a file and the logs that SQLite creates beside it can be written."""
    effective = os.access in os.supports_effective_ids
    return all(os.access(place, os.W_OK, effective_ids=effective) for place in (path, path.parent))


def connect(path: Path, *, though_damaged: bool = False, read_only: bool = False) -> sqlite3.Connection:
    """Open a database file with durable commits and without execution of code in its schema.

    Args:
        path: The file.
        though_damaged: True to open it even if it is shorter than its header states, for reading only.
        read_only: True to create and change no file.

    Raises:
        sqlite3.Error: It cannot be opened.
    """
    # In autocommit mode; the store begins and ends transactions explicitly.
    connection = sqlite3.connect(
        _read_only_name(path) if read_only else path, timeout=BUSY_TIMEOUT_S, isolation_level=None, uri=read_only
    )
    # Invalid Unicode is damage of one row, detected by the row's digests.
    connection.text_factory = lambda content: content.decode("utf-8", "surrogateescape")
    try:
        if sys.version_info >= (3, 11):
            # A longer row raises an error before it is read.
            connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LARGEST_ROW)
        if though_damaged:
            # SQLite reads such a file only with a writable schema.
            connection.execute("PRAGMA writable_schema = ON")
            connection.execute("PRAGMA query_only = ON")
        for setting in (
            "synchronous = FULL",
            "fullfsync = ON",
            "checkpoint_fullfsync = ON",
            # The schema of a foreign file must not call functions.
            "trusted_schema = OFF",
            "cell_size_check = ON",
            # Truncation of a memory-mapped file would kill the process.
            "mmap_size = 0",
        ):
            connection.execute(f"PRAGMA {setting}")
    except BaseException:
        connection.close()
        raise
    return connection


def _read_only_name(path: Path) -> str:
    """URI of the file with which SQLite creates and changes no file, not even the index of the log.

    Raises:
        sqlite3.OperationalError: There is a log without an index, which can be read only with write access.
    """
    log, index = (path.with_name(f"{path.name}{ending}") for ending in ("-wal", "-shm"))
    if index.exists():
        return f"{path.resolve().as_uri()}?mode=ro&readonly_shm=1"
    if log.exists() and log.stat().st_size > 0:
        raise sqlite3.OperationalError("its log has no index")
    # Without a log there is no writer; otherwise SQLite would create one.
    return f"{path.resolve().as_uri()}?immutable=1"


def problem_of(error: Exception) -> str:
    """Message of one of the `PROBLEMS`, in one line."""
    if isinstance(error, UnicodeError):
        return "a text of its schema is not Unicode"
    text = "".join(character if character.isprintable() else " " for character in str(error))
    return " ".join(text.split())[:200] or type(error).__name__


@contextmanager
def translated_errors(
    name: str, *, outside: Sequence[str] = _OUTSIDE, path: Path | None = None, refusal: Refusal | None = None
) -> Iterator[None]:
    """Context that translates SQLite errors into errors of rgss.

    Args:
        name: The file's name in messages.
        outside: External causes of failure, by SQLite's messages.
        path: A file to be opened, whose errors SQLite does not explain.
        refusal: What the permissions of an open file refused when it was opened.

    Raises:
        StorageError: The disk is full or fails, or another process locks the file.
        EvidenceError: For any other error of SQLite, such as permissions.
    """
    try:
        yield
    except PROBLEMS as error:
        problem = problem_of(error)
        if any(phrase in problem for phrase in _MAYBE_REFUSED):
            refusal = refusal_of(path) if path is not None else refusal
            if refusal is not None:
                raise EvidenceError(
                    f"the evidence store {name} cannot be used: {refusal.problem}", hint=refusal.hint
                ) from error
        obstacle = _obstacle(path.parent) if path is not None and "unable to open" in problem else None
        if obstacle is not None:
            raise StorageError(
                f"the evidence store {name} cannot be used: {os.strerror(obstacle)}", hint=SPACE_HINT
            ) from error
        hints = (hint for phrase, hint in _HINTS.items() if phrase in problem)
        hint = next(hints, "run 'rgss evidence verify' to check for damage")
        kind = StorageError if any(phrase in problem for phrase in outside) else EvidenceError
        raise kind(f"the evidence store {name} cannot be used: {problem}", hint=hint) from error


def _obstacle(folder: Path) -> int | None:
    """Error number of creating a file in a folder; None if that succeeds."""
    try:
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        return error.errno if error.errno in _NO_SPACE else None
    return None


def is_of_disk(error: StorageError) -> bool:
    """True if a translated error of SQLite comes from a disk that is full or fails."""
    cause = error.__cause__
    return isinstance(cause, PROBLEMS) and any(
        one in problem_of(cause) for one in ("full", "disk I/O", "unable to open")
    )


def is_of_lock(error: EvidenceError) -> bool:
    """True if a translated error of SQLite comes from another process that keeps the file locked."""
    cause = error.__cause__
    return isinstance(cause, PROBLEMS) and "locked" in problem_of(cause)


def error_of(error: OSError) -> type[EvidenceError]:
    """Error class of an OSError: `StorageError` if the disk is full or fails, or too many files are open."""
    return StorageError if error.errno in _NO_SPACE else EvidenceError
