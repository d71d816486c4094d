"""The evidence store: one SQLite file, one row a trial."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from rgss.documents.digests import digest
from rgss.errors import EvidenceError
from rgss.evidence.codec import record_from_json, record_to_json
from rgss.evidence.digests import is_digest, text_digest
from rgss.evidence.provenance import Provenance, provenance_from_json, provenance_to_json
from rgss.evidence.records import TrialRecord
from rgss.evidence.schema import BUSY_TIMEOUT_S, prepare
from rgss.findings import shown


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredTrial:
    """A row of the store.

    Attributes:
        key: SHA-256 of what went into the trial.
        content_digest: SHA-256 of the record's canonical JSON.
        record: What came out of it.
        provenance: Where it comes from.
    """

    key: str
    content_digest: str
    record: TrialRecord
    provenance: Provenance


class EvidenceStore:
    """Trials by the digest of their inputs, in a file that several processes may share.

    Every write is a transaction: a process that is killed leaves the trials that it has put
    and no part of another. Every read checks the digests of the row. A store belongs to the
    process and thread that opened it; workers hand their records to it.
    """

    def __init__(self, connection: sqlite3.Connection, name: str) -> None:
        """Use `EvidenceStore.open` instead."""
        self._connection = connection
        self._name = name

    @classmethod
    def open(cls, path: Path, *, create: bool = True, label: str | None = None) -> EvidenceStore:
        """Open a store.

        Args:
            path: The file.
            create: Make the file and its folder if they are not there.
            label: The file's name in messages; the path itself by default.

        Raises:
            EvidenceError: The file is missing, is no store, is one of a newer rgss, is
                damaged, or cannot be written.
        """
        name = label if label is not None else str(path)
        if not create and not path.exists():
            raise EvidenceError(f"there is no evidence in {name}", hint="run the sweep first")
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            hint = "choose a folder that can be written"
            raise EvidenceError(f"the folder of {name} cannot be made: {error.strerror}", hint=hint) from error
        with _in_our_words(name):
            # In autocommit mode, so that transactions begin and end where this class says.
            connection = sqlite3.connect(path, timeout=BUSY_TIMEOUT_S, isolation_level=None)
            try:
                prepare(connection, name)
            except BaseException:
                connection.close()
                raise
        return cls(connection, name)

    def __enter__(self) -> EvidenceStore:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; a second time does nothing."""
        with _in_our_words(self._name):
            self._connection.close()

    def put(self, key: str, record: TrialRecord, provenance: Provenance) -> bool:
        """Keep a trial, on disk when this returns.

        Args:
            key: SHA-256 of what went into the trial.
            record: What came out of it.
            provenance: Where it comes from.

        Returns:
            Whether it is new; False if the same trial with the same result was there.

        Raises:
            EvidenceError: The key is there with another result, the key or the record is
                malformed, or the file cannot be written.
        """
        self._checked([key])
        text, origin = record_to_json(record), provenance_to_json(provenance)
        content = text_digest(text)
        row = (key, content, _seal(key, content, origin), text, origin)
        with self._transaction("IMMEDIATE"):
            inserted = self._connection.execute("INSERT OR IGNORE INTO trials VALUES (?, ?, ?, ?, ?)", row).rowcount
            there = self._connection.execute("SELECT content_digest FROM trials WHERE key = ?", (key,)).fetchone()
        if there[0] != content:
            message = f"trial {key[:12]} of variant {record.variant}, seed {record.seed} has another result than before"
            hint = f"the same inputs must give the same record; {_brief(there[0])} is kept, {content[:12]} is not"
            raise EvidenceError(f"non-determinism: {message}", hint=hint)
        return inserted == 1

    def get(self, key: str) -> StoredTrial | None:
        """The trial with a key; None if there is none.

        Raises:
            EvidenceError: Its row is damaged, or the file cannot be read.
        """
        self._checked([key])
        with _in_our_words(self._name):
            row = self._connection.execute(_SELECT + " WHERE key = ?", (key,)).fetchone()
        return None if row is None else self._read(row)

    def has(self, keys: Iterable[str]) -> set[str]:
        """Those of the keys whose trials are in the store.

        Raises:
            EvidenceError: The file cannot be read.
        """
        wanted, found = self._checked(keys), set()
        with self._transaction("DEFERRED"):
            for key in wanted:
                if self._connection.execute("SELECT 1 FROM trials WHERE key = ?", (key,)).fetchone():
                    found.add(key)
        return found

    def records(self, keys: Iterable[str]) -> Mapping[str, TrialRecord]:
        """The records of those of the keys that are in the store, in the order of the keys.

        Raises:
            EvidenceError: A row is damaged, or the file cannot be read.
        """
        wanted, found = self._checked(keys), {}
        with self._transaction("DEFERRED"):
            for key in wanted:
                trial = self.get(key)
                if trial is not None:
                    found[key] = trial.record
        return found

    def all(self) -> tuple[StoredTrial, ...]:
        """Every trial, in the order of keys, whatever the order in which they came.

        Raises:
            EvidenceError: A row is damaged, or the file cannot be read.
        """
        with _in_our_words(self._name):
            rows = self._connection.execute(_SELECT + " ORDER BY key").fetchall()
        return tuple(self._read(row) for row in rows)

    def __len__(self) -> int:
        with _in_our_words(self._name):
            (count,) = self._connection.execute("SELECT count(*) FROM trials").fetchone()
        return int(count)

    @contextmanager
    def _transaction(self, kind: str) -> Iterator[None]:
        with _in_our_words(self._name):
            self._connection.execute(f"BEGIN {kind}")
            try:
                yield
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:
                    self._connection.execute("ROLLBACK")
                raise

    def _checked(self, keys: Iterable[str]) -> list[str]:
        wanted = list(keys)
        for key in wanted:
            if not is_digest(key):
                raise EvidenceError(f"{_brief(key)} is not the key of a trial", hint="keys are made by trial_key")
        return wanted

    def _read(self, row: tuple[object, ...]) -> StoredTrial:
        key, content, seal, text, origin = row
        hint = "delete the store and run the sweep again"
        where = f"{self._name}: row {_brief(key)} is damaged"
        if not (is_digest(key) and isinstance(key, str) and isinstance(text, str) and isinstance(origin, str)):
            raise EvidenceError(f"{where}: it is not of texts", hint=hint)
        if text_digest(text) != content:
            raise EvidenceError(f"{where}: its record is not the one that was put", hint=hint)
        if _seal(key, str(content), origin) != seal:
            raise EvidenceError(f"{where}: its record or provenance belongs to another row", hint=hint)
        try:
            record, provenance = record_from_json(text), provenance_from_json(origin)
        except EvidenceError as error:
            raise EvidenceError(f"{where}: {error.message}", hint=hint) from error
        return StoredTrial(key=key, content_digest=str(content), record=record, provenance=provenance)


_SELECT = "SELECT key, content_digest, seal, record, provenance FROM trials"


def _seal(key: str, content: str, provenance: str) -> str:
    """Binds the parts of a row to each other, so that rows cannot be mixed up."""
    return digest([key, content, provenance])


def _brief(key: object) -> str:
    return key[:12] if isinstance(key, str) and is_digest(key) else shown(key)


_HINTS: Mapping[str, str] = {
    "locked": "another process is writing; try again when it is done",
    "readonly": "choose a file and a folder that can be written",
    "unable to open": "check that it is a file in a folder that can be written",
    "not a database": "choose another file; this one is left as it is",
    "malformed": "the file is damaged: move it away and run the sweep again",
    "full": "free some space on the disk",
    "closed": "open the store again",
    "thread": "open the store in the thread that uses it",
}


@contextmanager
def _in_our_words(name: str) -> Iterator[None]:
    try:
        yield
    except sqlite3.Error as error:
        problem = str(error).splitlines()[0][:200] if str(error) else type(error).__name__
        hint = next((hint for words, hint in _HINTS.items() if words in problem), "move the file away and try again")
        raise EvidenceError(f"the evidence store {name} cannot be used: {problem}", hint=hint) from error
