"""Provenance of a record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from types import MappingProxyType

from rgss.documents import canonical_json
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence.records.codec import plain_json, read_plain
from rgss.evidence.records.numerics import Numerics


@dataclass(frozen=True, slots=True, kw_only=True)
class Provenance:
    """Inputs of a trial, and the software that made it.

    Of these only the digests of the pieces are part of a trial's key; none is part of its record's digest.

    Attributes:
        inputs: SHA-256 of each of its pieces' inputs by name: ``plan``, ``timing``, ``execution``,
            ``trial``.
        versions: Version of the code and of each engine by name.
        inputs_digest: Key of the trial's named inputs in the store, for later reports of changes; empty if they were
        not stored.
        files: SHA-256 of each input file by its name in the project.
        revision: Revision of the code in version control; empty if unknown.
        machine: System, processor and Python version; empty if unknown.
        numerics: Numerics of the process, part by part; empty if not recorded.
        study: File of the study for which it was run first, by its name in the project; empty if not recorded.
    """

    inputs: Mapping[str, str]
    versions: Mapping[str, str]
    inputs_digest: str = ""
    files: Mapping[str, str] = field(default_factory=dict)
    revision: str = ""
    machine: str = ""
    numerics: Numerics = field(default_factory=dict)
    study: str = ""


_FIRST_FIELDS = {"inputs", "versions"}
"""Keys of a provenance of schema 1."""

_LATER_FIELDS: Mapping[str, object] = MappingProxyType(
    {"inputs_digest": "", "files": {}, "revision": "", "machine": "", "numerics": {}, "study": ""}
)
"""Keys added by later schemas, in order, with their defaults."""


def provenance_to_json(provenance: Provenance) -> str:
    """Provenance as canonical JSON.

    Raises:
        EvidenceError: A value is not a text.
    """
    try:
        text = canonical_json({each.name: getattr(provenance, each.name) for each in fields(provenance)})
    except DefinitionError as error:
        raise EvidenceError(f"the provenance cannot be written: {error.message}", hint=error.hint) from error
    provenance_from_json(text)
    return text


def provenance_from_json(text: str) -> Provenance:
    """Provenance from the output of `provenance_to_json`, also of earlier releases.

    Raises:
        EvidenceError: The text is not a provenance.
    """
    data = plain_json(text, "provenance")
    every = {*_FIRST_FIELDS, *_LATER_FIELDS}
    known_sets = (_FIRST_FIELDS, every - {"numerics", "study"}, every - {"study"})
    if isinstance(data, dict) and data.keys() in known_sets:
        data = {**_LATER_FIELDS, **data}
    return read_plain(data, Provenance, "provenance")
