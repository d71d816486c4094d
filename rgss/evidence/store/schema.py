"""Schema of the database file of a store: creation, checks, migration."""

from __future__ import annotations

import sqlite3
import time
from collections.abc import Sequence

from rgss.errors import EvidenceError
from rgss.evidence.store import connection as connecting
from rgss.evidence.store.ledger import LEDGER_TABLE, write_ledger
from rgss.evidence.store.migration import FIRST_TABLE, migrate_from_first
from rgss.evidence.store.transactions import transaction

APPLICATION_ID = 0x72677373
"""``rgss`` in ASCII, in the header of the file."""

SCHEMA_VERSION = 3
_BEFORE_LEDGER = 2

_PAUSE_S = 0.02

_TABLES: Sequence[tuple[str, str]] = (
    (
        "trials",
        """CREATE TABLE trials (
    key TEXT NOT NULL PRIMARY KEY,
    variant INTEGER NOT NULL,
    seed INTEGER NOT NULL,
    fidelity TEXT NOT NULL,
    content_digest TEXT NOT NULL,
    seal TEXT NOT NULL,
    record BLOB NOT NULL,
    provenance BLOB NOT NULL
)""",
    ),
    (
        "pieces",
        """CREATE TABLE pieces (
    digest TEXT NOT NULL PRIMARY KEY,
    kind TEXT NOT NULL,
    content_digest TEXT NOT NULL,
    seal TEXT NOT NULL,
    content BLOB NOT NULL
)""",
    ),
    (
        "inputs",
        """CREATE TABLE inputs (
    digest TEXT NOT NULL PRIMARY KEY,
    content BLOB NOT NULL
)""",
    ),
    (
        "failures",
        """CREATE TABLE failures (
    key TEXT NOT NULL PRIMARY KEY,
    what TEXT NOT NULL,
    kind TEXT NOT NULL,
    detail TEXT NOT NULL,
    attempts INTEGER NOT NULL,
    seal TEXT NOT NULL
)""",
    ),
)

_LEDGER = ("ledger", LEDGER_TABLE)

_INDEX = ("trials_by_variant", "CREATE INDEX trials_by_variant ON trials (variant, seed, fidelity)")


def make(connection: sqlite3.Connection) -> None:
    """Create the schema of a store in an empty database, in one transaction.

    Args:
        connection: An open database, in autocommit mode.

    Raises:
        sqlite3.Error: The database cannot be written.
    """
    with transaction(connection):
        connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
        _make_tables(connection)
        write_ledger(connection)
    _log_ahead(connection)


def prepare(connection: sqlite3.Connection, name: str) -> None:
    """Require that a database is a store, and migrate an older schema.

    Args:
        connection: An open database, in autocommit mode.
        name: Its name in messages.

    Raises:
        EvidenceError: The database is not a store, has a newer schema, or has foreign views, triggers or tables.
        sqlite3.Error: The file is not a database, is damaged, or cannot be written.
    """
    if _version(connection, name) != SCHEMA_VERSION:
        _migrate(connection, name)
    require_own_schema(connection, name)
    _log_ahead(connection)


def require_present(connection: sqlite3.Connection, name: str) -> None:
    """Require that a database is a store of the present schema, without migration.

    Raises:
        EvidenceError: The database is not a store, or has another schema.
        sqlite3.Error: The file is not a database, or is damaged.
    """
    version = _version(connection, name)
    if version != SCHEMA_VERSION:
        hint = "make the file and its folder writable, so that it can be migrated to the present schema"
        raise EvidenceError(f"{name} has the older schema {version} and cannot be written", hint=hint)
    require_own_schema(connection, name)


def require_own_schema(connection: sqlite3.Connection, name: str) -> None:
    """Require that a database has exactly the tables of a store.

    Raises:
        EvidenceError: The database has other tables, views or triggers.
        sqlite3.Error: The database cannot be read.
    """
    _check_schema(connection, name, (*_TABLES, _LEDGER), [_INDEX])


