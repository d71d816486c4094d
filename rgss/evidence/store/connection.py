"""Database file of a store: opening, transactions, translation of errors."""

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
from rgss.evidence.store.transactions import transaction

BUSY_TIMEOUT_S = 30.0
"""How long a connection waits for another process that is writing."""

LARGEST_ROW = LARGEST_TEXT + 1024 * 1024
"""Bytes of the longest row that is read: a text that cannot be compressed, and the other columns."""

Row = tuple[Any, ...]

PROBLEMS = (sqlite3.Error, UnicodeError)
"""What a database file can raise; the second when an error's text repeats bytes of a damaged schema."""

_HINTS: Mapping[str, str] = {
    "locked": "another process is using it; try again when it is done",
    "readonly": "choose a file and a folder that can be written",
    "unable to open": "check that it is a file in a folder that can be written",
    "not a database": "choose another file; this one is left as it is",
    "malformed": "'rgss evidence verify' shows what is left of it",
    "full": "free some space on the disk; what was put before is kept",
    "disk I/O": "free some space on the disk or look for its health; what was put before is kept",
    "closed": "open the store again",
    "no index": "run 'rgss evidence' where the file can be written, which takes its log into it",
    "thread": "open the store in the thread that uses it",
}

_OUTSIDE = ("locked", "full", "disk I/O")
"""External causes of failure, by SQLite's messages."""

_OUTSIDE_LATER = (*_OUTSIDE, "readonly", "unable to open")
"""The same once a file could be opened and written."""

_NO_SPACE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EMFILE, errno.ENFILE)
SPACE_HINT = "free some space on the disk, or raise the limit; what was put before is kept"


class Database:
    """An open database file; every error of SQLite is raised as one of rgss, with the file's name.

    Attributes:
        connection: The connection, in autocommit mode.
        name: The file's name in messages.
    """

    def __init__(self, connection: sqlite3.Connection, name: str) -> None:
        self.connection = connection
        self.name = name

    def one(self, statement: str, values: Iterable[object] = ()) -> Row | None:
        """The first row of a query; None if there is none."""
        with self.in_our_words():
            row: Row | None = self.connection.execute(statement, tuple(values)).fetchone()
        return row

    def rows(self, statement: str, values: Iterable[object] = ()) -> list[Row]:
        """All rows of a query."""
        with self.in_our_words():
            return self.connection.execute(statement, tuple(values)).fetchall()

    def change(self, statement: str, values: Iterable[object] = ()) -> int:
        """Change rows; returns how many were."""
        with self.in_our_words():
            return self.connection.execute(statement, tuple(values)).rowcount

    def size_bytes(self) -> int:
        """Bytes of the pages, with those that are still in the log and those that are free."""
        return int(self.one("PRAGMA page_count")[0]) * int(self.one("PRAGMA page_size")[0])  # type: ignore[index]

    @contextmanager
    def transaction(self, kind: str = "IMMEDIATE") -> Iterator[None]:
        """Transaction: changes within it take effect as a whole or not at all.

        Args:
            kind: ``IMMEDIATE`` to write, ``DEFERRED`` to read.

        Raises:
            EvidenceError: The database cannot be read or written.
        """
        with self.in_our_words(), transaction(self.connection, kind):
            yield

    def close(self) -> None:
        """Close the file; a second time does nothing."""
        with self.in_our_words():
            self.connection.close()

    def in_our_words(self) -> AbstractContextManager[None]:
        """Translate errors of SQLite, given that the file could be opened."""
        return in_our_words(self.name, outside=_OUTSIDE_LATER)


def is_writable(path: Path) -> bool:
    """True if a file can be written, and the logs beside it that SQLite needs for that."""
    effective = os.access in os.supports_effective_ids
    return all(os.access(place, os.W_OK, effective_ids=effective) for place in (path, path.parent))


