"""Keys and digests of evidence: of the inputs of a trial, and of its record."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Mapping
from typing import Any

from rgss.documents import digest
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence.records.codec import record_to_json
from rgss.evidence.records.records import TrialRecord

_DIGEST = re.compile(r"[0-9a-f]{64}")


def trial_key(inputs: Mapping[str, Any]) -> str:
    """Key of a trial: SHA-256 of all inputs of its result.

    Args:
        inputs: Digests of the trial's inputs and versions of the code and engines, by name.

    Raises:
        EvidenceError: An input has no canonical form, such as NaN.
    """
    try:
        return digest(inputs)
    except DefinitionError as error:
        raise EvidenceError(f"no key for a trial: {error.message}", hint=error.hint) from error


def record_digest(record: TrialRecord) -> str:
    """SHA-256 of a record's canonical JSON; equal only for bitwise equal numbers.

    Raises:
        EvidenceError: The record cannot be written.
    """
    return text_digest(record_to_json(record))


def text_digest(text: str) -> str:
    """SHA-256 of a text, as 64 hexadecimal digits."""
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def is_digest(text: object) -> bool:
    """True if a text is a SHA-256 in 64 lower-case hexadecimal digits."""
    return isinstance(text, str) and _DIGEST.fullmatch(text) is not None
