"""Where a record comes from."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.documents.digests import canonical_json
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence.codec import read_json


@dataclass(frozen=True, slots=True, kw_only=True)
class Provenance:
    """What went into a trial.

    Attributes:
        inputs: SHA-256 of each of its inputs by name: ``plan``, ``timing``, ``execution``,
            ``variant``.
        versions: Version of the code and of each engine by name.
    """

    inputs: Mapping[str, str]
    versions: Mapping[str, str]


def provenance_to_json(provenance: Provenance) -> str:
    """Write a provenance as canonical JSON.

    Raises:
        EvidenceError: It holds something else than texts.
    """
    try:
        text = canonical_json({"inputs": provenance.inputs, "versions": provenance.versions})
    except DefinitionError as error:
        raise EvidenceError(f"the provenance cannot be written: {error.message}", hint=error.hint) from error
    provenance_from_json(text)
    return text


def provenance_from_json(text: str) -> Provenance:
    """Read a provenance that `provenance_to_json` wrote.

    Raises:
        EvidenceError: The text is no such provenance.
    """
    return read_json(text, Provenance, "provenance")
