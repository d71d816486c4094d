"""Named inputs of trials, stored once by content, for later reports of changes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from rgss.documents import canonical_json
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence.records.codec import plain_json
from rgss.evidence.records.digests import is_digest, text_digest
from rgss.evidence.records.packing import pack, unpack


@dataclass(frozen=True, slots=True, kw_only=True)
class TrialInputs:
    """Named inputs of trials.

    Attributes:
        digest: Their key in the store.
        values: The inputs by name: plain data.
    """

    digest: str
    values: Mapping[str, Any]


def inputs_digest(inputs: Mapping[str, Any]) -> str:
    """Key of named inputs in the store: the SHA-256 of their canonical JSON.

    Raises:
        EvidenceError: The inputs are not plain data.
    """
    return text_digest(_text(inputs))


def inputs_row(inputs: Mapping[str, Any]) -> tuple[str, bytes]:
    """Row of named inputs: their digest and their packed text.

    Raises:
        EvidenceError: The inputs are not plain data, or too long.
    """
    text = _text(inputs)
    return text_digest(text), pack(text, "inputs")


def read_inputs(row: tuple[object, ...]) -> TrialInputs:
    """Named inputs from a row of `inputs_row`.

    Raises:
        EvidenceError: It is not as it was made; the message names the problem.
    """
    name, content = row
    if not (is_digest(name) and isinstance(name, str)):
        raise EvidenceError("its digest is none")
    text = unpack(content, "content")
    if text_digest(text) != name:
        raise EvidenceError("its content is not the one that was put")
    data = plain_json(text, "content")
    if not isinstance(data, dict):
        raise EvidenceError("its content is not a mapping")
    return TrialInputs(digest=name, values=data)


def _text(inputs: Mapping[str, Any]) -> str:
    try:
        text = canonical_json(inputs)
    except DefinitionError as error:
        raise EvidenceError(f"the inputs cannot be written: {error.message}", hint=error.hint) from error
    if not isinstance(inputs, Mapping):
        raise EvidenceError("the inputs cannot be written: they are not a mapping")
    return text
