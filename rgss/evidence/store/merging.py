"""Merge of one store into another: what was saved of a lost store, or the store of a copy of the project."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from typing import Any, TypeVar

from rgss.errors import EvidenceError
from rgss.evidence.records import StoredTrial, numerics_difference, require_alike
from rgss.evidence.store.census import numerics_census
from rgss.evidence.store.connection import PROBLEMS
from rgss.evidence.store.ledger import recorded
from rgss.evidence.store.salvaging import readable_rows
from rgss.evidence.store.store import EvidenceStore
from rgss.evidence.store.tables import FAILURES, INPUTS, PIECES, TRIALS, Table, brief
from rgss.evidence.store.transactions import snapshot

Value = TypeVar("Value")

_AT_ONCE = 64
"""Entries of one transaction."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Merged:
    """Result of a merge.

    Attributes:
        trials: Number of added trials.
        pieces: Number of added pieces.
        present: Number of trials and pieces that were there.
        left_out: Number of rows of the other store that are damaged, or whose named inputs are.
        unproven: Number of its pieces that are not added, since no trial states with which numerics they were computed.
    """

    trials: int
    pieces: int
    present: int
    left_out: int
    unproven: int


def merge(store: EvidenceStore, other: EvidenceStore) -> Merged:
    """Add the valid rows of another store.

    The stores are compared before anything is written. An interrupted merge has added complete entries, and can be
    repeated.

    Args:
        store: The store to which they are added.
        other: The other one, which is only read.

    Raises:
        EvidenceError: The same inputs have another content in the two, or their trials were computed with different
            numerics; then nothing is written. Or a store cannot be read or written.
    """
    with snapshot(other.database.connection):
        _require_alike_numerics(store, other)
        for table in (PIECES, TRIALS):
            _require_same_contents(store, other, table)
        totals = recorded(other.database.connection)
        # The provenance of a trial has the numerics, that of a piece has not.
        unproven = 0 if totals[TRIALS.name].rows else totals[PIECES.name].rows
        tables = (INPUTS, *(() if unproven else (PIECES,)), TRIALS, FAILURES)
        counts = {PIECES.name: (0, 0), **{table.name: _added(store, other, table) for table in tables}}
        rows = sum(total.rows for total in totals.values()) - unproven
    (trials, valid_trials), (pieces, valid_pieces) = counts[TRIALS.name], counts[PIECES.name]
    return Merged(
        trials=trials,
        pieces=pieces,
        present=valid_trials + valid_pieces - trials - pieces,
        left_out=rows - sum(valid for _, valid in counts.values()),
        unproven=unproven,
    )


def _require_alike_numerics(store: EvidenceStore, other: EvidenceStore) -> None:
    """Require that pieces of both may be used for one trial."""
    here = [numerics for numerics, _ in numerics_census(store.database)]
    for there, _ in numerics_census(other.database):
        if here and all(numerics_difference(one, there) for one in here):
            require_alike(f"what is stored in {store.database.name}", here[0], there)


def _require_same_contents(store: EvidenceStore, other: EvidenceStore, table: Table[Any]) -> None:
    """Require that what both have is the same in both; damaged rows of the other are left out later."""
    for key, content in other.database.rows(_CONTENTS[table.name]):
        there = store.database.one(f"{_CONTENTS[table.name]} WHERE {table.key} = ?", [key])
        if there is not None and there[1] != content and _is_readable(other, table, key):
            raise EvidenceError(
                f"non-determinism: {table.what} {brief(key)} has different results in {store.database.name} and "
                f"{other.database.name}",
                hint="the same inputs must give the same content; nothing was merged",
            )


def _is_readable(store: EvidenceStore, table: Table[Any], key: str) -> bool:
    try:
        table.read(store.database.one(table.by_key, [key]) or ())
    except (*PROBLEMS, EvidenceError):
        return False
    return True


def _added(store: EvidenceStore, other: EvidenceStore, table: Table[Any]) -> tuple[int, int]:
    """Add the valid rows of a table; returns the numbers of new and of valid ones."""
    new = valid = 0
    for batch in _batches(table.read(row) for _, row in readable_rows(other.database.connection, table)):
        entries = _with_inputs(store, batch) if table is TRIALS else batch
        new += _put(store, table, entries)
        valid += len(entries)
    return new, valid


def _put(store: EvidenceStore, table: Table[Any], entries: Sequence[Any]) -> int:
    if table is INPUTS:
        return store.put_many(inputs=[one.values for one in entries])
    if table is PIECES:
        return store.put_many(pieces=entries)
    if table is TRIALS:
        return store.put_many(trials=[(one.key, one.record, one.provenance) for one in entries])
    known = store.failures([failure.key for failure in entries])
    return sum(store.put_failure(failure) for failure in entries if failure.key not in known)


def _with_inputs(store: EvidenceStore, trials: Sequence[StoredTrial]) -> list[StoredTrial]:
    """Trials whose named inputs are stored; those of the others are damaged."""
    names = {one.key: one.provenance.inputs_digest for one in trials}
    return [
        one for one in trials if not names[one.key] or store.database.one(INPUTS.is_there, [names[one.key]]) is not None
    ]


def _batches(values: Iterable[Value]) -> Iterator[list[Value]]:
    each = iter(values)
    while batch := list(islice(each, _AT_ONCE)):
        yield batch


_CONTENTS = {
    TRIALS.name: "SELECT key, content_digest FROM trials",
    PIECES.name: "SELECT digest, content_digest FROM pieces",
}
