"""The four tables of a store, with their SQL statements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from rgss.errors import EvidenceError
from rgss.evidence.records import (
    Piece,
    RunFailure,
    StoredTrial,
    TrialInputs,
    is_digest,
    read_failure,
    read_inputs,
    read_piece,
    read_trial,
)
from rgss.evidence.store.connection import Row
from rgss.findings import shown

Value = TypeVar("Value")


@dataclass(frozen=True, slots=True, kw_only=True)
class Table(Generic[Value]):
    """Table with the prefixes of its SQL statements.

    Attributes:
        name: Its name in the database.
        what: Name of one of its rows in messages.
        key: The key column, which is the first.
        select: Selects whole rows.
        present: Selects the existence of rows.
        put: Inserts a whole row, unless its key exists.
        delete: Deletes rows.
        content: Column with the digest of the content; None if the key determines it.
        seal: Column with the seal of a row; None if the key determines it.
        read: Function that converts a whole row to its value; raises for a damaged row.
    """

    name: str
    what: str
    key: str
    select: str
    present: str
    put: str
    delete: str
    content: int | None
    seal: int | None
    read: Callable[[Row], Value]

    @property
    def by_key(self) -> str:
        """Statement that selects a row by key."""
        return f"{self.select} WHERE {self.key} = ?"

    @property
    def is_there(self) -> str:
        """Statement that selects the existence of a row by key."""
        return f"{self.present} WHERE {self.key} = ?"

    @property
    def identities(self) -> str:
        """Statement that selects key and seal of every row, for the ledger."""
        return self.present.replace("SELECT 1", f"SELECT {self.key}, {self._seal_column}", 1)

    @property
    def _seal_column(self) -> str:
        return "''" if self.seal is None else "seal"

    def value(self, row: Row, store: str) -> Value:
        """Read a row.

        Args:
            row: The whole row.
            store: The store's name in messages.

        Raises:
            EvidenceError: The row is damaged.
        """
        try:
            return self.read(row)
        except EvidenceError as error:
            message = f"{store}: {self.what} {brief(row[0])} is damaged: {error.message}"
            hint = "run 'rgss evidence verify --mend' to remove it; the next sweep computes it again"
            raise EvidenceError(message, hint=hint) from error


TRIALS: Table[StoredTrial] = Table(
    name="trials",
    what="trial",
    key="key",
    select="SELECT key, variant, seed, fidelity, content_digest, seal, record, provenance FROM trials",
    present="SELECT 1 FROM trials",
    put="INSERT OR IGNORE INTO trials VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
    delete="DELETE FROM trials",
    content=4,
    seal=5,
    read=read_trial,
)

PIECES: Table[Piece] = Table(
    name="pieces",
    what="piece",
    key="digest",
    select="SELECT digest, kind, content_digest, seal, content FROM pieces",
    present="SELECT 1 FROM pieces",
    put="INSERT OR IGNORE INTO pieces VALUES (?, ?, ?, ?, ?)",
    delete="DELETE FROM pieces",
    content=2,
    seal=3,
    read=read_piece,
)

INPUTS: Table[TrialInputs] = Table(
    name="inputs",
    what="inputs",
    key="digest",
    select="SELECT digest, content FROM inputs",
    present="SELECT 1 FROM inputs",
    put="INSERT OR IGNORE INTO inputs VALUES (?, ?)",
    delete="DELETE FROM inputs",
    content=None,
    seal=None,
    read=read_inputs,
)

FAILURES: Table[RunFailure] = Table(
    name="failures",
    what="failure",
    key="key",
    select="SELECT key, what, kind, detail, attempts, seal FROM failures",
    present="SELECT 1 FROM failures",
    put="INSERT OR REPLACE INTO failures VALUES (?, ?, ?, ?, ?, ?)",
    delete="DELETE FROM failures",
    content=None,
    seal=5,
    read=read_failure,
)

TABLES: tuple[Table[Any], ...] = (TRIALS, PIECES, INPUTS, FAILURES)


def brief(key: object) -> str:
    """Key for messages: the beginning of a digest, or the damaged value itself."""
    return key[:12] if isinstance(key, str) and is_digest(key) else shown(key)
