"""Garbage collection of a store: unreferenced trials, pieces, inputs and failures."""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from pathlib import Path

from rgss.errors import EvidenceError, StorageError
from rgss.evidence.records import provenance_from_json, unpack
from rgss.evidence.store import connection as connecting
from rgss.evidence.store.connection import Database, translated_errors
from rgss.evidence.store.contents import TrialName, trial_names
from rgss.evidence.store.creation import require_content
from rgss.evidence.store.ledger import Total, recorded, require_ledger, write_ledger
from rgss.evidence.store.permissions import refusal_of
from rgss.evidence.store.place import place_of
from rgss.evidence.store.schema import prepare, require_sound_pages
from rgss.evidence.store.tables import FAILURES, INPUTS, PIECES, TRIALS

_PATIENCE_MS = 2000


@dataclass(frozen=True, slots=True, kw_only=True)
class Garbage:
    """Unreferenced entries of a store.

    Attributes:
        trials: Keys of the trials.
        pieces: Digests of the pieces that are not retained and not referenced by a retained trial.
        inputs: Digests of the named inputs that no retained trial references.
        failures: Keys of the failures of unreferenced trials and pieces.
        size_bytes: Their total size in bytes, without overhead of the file.
    """

    trials: tuple[TrialName, ...]
    pieces: tuple[str, ...]
    inputs: tuple[str, ...]
    failures: tuple[str, ...]
    size_bytes: int

    def __bool__(self) -> bool:
        return bool(self.trials or self.pieces or self.inputs or self.failures)


@dataclass(frozen=True, slots=True, kw_only=True)
class Collection:
    """Result of a collection.

    Attributes:
        garbage: Removed rows.
        before_bytes: Size of the file before.
        after_bytes: Size of the file after.
        shrunk: True if the file was compacted; otherwise its free pages are reused.
    """

    garbage: Garbage
    before_bytes: int
    after_bytes: int
    shrunk: bool


def find_garbage(database: Database, *, trials: AbstractSet[str], pieces: AbstractSet[str]) -> Garbage:
    """Find unreferenced entries: trials that are not retained, and entries that no retained trial references.

    Args:
        database: The store's file.
        trials: Keys of the trials to retain.
        pieces: Digests of further pieces to retain, such as those of trials that are not run yet.

    Raises:
        EvidenceError: The store is damaged or cannot be read.
    """
    removed = tuple(name for name in trial_names(database) if name.key not in trials)
    used_pieces, used_inputs = _references(database, trials)
    unused_pieces = _unused(database.rows(_PIECES), used_pieces | pieces)
    unused_inputs = _unused(database.rows(_INPUTS), used_inputs)
    named = trials | pieces
    failures = tuple(key for (key,) in database.rows("SELECT key FROM failures ORDER BY key") if key not in named)
    return Garbage(
        trials=removed,
        pieces=tuple(unused_pieces),
        inputs=tuple(unused_inputs),
        failures=failures,
        size_bytes=sum(name.size_bytes for name in removed) + sum((unused_pieces | unused_inputs).values()),
    )


def collect_garbage(
    path: Path,
    *,
    trials: AbstractSet[str],
    pieces: AbstractSet[str],
    label: str,
    then: Mapping[str, Total] | None = None,
) -> Collection:
    """Remove unreferenced entries in one transaction, and compact the file.

    No other process may have the store open: pieces of a running sweep are not referenced by a trial yet.

    Args:
        path: The file.
        trials: As in `find_garbage`.
        pieces: As in `find_garbage`.
        label: The file's name in messages.
        then: Ledger of the store from which the names were determined; None if they do not depend on the store.

    Raises:
        StorageError: Another process has changed the store since then, so that it may contain entries to retain that
        are not named.
        EvidenceError: Another process has the store open, or it is damaged or cannot be written.
    """
    path = place_of(path, label=label)
    require_content(path, label=label)
    refusal = refusal_of(path)
    with translated_errors(label, path=path):
        connection = connecting.connect(path)
    database = Database(connection, label, refusal)
    try:
        with translated_errors(label, path=path):
            prepare(connection, label)
            require_sound_pages(connection, label)
            require_ledger(database)
        _lock_exclusively(database)
        before = database.size_bytes()
        with database.transaction():
            if then is not None and recorded(connection) != then:
                raise StorageError(f"{label} was changed by another process meanwhile", hint="try again")
            garbage = find_garbage(database, trials=trials, pieces=pieces)
            for table, keys in (
                (TRIALS, [name.key for name in garbage.trials]),
                (PIECES, garbage.pieces),
                (INPUTS, garbage.inputs),
                (FAILURES, garbage.failures),
            ):
                for key in keys:
                    database.change(f"{table.delete} WHERE {table.key} = ?", [key])
            write_ledger(connection)
        shrunk = _compact(connection)
        return Collection(garbage=garbage, before_bytes=before, after_bytes=database.size_bytes(), shrunk=shrunk)
    finally:
        database.close()


def _lock_exclusively(database: Database) -> None:
    """Lock the file exclusively until it is closed.

    Leaving write-ahead logging needs a lock that is not granted while another process has the file open; the next
    process that opens the file enables logging again.
    """
    try:
        database.connection.execute(f"PRAGMA busy_timeout = {_PATIENCE_MS}")
        database.connection.execute("PRAGMA locking_mode = EXCLUSIVE")
        database.connection.execute("PRAGMA journal_mode = DELETE")
    except sqlite3.OperationalError as error:
        if "locked" not in str(error):
            with database.translated_errors():
                raise
        raise EvidenceError(
            f"another process has the evidence store {database.name} open", hint="wait until the sweep has finished"
        ) from error


def _compact(connection: sqlite3.Connection) -> bool:
    """Compact the file; no effect on a full disk."""
    try:
        connection.execute("VACUUM")
    except sqlite3.OperationalError:
        return False
    return True


def _references(database: Database, trials: AbstractSet[str]) -> tuple[set[str], set[str]]:
    """Digests of the pieces and of the named inputs referenced by the retained trials."""
    pieces: set[str] = set()
    inputs: set[str] = set()
    for key in sorted(trials):
        row = database.one("SELECT provenance FROM trials WHERE key = ?", [key])
        if row is None:
            continue
        try:
            provenance = provenance_from_json(unpack(row[0], "provenance"))
        except EvidenceError as error:
            raise EvidenceError(
                f"{database.name}: trial {key[:12]} is damaged: {error.message}",
                hint="run 'rgss evidence verify --mend' to remove it",
            ) from error
        pieces.update(provenance.inputs.values())
        inputs.add(provenance.inputs_digest)
    return pieces, inputs


def _unused(rows: list[tuple[str, int]], used: AbstractSet[str]) -> dict[str, int]:
    return {name: int(size) for name, size in rows if name not in used}


_PIECES = "SELECT digest, length(content) FROM pieces ORDER BY digest"
_INPUTS = "SELECT digest, length(content) FROM inputs ORDER BY digest"
