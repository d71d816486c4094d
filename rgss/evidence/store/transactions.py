"""Transactions of SQLite that are always ended."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def transaction(connection: sqlite3.Connection, kind: str = "IMMEDIATE") -> Iterator[None]:
    """Transaction of a database: changes within it take effect as a whole or not at all.

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
        # SQLite may have rolled back by itself, as it does when the disk is full.
        if connection.in_transaction:
            connection.execute("ROLLBACK")
        raise