def require_sound_pages(connection: sqlite3.Connection, name: str) -> None:
    """Require undamaged pages before writing to a file; takes some milliseconds for ten thousand trials.

    Raises:
        EvidenceError: The file is damaged.
        sqlite3.Error: The file cannot be read.
    """
    _require_sound(connection, name, "quick_check(1)", "run 'rgss evidence verify' to see what can be recovered")


def _make_tables(connection: sqlite3.Connection) -> None:
    for _, statement in (*_TABLES, _LEDGER, _INDEX):
        connection.execute(statement)
    connection.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")


def _migrate(connection: sqlite3.Connection, name: str) -> None:
    """Migrate a store of an older schema, in one transaction."""
    with transaction(connection):
        version = _version(connection, name)
        if version == _BEFORE_LEDGER:
            _check_schema(connection, name, _TABLES, [_INDEX])
            connection.execute(LEDGER_TABLE)
            connection.execute(f"PRAGMA user_version = {SCHEMA_VERSION}")
            write_ledger(connection)
        # Another process may have migrated it meanwhile.
        elif version != SCHEMA_VERSION:
            _check_schema(connection, name, [("trials", FIRST_TABLE)], [])
            # A complete check, since rows that are not migrated would be lost.
            _require_sound(connection, name, "integrity_check(1)", "move the file away and run the sweep again")
            migrate_from_first(connection, _make_tables)
            write_ledger(connection)


def _version(connection: sqlite3.Connection, name: str) -> int:
    if _pragma(connection, "application_id") != APPLICATION_ID:
        raise EvidenceError(f"{name} is not an evidence store", hint="use another file; this one is unchanged")
    version = _pragma(connection, "user_version")
    if version not in (1, _BEFORE_LEDGER, SCHEMA_VERSION):
        age = "newer" if isinstance(version, int) and version > SCHEMA_VERSION else "unknown"
        hint = "use the rgss that wrote it, or another file"
        raise EvidenceError(f"{name} has the {age} schema {version}; this rgss reads {SCHEMA_VERSION}", hint=hint)
    return int(str(version))


def _check_schema(
    connection: sqlite3.Connection,
    name: str,
    tables: Sequence[tuple[str, str]],
    indices: Sequence[tuple[str, str]],
) -> None:
    expected: list[tuple[str, str, str, str | None]] = [("table", table, table, text) for table, text in tables]
    expected += [("index", f"sqlite_autoindex_{table}_1", table, None) for table, _ in tables]
    expected += [("index", index, "trials", text) for index, text in indices]
    found = connection.execute("SELECT type, name, tbl_name, sql FROM sqlite_master").fetchmany(len(expected) + 1)
    if sorted(found, key=repr) != sorted(expected, key=repr):
        raise EvidenceError(f"{name} has a foreign schema", hint="move the file away and run the sweep again")


def _require_sound(connection: sqlite3.Connection, name: str, check: str, hint: str) -> None:
    problem = _pragma(connection, check)
    if problem != "ok":
        raise EvidenceError(f"{name} is damaged: {' '.join(str(problem).split())[-120:]}", hint=hint)


def _log_ahead(connection: sqlite3.Connection) -> None:
    """Switch the file permanently to write-ahead logging."""
    # SQLite itself waits for a lock in some attempts, and returns at once in others.
    end_s = time.monotonic() + connecting.BUSY_TIMEOUT_S
    while not _is_logging_ahead(connection, may_fail=time.monotonic() < end_s):
        time.sleep(_PAUSE_S)


def _is_logging_ahead(connection: sqlite3.Connection, *, may_fail: bool) -> bool:
    try:
        connection.execute("PRAGMA journal_mode = WAL")
    except sqlite3.OperationalError as error:
        # SQLite does not wait here if two processes switch at once.
        if may_fail and "locked" in str(error):
            return False
        raise
    return True


def _pragma(connection: sqlite3.Connection, name: str) -> object:
    return connection.execute(f"PRAGMA {name}").fetchone()[0]
