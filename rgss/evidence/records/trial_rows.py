"""Trials as rows of the store, sealed on writing and verified on reading."""

from __future__ import annotations

from dataclasses import dataclass

from rgss.documents import digest
from rgss.errors import EvidenceError
from rgss.evidence.records.codec import record_from_json, record_to_json
from rgss.evidence.records.digests import is_digest, text_digest
from rgss.evidence.records.packing import pack, unpack
from rgss.evidence.records.provenance import Provenance, provenance_from_json, provenance_to_json
from rgss.evidence.records.records import TrialRecord
from rgss.findings import shown


@dataclass(frozen=True, slots=True, kw_only=True)
class StoredTrial:
    """Stored trial.

    Attributes:
        key: SHA-256 of the trial's inputs.
        content_digest: SHA-256 of the record's canonical JSON.
        record: Its record.
        provenance: Its provenance.
    """

    key: str
    content_digest: str
    record: TrialRecord
    provenance: Provenance


TrialRow = tuple[str, int, int, str, str, str, bytes, bytes]


def trial_row(key: str, record: TrialRecord, provenance: Provenance) -> TrialRow:
    """Row of a trial: key, variant, seed, fidelity, digest, seal, packed record and provenance.

    Raises:
        EvidenceError: The key or the record is malformed.
    """
    require_key(key)
    text, origin = record_to_json(record), provenance_to_json(provenance)
    for name, number in (("variant", record.variant), ("seed", record.seed)):
        if abs(number) >= 2**63:
            raise EvidenceError(f"record.{name} is beyond 64 bits: {shown(number)}")
    content = text_digest(text)
    return (
        key,
        record.variant,
        record.seed,
        record.fidelity.value,
        content,
        _seal(key, content, origin),
        pack(text, "record"),
        pack(origin, "provenance"),
    )


def read_trial(row: tuple[object, ...]) -> StoredTrial:
    """Trial from a row of `trial_row`.

    Raises:
        EvidenceError: It is not as it was made; the message names the problem.
    """
    key, variant, seed, fidelity, content, seal, packed_record, packed_provenance = row
    if not (is_digest(key) and isinstance(key, str)):
        raise EvidenceError("its key is none")
    text, origin = unpack(packed_record, "record"), unpack(packed_provenance, "provenance")
    if text_digest(text) != content:
        raise EvidenceError("its record is not the one that was put")
    if _seal(key, str(content), origin) != seal:
        raise EvidenceError("its record or provenance belongs to another row")
    record, provenance = record_from_json(text), provenance_from_json(origin)
    if (variant, seed, fidelity) != (record.variant, record.seed, record.fidelity.value):
        raise EvidenceError("it is filed under another variant, seed or fidelity than its record has")
    return StoredTrial(key=key, content_digest=str(content), record=record, provenance=provenance)


def require_key(key: object) -> None:
    """Require a valid key of a trial.

    Raises:
        EvidenceError: The value is not a SHA-256.
    """
    if not is_digest(key):
        raise EvidenceError(f"the key of a trial must be a SHA-256, got {shown(key)}", hint="compute it with trial_key")


def _seal(key: str, content: str, provenance: str) -> str:
    """Seal of a row: a digest that binds its columns to each other."""
    return digest([key, content, provenance])