def connect(path: Path, *, though_damaged: bool = False, read_only: bool = False) -> sqlite3.Connection:
    """Open a database file so that a commit outlasts a loss of power and nothing in the file can act.

    Args:
        path: The file.
        though_damaged: Also if it is shorter than its header states; only for reading.
        read_only: Make no file beside it and change nothing, where nothing can be written.

    Raises:
        sqlite3.Error: It cannot be opened.
    """
    # In autocommit mode, so that transactions begin and end where the store does it.
    connection = sqlite3.connect(
        _read_only_name(path) if read_only else path, timeout=BUSY_TIMEOUT_S, isolation_level=None, uri=read_only
    )
    # A text that is not Unicode is damage of one row, which the row's digests detect.
    connection.text_factory = lambda content: content.decode("utf-8", "surrogateescape")
    try:
        if sys.version_info >= (3, 11):
            # A longer row is an error before it is read.
            connection.setlimit(sqlite3.SQLITE_LIMIT_LENGTH, LARGEST_ROW)
        if though_damaged:
            # SQLite reads such a file only if its schema is writable.
            connection.execute("PRAGMA writable_schema = ON")
            connection.execute("PRAGMA query_only = ON")
        for setting in (
            "synchronous = FULL",
            "fullfsync = ON",
            "checkpoint_fullfsync = ON",
            # The schema of a foreign file must not call functions.
            "trusted_schema = OFF",
            "cell_size_check = ON",
            # A file that is cut short under a map would end the process.
            "mmap_size = 0",
        ):
            connection.execute(f"PRAGMA {setting}")
    except BaseException:
        connection.close()
        raise
    return connection


def _read_only_name(path: Path) -> str:
    """URI of the file for SQLite with which it makes and changes no file, not even the index of the log.

    Raises:
        sqlite3.OperationalError: There is a log without an index, which only a process that may write can read.
    """
    log, index = (path.with_name(f"{path.name}{ending}") for ending in ("-wal", "-shm"))
    if index.exists():
        return f"{path.resolve().as_uri()}?mode=ro&readonly_shm=1"
    if log.exists() and log.stat().st_size > 0:
        raise sqlite3.OperationalError("its log has no index")
    # Without a log nobody writes, and SQLite would otherwise make one.
    return f"{path.resolve().as_uri()}?immutable=1"


def problem_of(error: Exception) -> str:
    """Message for one of the `PROBLEMS`, in one line."""
    if isinstance(error, UnicodeError):
        return "a text of its schema is not Unicode"
    text = "".join(character if character.isprintable() else " " for character in str(error))
    return " ".join(text.split())[:200] or type(error).__name__


@contextmanager
def in_our_words(name: str, *, outside: Sequence[str] = _OUTSIDE, folder: Path | None = None) -> Iterator[None]:
    """Turn errors of SQLite into ours.

    Args:
        name: The file's name in messages.
        outside: External causes of failure, by SQLite's messages.
        folder: Where a file was to be opened: SQLite does not say why it could not be.

    Raises:
        StorageError: The disk is full or fails, or another process keeps the file locked.
        EvidenceError: For any other error of SQLite.
    """
    try:
        yield
    except PROBLEMS as error:
        problem = problem_of(error)
        obstacle = _obstacle(folder) if folder is not None and "unable to open" in problem else None
        if obstacle is not None:
            raise StorageError(
                f"the evidence store {name} cannot be used: {os.strerror(obstacle)}", hint=SPACE_HINT
            ) from error
        hints = (hint for phrase, hint in _HINTS.items() if phrase in problem)
        hint = next(hints, "'rgss evidence verify' looks for damage")
        kind = StorageError if any(phrase in problem for phrase in outside) else EvidenceError
        raise kind(f"the evidence store {name} cannot be used: {problem}", hint=hint) from error


def _obstacle(folder: Path) -> int | None:
    """Error number for which the system has no room for another file in a folder; None if it has room."""
    try:
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        return error.errno if error.errno in _NO_SPACE else None
    return None


def error_of(error: OSError) -> type[EvidenceError]:
    """The kind of error that a file's is: `StorageError` if the disk is full or fails, or no more files can be open."""
    return StorageError if error.errno in _NO_SPACE else EvidenceError
