"""The database file of a store: what makes it one, and what is refused."""

from __future__ import annotations

import sqlite3
import time

from rgss.errors import EvidenceError

APPLICATION_ID = 0x72677373
"""``rgss`` in ASCII, in the header of the file."""

SCHEMA_VERSION = 1

BUSY_TIMEOUT_S = 30.0
"""How long a connection waits for another process that is writing."""

_PAUSE_S = 0.02

_TABLE = """CREATE TABLE trials (
    key TEXT NOT NULL PRIMARY KEY,
    content_digest TEXT NOT NULL,
    seal TEXT NOT NULL,
    record TEXT NOT NULL,
    provenance TEXT NOT NULL
)"""


def prepare(connection: sqlite3.Connection, name: str) -> None:
    """Make an empty database a store, or check that it is one that this version can read.

    Args:
        connection: An open database, in autocommit mode.
        name: What to call it in messages.

    Raises:
        EvidenceError: It is the database of something else, of a newer version, or has been
            given views, triggers or other tables.
        sqlite3.Error: It is no database, is damaged, or cannot be written.
    """
    # Nothing that a foreign file defines in its schema may call functions.
    connection.execute("PRAGMA trusted_schema = OFF")
    connection.execute("PRAGMA cell_size_check = ON")
    if _is_empty(connection):
        _create(connection)
    _check(connection, name)
    _check_pages(connection, name)
    _log_ahead(connection)
    # A committed trial survives a loss of power as well as the end of the process.
    connection.execute("PRAGMA synchronous = FULL")


def _is_empty(connection: sqlite3.Connection) -> bool:
    (objects,) = connection.execute("SELECT count(*) FROM sqlite_master").fetchone()
    return objects == 0 and _pragma(connection, "application_id") == 0 and _pragma(connection, "user_version") == 0


def _create(connection: sqlite3.Connection) -> None:
    connection.execute("BEGIN IMMEDIATE")
    try:
        # Another process may have done it since this one looked.
        if _is_empty(connection):
            connection.execute(_TABLE)
            connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
            connection.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
        connection.execute("COMMIT")
    except BaseException:
        connection.execute("ROLLBACK")
        raise


def _log_ahead(connection: sqlite3.Connection) -> None:
    """Switch the file to write-ahead logging, which it then keeps."""
    attempts_left = int(BUSY_TIMEOUT_S / _PAUSE_S)
    while not _is_logging_ahead(connection, may_fail=attempts_left > 0):
        attempts_left -= 1
        time.sleep(_PAUSE_S)


def _is_logging_ahead(connection: sqlite3.Connection, *, may_fail: bool) -> bool:
    try:
        connection.execute("PRAGMA journal_mode = WAL")
    except sqlite3.OperationalError as error:
        # SQLite does not wait here by itself when two processes switch at once.
        if may_fail and "locked" in str(error):
            return False
        raise
    return True


def _check(connection: sqlite3.Connection, name: str) -> None:
    if _pragma(connection, "application_id") != APPLICATION_ID:
        raise EvidenceError(f"{name} is not an evidence store", hint="choose another file; this one is left as it is")
    version = _pragma(connection, "user_version")
    if version != SCHEMA_VERSION:
        age = "newer" if isinstance(version, int) and version > SCHEMA_VERSION else "unknown"
        hint = "use the rgss that wrote it, or another file"
        raise EvidenceError(f"{name} has the {age} schema {version}; this rgss reads {SCHEMA_VERSION}", hint=hint)
    found = connection.execute("SELECT type, name, sql FROM sqlite_master ORDER BY name").fetchall()
    if [row for row in found if not str(row[1]).startswith("sqlite_")] != [("table", "trials", _TABLE)]:
        raise EvidenceError(
            f"{name} has a schema that is not its own", hint="move the file away and run the sweep again"
        )


def _check_pages(connection: sqlite3.Connection, name: str) -> None:
    problem = _pragma(connection, "quick_check(1)")
    if problem != "ok":
        first = str(problem).splitlines()[-1][:120]
        raise EvidenceError(f"{name} is damaged: {first}", hint="move the file away and run the sweep again")


def _pragma(connection: sqlite3.Connection, name: str) -> object:
    return connection.execute(f"PRAGMA {name}").fetchone()[0]
