"""Reviewed content of an element, and its digest."""

from __future__ import annotations

import dataclasses
from enum import Enum
from typing import Any

from rgss.documents import digest
from rgss.requirements.architecture import Behaviour, Block
from rgss.requirements.needs import StakeholderNeed
from rgss.requirements.requirement import Requirement

Element = StakeholderNeed | Requirement | Block | Behaviour
"""Any element with an id."""

_NOT_CONTENT = frozenset({"exempt"})


def content_digest_of(element: Element) -> str:
    """SHA-256 of the reviewed content: text, attributes and stated links of an element.

    Position in the file, line wrapping, order of ids under a key and exemptions are not content. Unset attributes are
    omitted, so that a new optional attribute does not change existing digests.
    """
    return digest({"element": type(element).__name__, "content": _content(element)})


def _content(value: Any) -> Any:
    if dataclasses.is_dataclass(value):
        names = [field.name for field in dataclasses.fields(value) if field.name not in _NOT_CONTENT]
        stated = {name: _content(getattr(value, name)) for name in names}
        return {name: part for name, part in stated.items() if not _is_open(part)}
    if isinstance(value, tuple):
        parts = [_content(part) for part in value]
        return sorted(parts) if all(isinstance(part, str) for part in parts) else parts
    if isinstance(value, Enum):
        return value.value
    return " ".join(value.split()) if isinstance(value, str) else value


def _is_open(part: Any) -> bool:
    # Not "not part": a threshold of 0 is stated.
    return part is None or part is False or part == "" or part == []
