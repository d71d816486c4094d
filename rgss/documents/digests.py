"""One text for one content, and its SHA-256: what evidence and variants are keyed by."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from enum import Enum
from typing import Any

from rgss.errors import DefinitionError

DEEPEST_NESTING = 60


def canonical_json(value: Any) -> str:
    """Write plain data as the one JSON text that stands for it.

    Keys are sorted, floats are written by ``repr`` (so that every bit of them counts, and
    ``1`` differs from ``1.0``), the text is pure ASCII and has no spaces. It depends on
    neither the order of a mapping nor the process that writes it.

    Args:
        value: None, truth values, numbers, texts, enumerations of these, lists or tuples,
            and mappings from texts.

    Raises:
        DefinitionError: A part is of another kind, is not finite, or is nested too deep.
    """
    return json.dumps(_plain(value, "", 0), sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)


def digest(value: Any) -> str:
    """The SHA-256 of the canonical JSON of plain data, as 64 hexadecimal digits.

    Raises:
        DefinitionError: As `canonical_json`.
    """
    return hashlib.sha256(canonical_json(value).encode("ascii")).hexdigest()


def _plain(value: Any, where: str, depth: int) -> Any:
    if depth > DEEPEST_NESTING:
        raise _refusal(where, f"is nested more than {DEEPEST_NESTING} deep")
    if isinstance(value, Enum):
        value = value.value
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        if not math.isfinite(value):
            raise _refusal(where, f"is {float(value)!r}")
        return float(value)
    if isinstance(value, (list, tuple)):
        return [_plain(item, f"{where}[{index}]", depth + 1) for index, item in enumerate(value)]
    if isinstance(value, Mapping):
        return {_key(key, where): _plain(item, f"{where}.{key}", depth + 1) for key, item in value.items()}
    raise _refusal(where, f"is of type {type(value).__name__}")


def _key(key: Any, where: str) -> str:
    # A number as a key would be written as a text and could then meet the same text.
    if not isinstance(key, str) or isinstance(key, Enum):
        raise _refusal(where, f"has the key {key!r}, which is not a text")
    return key


def _refusal(where: str, problem: str) -> DefinitionError:
    name = where.lstrip(".") or "the value"
    return DefinitionError(
        f"{name} {problem} and has no canonical form", hint="use finite numbers, texts, lists and mappings"
    )
