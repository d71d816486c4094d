"""Canonical JSON and its SHA-256 digest, used for keys of evidence and variants."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping, Sequence
from enum import Enum
from typing import Any

from rgss.errors import DefinitionError

DEEPEST_NESTING = 60


def canonical_json(value: Any) -> str:
    """Canonical JSON text of plain data.

    Keys are sorted, floats are written by ``repr`` (so that every bit counts, and ``1`` differs from ``1.0``), and the
    text is pure ASCII without spaces. It depends neither on the order of a mapping nor on the process.

    Args:
        value: None, truth values, numbers, texts, enumerations of these, lists or tuples,
            and mappings from texts.

    Raises:
        DefinitionError: A part is of another kind, is not finite, or is nested too deep.
    """
    try:
        plain = _plain(value, 0)
    except _NoCanonicalFormError as error:
        name = error.where.lstrip(".") or "the value"
        raise DefinitionError(
            f"{name} {error.problem} and has no canonical form", hint="use finite numbers, texts, lists and mappings"
        ) from None
    return json.dumps(plain, sort_keys=True, separators=(",", ":"), ensure_ascii=True, allow_nan=False)


def digest(value: Any) -> str:
    """SHA-256 of the canonical JSON of plain data, as 64 hexadecimal digits.

    Raises:
        DefinitionError: As `canonical_json`.
    """
    return hashlib.sha256(canonical_json(value).encode("ascii")).hexdigest()


class _NoCanonicalFormError(Exception):
    """A part has no canonical form; its location is collected while it propagates."""

    def __init__(self, problem: str) -> None:
        super().__init__(problem)
        self.problem = problem
        self.where = ""


def _plain(value: Any, depth: int) -> Any:
    if depth > DEEPEST_NESTING:
        raise _NoCanonicalFormError(f"is nested more than {DEEPEST_NESTING} deep")
    kind = type(value)
    if kind is str or kind is int or kind is bool or value is None:
        return value
    if kind is float:
        return _finite(value)
    if kind is dict:
        return _plain_mapping(value, depth)
    if kind is list or kind is tuple:
        return _plain_list(value, depth)
    return _plain_other(value, depth)


def _plain_other(value: Any, depth: int) -> Any:
    """Value of a type derived from or equivalent to a JSON type."""
    if isinstance(value, Enum):
        value = value.value
    if value is None or isinstance(value, (bool, str)):
        return value
    if isinstance(value, int):
        return int(value)
    if isinstance(value, float):
        return float(_finite(value))
    if isinstance(value, (list, tuple)):
        return _plain_list(value, depth)
    if isinstance(value, Mapping):
        return _plain_mapping(value, depth)
    raise _NoCanonicalFormError(f"is of type {type(value).__name__}")


def _finite(value: float) -> float:
    if not math.isfinite(value):
        raise _NoCanonicalFormError(f"is {float(value)!r}")
    return value


def _plain_list(value: Sequence[Any], depth: int) -> list[Any]:
    items: list[Any] = []
    try:
        for item in value:
            items.append(_plain(item, depth + 1))  # noqa: PERF401 - its length locates the problem
    except _NoCanonicalFormError as error:
        error.where = f"[{len(items)}]{error.where}"
        raise
    return items


def _plain_mapping(value: Mapping[Any, Any], depth: int) -> dict[str, Any]:
    items: dict[str, Any] = {}
    key: Any = None
    for key, item in value.items():
        # A numeric key would be written as a text and could collide with the same text.
        if not isinstance(key, str) or isinstance(key, Enum):
            raise _NoCanonicalFormError(f"has the key {key!r}, which is not a text")
        try:
            items[key] = _plain(item, depth + 1)
        except _NoCanonicalFormError as error:
            error.where = f".{key}{error.where}"
            raise
    return items
