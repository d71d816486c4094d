"""Ledger of a store: the number of rows of each table and a checksum over all of them.

Digests and seals verify a row, but do not detect missing rows. The ledger is updated in the transaction that changes
the rows, so that rows deleted, added or renamed by other programs are detected.

The checksum of a table is the sum of the SHA-256 of its rows modulo 2^256, an incremental multiset
hash (Bellare and Micciancio, "A new paradigm for collision-free hashing", 1997): it depends neither on the order of the
rows nor on that of their insertion. Without a secret it detects damage and accidental changes, but not a forged ledger
of forged rows.
"""

from __future__ import annotations

import hashlib
import sqlite3
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from rgss.documents import digest
from rgss.errors import EvidenceError
from rgss.evidence.records import is_digest
from rgss.evidence.store.connection import Database, Row
from rgss.evidence.store.tables import TABLES, Table

LEDGER_TABLE = """CREATE TABLE ledger (
    name TEXT NOT NULL PRIMARY KEY,
    row_count INTEGER NOT NULL,
    checksum TEXT NOT NULL,
    seal TEXT NOT NULL
)"""

_MODULUS = 2**256
_SELECT = "SELECT name, row_count, checksum, seal FROM ledger ORDER BY name"
_WRITE = "INSERT OR REPLACE INTO ledger VALUES (?, ?, ?, ?)"


@dataclass(frozen=True, slots=True)
class Total:
    """Number of the rows of a table and the sum of their hashes modulo 2^256."""

    rows: int = 0
    checksum: int = 0

    def __add__(self, other: Total) -> Total:
        return Total(self.rows + other.rows, (self.checksum + other.checksum) % _MODULUS)

    def __sub__(self, other: Total) -> Total:
        return Total(self.rows - other.rows, (self.checksum - other.checksum) % _MODULUS)


class LedgerChanges:
    """Changes of one transaction, collected and then written within it."""

    def __init__(self) -> None:
        """Start without changes."""
        self._changes: dict[str, Total] = {}

    def added(self, table: Table[Any], row: Row) -> None:
        """Add an inserted row."""
        self._enter(table, _of_row(table, row))

    def removed(self, table: Table[Any], row: Row) -> None:
        """Add a deleted row."""
        self._enter(table, Total() - _of_row(table, row))

    def write(self, database: Database) -> None:
        """Write the changes, within the transaction of the rows.

        Raises:
            EvidenceError: The ledger is damaged, or cannot be written.
        """
        changed = {name: total for name, total in self._changes.items() if total != Total()}
        if changed:
            there = recorded(database.connection)
            for name, total in changed.items():
                database.change(_WRITE, _row(name, there[name] + total))

    def _enter(self, table: Table[Any], total: Total) -> None:
        self._changes[table.name] = self._changes.get(table.name, Total()) + total


def write_ledger(connection: sqlite3.Connection) -> None:
    """Write the ledger of the present rows, within the caller's transaction.

    Raises:
        sqlite3.Error: The database cannot be read or written.
    """
    connection.execute("DELETE FROM ledger")
    for name, total in counted(connection).items():
        connection.execute(_WRITE, _row(name, total))


def counted(connection: sqlite3.Connection) -> Mapping[str, Total]:
    """Totals of the present rows.

    Raises:
        sqlite3.Error: The database cannot be read.
    """
    totals = {}
    for table in TABLES:
        rows, checksum = 0, 0
        for key, seal in connection.execute(table.identities):
            rows += 1
            checksum += _hash(table.name, key, seal)
        totals[table.name] = Total(rows, checksum % _MODULUS)
    return totals


def recorded(connection: sqlite3.Connection) -> Mapping[str, Total]:
    """Totals in the ledger.

    Raises:
        EvidenceError: The ledger is damaged, or does not match these tables.
        sqlite3.Error: The database cannot be read.
    """
    found = {}
    for name, rows, checksum, seal in connection.execute(_SELECT):
        if (
            not isinstance(name, str)
            or type(rows) is not int
            or rows < 0
            or not is_digest(checksum)
            or seal != digest([name, rows, checksum])
        ):
            raise EvidenceError("the ledger is damaged", hint=_HINT)
        found[name] = Total(rows, int(checksum, 16))
    if found.keys() != {table.name for table in TABLES}:
        raise EvidenceError("the ledger must have one row for each table", hint=_HINT)
    return found


def differences(connection: sqlite3.Connection) -> Iterator[tuple[str, str]]:
    """Tables whose rows differ from the ledger, each with a message; within a transaction.

    Raises:
        sqlite3.Error: The database cannot be read.
    """
    try:
        expected = recorded(connection)
    except EvidenceError as error:
        yield "", error.message
        return
    for name, total in counted(connection).items():
        if total.rows != expected[name].rows:
            yield name, f"{expected[name].rows} rows were stored, {total.rows} are present"
        elif total != expected[name]:
            yield name, f"the {total.rows} rows are not those that were stored"


def require_ledger(database: Database) -> None:
    """Require that the rows of a store match its ledger.

    Raises:
        EvidenceError: Rows are missing, were added or were renamed; or the file cannot be read.
    """
    with database.transaction("DEFERRED"):
        for name, problem in differences(database.connection):
            where = f"table {name}: " if name else ""
            raise EvidenceError(f"{database.name} was changed outside rgss: {where}{problem}", hint=_HINT)


_HINT = "run 'rgss evidence verify' to see the damage, and with --mend to keep the valid rows"


def _of_row(table: Table[Any], row: Row) -> Total:
    return Total(1, _hash(table.name, row[0], "" if table.seal is None else row[table.seal]))


def _hash(name: str, key: object, seal: object) -> int:
    content = f"{name}\0{key}\0{seal}".encode("utf-8", "surrogateescape")
    return int.from_bytes(hashlib.sha256(content).digest(), "big")


def _row(name: str, total: Total) -> Row:
    checksum = f"{total.checksum:064x}"
    return (name, total.rows, checksum, digest([name, total.rows, checksum]))
