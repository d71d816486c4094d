"""Contents of a store, without reading the records."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from rgss.errors import EvidenceError
from rgss.evidence.records import Fidelity, PieceKind, RunFailure, is_digest
from rgss.evidence.store.connection import Database
from rgss.evidence.store.ledger import Total, recorded
from rgss.evidence.store.tables import FAILURES


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialName:
    """Index entry of a trial, without its record.

    Attributes:
        key: SHA-256 of its inputs.
        variant: Id of the design variant.
        seed: Its seed.
        fidelity: Its fidelity.
        size_bytes: Stored size in bytes.
    """

    key: str
    variant: int
    seed: int
    fidelity: str
    size_bytes: int


@dataclass(frozen=True, slots=True, kw_only=True)
class Contents:
    """Summary of a store's contents.

    Attributes:
        trials: The trials in the order of their keys.
        pieces: The number of pieces of each kind.
        inputs: The number of sets of named inputs.
        failures: Trials and pieces that could not be computed, in the order of the keys.
        size_bytes: Size of its file in bytes, including the log.
        ledger: Its ledger, which differs after every change.
    """

    trials: tuple[TrialName, ...]
    pieces: Mapping[str, int]
    inputs: int
    failures: tuple[RunFailure, ...]
    size_bytes: int
    ledger: Mapping[str, Total]


def contents_of(database: Database) -> Contents:
    """Contents of a store.

    Raises:
        EvidenceError: It is damaged or cannot be read.
    """
    with database.transaction("DEFERRED"):
        return Contents(
            trials=tuple(trial_names(database)),
            pieces={_kind(database, kind): int(n) for kind, n in database.rows(_PIECES)},
            inputs=int(database.rows("SELECT count(*) FROM inputs")[0][0]),
            failures=tuple(
                FAILURES.value(row, database.name) for row in database.rows(f"{FAILURES.select} ORDER BY key")
            ),
            size_bytes=database.size_bytes(),
            ledger=recorded(database.connection),
        )


def trial_names(database: Database) -> Iterator[TrialName]:
    """Index entry of each trial, in the order of the keys.

    Raises:
        EvidenceError: A row is damaged, or the file cannot be read.
    """
    for key, variant, seed, fidelity, size in database.rows(_NAMES):
        if not (is_digest(key) and type(variant) is int and type(seed) is int and fidelity in _FIDELITIES):
            raise _refusal(database, "a trial has an invalid key, variant, seed or fidelity")
        yield TrialName(key=key, variant=variant, seed=seed, fidelity=fidelity, size_bytes=int(size))


def _kind(database: Database, kind: object) -> str:
    if kind not in _KINDS:
        raise _refusal(database, "a piece has an unknown kind")
    return str(kind)


def _refusal(database: Database, problem: str) -> EvidenceError:
    hint = "run 'rgss evidence verify' to find it, and with --mend to remove it"
    return EvidenceError(f"{database.name}: {problem}", hint=hint)


_FIDELITIES = frozenset(fidelity.value for fidelity in Fidelity)
_KINDS = frozenset(kind.value for kind in PieceKind)
_NAMES = """SELECT key, variant, seed, fidelity, length(record) + length(provenance) FROM trials ORDER BY key"""
_PIECES = "SELECT kind, count(*) FROM pieces GROUP BY kind ORDER BY kind"
