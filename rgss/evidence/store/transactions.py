"""SQLite transactions that are always committed or rolled back."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def snapshot(connection: sqlite3.Connection) -> Iterator[None]:
    """One state of a database for several queries, some of which may fail on damaged pages.

    Args:
        connection: An open database, in autocommit mode.

    Raises:
        sqlite3.Error: The database cannot be read.
    """
    connection.execute("BEGIN DEFERRED")
    try:
        yield
    finally:
        # SQLite ends a transaction itself at some errors.
        if connection.in_transaction:
            connection.execute("ROLLBACK")


@contextmanager
def transaction(connection: sqlite3.Connection, kind: str = "IMMEDIATE") -> Iterator[None]:
    """Atomic transaction of a database.

    Args:
        connection: An open database, in autocommit mode.
        kind: ``IMMEDIATE`` to write, ``DEFERRED`` to read.

    Raises:
        sqlite3.Error: The database cannot be read or written.
    """
    connection.execute(f"BEGIN {kind}")
    try:
        yield
        connection.execute("COMMIT")
    except BaseException:
        # SQLite may have rolled back already, as on a full disk.
        if connection.in_transaction:
            connection.execute("ROLLBACK")
        raise
