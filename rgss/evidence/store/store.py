"""Evidence store: one SQLite file with trials, shared pieces, and failures of runs."""

# long file: one class with a short method for each query of a store; half of its lines are docstrings.

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import Any, TypeVar

from rgss.errors import EvidenceError, StorageError
from rgss.evidence.records import (
    Fidelity,
    Piece,
    Provenance,
    RunFailure,
    StoredTrial,
    TrialRecord,
    failure_row,
    inputs_row,
    piece_row,
    read_trial,
    require_alike,
    require_key,
    trial_row,
)
from rgss.evidence.store.connection import Database, Row, connect, is_of_disk, is_writable, translated_errors
from rgss.evidence.store.creation import create_store, require_content
from rgss.evidence.store.ledger import require_ledger
from rgss.evidence.store.permissions import refusal_of
from rgss.evidence.store.place import place_of
from rgss.evidence.store.schema import prepare, require_present, require_sound_pages
from rgss.evidence.store.tables import FAILURES, INPUTS, PIECES, TRIALS, Table, brief
from rgss.evidence.store.writing import EvidenceWriter, RowChanges

Value = TypeVar("Value")

_AT_ONCE = 16
"""Rows of one batch of an iteration."""


class EvidenceStore:
    """Trials by the digest of their inputs, in a file that several processes may share.

    Every write is a transaction: a killed process leaves complete entries only. Every read verifies the digests of the
    row. A store belongs to the process and thread that opened it; workers send their results to it.

    Attributes:
        database: The file, for operations on it as a whole.
    """

    def __init__(self, database: Database, path: Path) -> None:
        """Use `EvidenceStore.open` instead."""
        self.database = database
        self._writer = EvidenceWriter(database, path)

    @classmethod
    def open(
        cls, path: Path, *, create: bool = True, read_only: bool = False, label: str | None = None
    ) -> EvidenceStore:
        """Open a store, migrating an older schema.

        Args:
            path: The file.
            create: True to create a missing file and its folder. Otherwise a file that cannot be written, or lies on a
                full disk, is opened read-only.
            read_only: True to open it read-only in any case, so that no file is created or changed. While no other
                process has it open it is treated as immutable; see `observed`.
            label: The file's name in messages; the path itself by default.

        Raises:
            EvidenceError: The file is missing, empty, not a regular file, not a store, of a newer schema, damaged, or
            cannot be written.
        """
        name = label if label is not None else str(path)
        path = place_of(path, label=name)
        if not path.exists():
            if read_only or not create:
                raise EvidenceError(f"there is no evidence in {name}", hint="run the sweep first")
            create_store(path, label=name)
        require_content(path, label=name)
        if read_only or (not create and not is_writable(path)):
            return cls._opened(path, name, read_only=True)
        try:
            return cls._opened(path, name, read_only=False)
        except StorageError as error:
            # On a full disk SQLite cannot make the index of its log, which who only reads does not need.
            if create or not is_of_disk(error):
                raise
            with suppress(EvidenceError):
                return cls._opened(path, name, read_only=True)
            raise

    @classmethod
    def _opened(cls, path: Path, name: str, *, read_only: bool) -> EvidenceStore:
        refusal = refusal_of(path)
        with translated_errors(name, path=path):
            connection = connect(path, read_only=read_only)
            try:
                (require_present if read_only else prepare)(connection, name)
                require_sound_pages(connection, name)
                database = Database(connection, name, refusal)
                require_ledger(database)
                return cls(database, path)
            except BaseException:
                connection.close()
                raise

    def __enter__(self) -> EvidenceStore:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self.close()

    def close(self) -> None:
        """Close the file; calling twice is allowed."""
        self.database.close()

    def put(self, key: str, record: TrialRecord, provenance: Provenance) -> bool:
        """Store a trial durably; see `put_many`.

        Returns:
            True if it is new; False if the same trial with the same result exists.
        """
        return self.put_many(trials=[(key, record, provenance)]) == 1

    def put_many(
        self,
        *,
        trials: Iterable[tuple[str, TrialRecord, Provenance]] = (),
        pieces: Iterable[Piece] = (),
        inputs: Iterable[Mapping[str, Any]] = (),
    ) -> int:
        """Store trials, pieces and named inputs durably, in one transaction.

        Stored failures of these trials and pieces are removed.

        Args:
            trials: Key, record and provenance of each.
            pieces: The pieces.
            inputs: Named inputs, which the trials may reference.

        Returns:
            The number of new trials and pieces; the others exist with the same content.

        Raises:
            EvidenceError: A trial or piece exists with another content, a trial references missing named inputs, an
            entry is malformed, or the file cannot be written.
        """
        inputs_rows = [inputs_row(each) for each in inputs]
        piece_rows = [piece_row(piece) for piece in pieces]
        trial_rows = [(trial_row(key, record, origin), origin.inputs_digest) for key, record, origin in trials]
        if not (inputs_rows or piece_rows or trial_rows):
            return 0
        pending: list[tuple[Table[Any], Row]] = [
            *((INPUTS, row) for row in inputs_rows),
            *((PIECES, row) for row in piece_rows),
            *((TRIALS, row) for row, _ in trial_rows),
        ]
        with self._writer.transaction(pending) as changes:
            for inputs_put in inputs_rows:
                changes.put(INPUTS, inputs_put)
            new = sum(self._put(changes, PIECES, piece, f"{piece[1]} {piece[0][:12]}") for piece in piece_rows)
            for row, needed in trial_rows:
                what = f"trial {row[0][:12]} of variant {row[1]}, seed {row[2]}"
                if needed and not self._is_there(INPUTS, needed):
                    raise EvidenceError(f"{what} refers to inputs that are not stored", hint="store its inputs first")
                new += self._put(changes, TRIALS, row, what)
        return new

    def put_failure(self, failure: RunFailure) -> bool:
        """Store a failure of the run, replacing an earlier one of the same trial or piece.

        Returns:
            True if it was stored; False if the trial or piece exists meanwhile.

        Raises:
            EvidenceError: The failure is malformed, or the file cannot be written.
        """
        row = failure_row(failure)
        with self._writer.transaction([(FAILURES, row)]) as changes:
            made = self._is_there(TRIALS, row[0]) or self._is_there(PIECES, row[0])
            if not made:
                changes.remove(FAILURES, row[0])
                changes.put(FAILURES, row)
        return not made

    def confirm(self) -> None:
        """Read back the entries stored since the last call, and check the identity of the file.

        Raises:
            StorageError: The file was removed, replaced or damaged meanwhile; the message names the file with the
            rescued rows.
            EvidenceError: The file cannot be read.
        """
        self._writer.confirm()

    def get(self, key: str) -> StoredTrial | None:
        """Trial by key; None if there is none.

        Raises:
            EvidenceError: Its row is damaged, or the file cannot be read.
        """
        return self._get(TRIALS, key)

    def piece(self, digest: str) -> Piece | None:
        """Piece by digest; None if there is none.

        Raises:
            EvidenceError: Its row is damaged, or the file cannot be read.
        """
        return self._get(PIECES, digest)

    def inputs(self, digest: str) -> Mapping[str, Any] | None:
        """Named inputs by digest; None if there are none.

        Raises:
            EvidenceError: Their row is damaged, or the file cannot be read.
        """
        found = self._get(INPUTS, digest)
        return None if found is None else found.values

    def failures(self, keys: Iterable[str]) -> Mapping[str, RunFailure]:
        """Stored failures among trials or pieces, in the order of the keys.

        Raises:
            EvidenceError: A row is damaged, or the file cannot be read.
        """
        return self._selected(FAILURES, keys)

    def has(self, keys: Iterable[str]) -> set[str]:
        """Keys of stored trials among the given ones.

        Raises:
            EvidenceError: The file cannot be read.
        """
        return self._existing(TRIALS, keys)

    def has_pieces(self, digests: Iterable[str]) -> set[str]:
        """Digests of stored pieces among the given ones.

        Raises:
            EvidenceError: The file cannot be read.
        """
        return self._existing(PIECES, digests)

    def records(self, keys: Iterable[str]) -> Mapping[str, TrialRecord]:
        """Records of the stored trials among the given keys, in the order of the keys.

        Raises:
            EvidenceError: A row is damaged, or the file cannot be read.
        """
        wanted = list(keys)
        with self.database.transaction("DEFERRED"):
            # The rest of each trial is released at once: of many trials it is larger than the records.
            return {key: trial.record for key in wanted if (trial := self._get(TRIALS, key)) is not None}

    def trials_of(self, variant: int, seed: int, fidelity: Fidelity) -> tuple[StoredTrial, ...]:
        """All trials of a variant with a seed, for any other inputs.

        Trials with named inputs come first; otherwise in the order of the keys.

        Raises:
            EvidenceError: A row is damaged, or the file cannot be read.
        """
        statement = f"{TRIALS.select} WHERE variant = ? AND seed = ? AND fidelity = ? ORDER BY key"
        rows = self.database.rows(statement, [variant, seed, Fidelity(fidelity).value])
        found = [TRIALS.value(row, self.database.name) for row in rows]
        return tuple(sorted(found, key=lambda trial: (not trial.provenance.inputs_digest, trial.key)))

    def iterate(self) -> Iterator[StoredTrial]:
        """Iterate over all trials in the order of keys, in batches; concurrent writing is allowed.

        Raises:
            EvidenceError: A row is damaged, or the file cannot be read.
        """
        last = ""
        while True:
            rows = self.database.rows(f"{TRIALS.select} WHERE key > ? ORDER BY key LIMIT {_AT_ONCE}", [last])
            for row in rows:
                trial = TRIALS.value(row, self.database.name)
                last = trial.key
                yield trial
            if len(rows) < _AT_ONCE:
                return

    def all(self) -> tuple[StoredTrial, ...]:
        """All trials in the order of keys; see `iterate`."""
        return tuple(self.iterate())

    def __len__(self) -> int:
        (row,) = self.database.rows("SELECT count(*) FROM trials")
        return int(row[0])

    def _put(self, changes: RowChanges, table: Table[Value], row: Row, what: str) -> bool:
        """Insert a row with a content digest; an existing row of the same key must be identical."""
        changes.remove(FAILURES, row[0])
        if changes.put(table, row):
            return True
        there = self.database.one(table.by_key, [row[0]])
        if there is not None and there[table.content or 0] != row[table.content or 0]:
            if table is TRIALS:
                made, makes = read_trial(there).provenance, read_trial(row).provenance
                require_alike(f"{what} in the store", made.numerics, makes.numerics)
            kept, other = brief(there[table.content or 0]), brief(row[table.content or 0])
            hint = f"the same inputs must give the same content; {kept} is stored, {other} is not"
            raise EvidenceError(f"non-determinism: {what} has another result than before", hint=hint)
        return False

    def _get(self, table: Table[Value], key: str) -> Value | None:
        require_key(key)
        row = self.database.one(table.by_key, [key])
        return None if row is None else table.value(row, self.database.name)

    def _selected(self, table: Table[Value], keys: Iterable[str]) -> dict[str, Value]:
        wanted = list(keys)
        with self.database.transaction("DEFERRED"):
            return {key: value for key in wanted if (value := self._get(table, key)) is not None}

    def _existing(self, table: Table[Value], keys: Iterable[str]) -> set[str]:
        wanted = list(keys)
        for key in wanted:
            require_key(key)
        with self.database.transaction("DEFERRED"):
            return {key for key in wanted if self._is_there(table, key)}

    def _is_there(self, table: Table[Value], key: str) -> bool:
        return self.database.one(table.is_there, [key]) is not None
