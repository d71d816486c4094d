"""Migration from schema 1, with only trials as plain texts, to the present tables."""

from __future__ import annotations

import sqlite3
import zlib
from collections.abc import Callable

from rgss.errors import EvidenceError
from rgss.evidence.records import Fidelity, plain_json

FIRST_TABLE = """CREATE TABLE trials (
    key TEXT NOT NULL PRIMARY KEY,
    content_digest TEXT NOT NULL,
    seal TEXT NOT NULL,
    record TEXT NOT NULL,
    provenance TEXT NOT NULL
)"""
"""The table of schema 1."""

_COPY = """INSERT INTO trials (key, variant, seed, fidelity, content_digest, seal, record, provenance)
    SELECT key, ?, ?, ?, content_digest, seal, ?, ? FROM trials_1 WHERE rowid = ?"""


def migrate_from_first(connection: sqlite3.Connection, make_tables: Callable[[sqlite3.Connection], None]) -> None:
    """Migrate the trials of schema 1 to the present tables, within the caller's transaction.

    Rows keep their digests and seals, so that earlier damage is still detected. Their texts are packed.

    Args:
        connection: The database, in a transaction.
        make_tables: Function that creates the present tables.

    Raises:
        sqlite3.Error: The database is damaged or cannot be written.
    """
    connection.execute("ALTER TABLE trials RENAME TO trials_1")
    make_tables(connection)
    # As bytes, since a damaged text may not be Unicode; one at a time, since there may be many.
    texts = "SELECT CAST(record AS BLOB), CAST(provenance AS BLOB) FROM trials_1 WHERE rowid = ?"
    for (number,) in connection.execute("SELECT rowid FROM trials_1 ORDER BY rowid").fetchall():
        record, provenance = connection.execute(texts, (number,)).fetchone()
        packed = (zlib.compress(record or b"", 1), zlib.compress(provenance or b"", 1))
        connection.execute(_COPY, (*_names(record or b""), *packed, number))
    connection.execute("DROP TABLE trials_1")


def _names(record: bytes) -> tuple[int, int, str]:
    """Lookup columns of a trial; a record without them is damaged, which its seal detects."""
    try:
        data = plain_json(record.decode("utf-8"), "record")
        variant, seed, fidelity = data["variant"], data["seed"], Fidelity(data["fidelity"]).value
    except (EvidenceError, UnicodeDecodeError, TypeError, KeyError, ValueError):
        return -1, -1, ""
    if not all(type(number) is int and abs(number) < 2**63 for number in (variant, seed)):
        return -1, -1, ""
    return variant, seed, fidelity
