"""Records as JSON texts, read back strictly: a damaged text gives an error, never a surprise."""

from __future__ import annotations

import json
import math
import types
from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import lru_cache
from typing import Any, NoReturn, TypeVar, Union, get_args, get_origin, get_type_hints

from rgss.documents.digests import canonical_json
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence.records import TrialRecord
from rgss.findings import shown

LARGEST_TEXT = 16 * 1024 * 1024
"""Characters of the longest text that is read."""

Value = TypeVar("Value")


def record_to_json(record: TrialRecord) -> str:
    """Write a record as canonical JSON.

    The record is compared with what its text reads back as, so that nothing is written that
    could not be read: a value of the wrong type, or one that is not finite.

    Raises:
        EvidenceError: The record has such a value.
    """
    try:
        text = canonical_json(_plain(record))
    except DefinitionError as error:
        raise EvidenceError(f"the record cannot be written: {error.message}", hint=error.hint) from error
    record_from_json(text)
    return text


def record_from_json(text: str) -> TrialRecord:
    """Read a record that `record_to_json` wrote.

    Raises:
        EvidenceError: The text is no such record; its message names the part that is wrong.
    """
    return read_json(text, TrialRecord, "record")


def read_json(text: str, kind: type[Value], name: str) -> Value:
    """Read a JSON text as a type: a dataclass, enumeration, mapping, tuple, union or plain type.

    Nothing is coerced and nothing left out: every field must be there, and no other.

    Args:
        text: The text.
        kind: What it should be.
        name: What to call it in messages.

    Raises:
        EvidenceError: It is something else.
    """
    if len(text) > LARGEST_TEXT:
        raise EvidenceError(f"the {name} has {len(text)} characters; at most {LARGEST_TEXT} are read")
    try:
        data = json.loads(text, object_pairs_hook=_without_duplicates, parse_constant=_refuse_constant)
    except (ValueError, RecursionError) as error:
        raise EvidenceError(f"the {name} is not JSON: {str(error).splitlines()[0][:100]}") from error
    return _read(data, kind, name)  # type: ignore[no-any-return]


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {field.name: _plain(getattr(value, field.name)) for field in fields(value)}
    if isinstance(value, (tuple, list)):
        return [_plain(item) for item in value]
    return value


def _read(data: Any, kind: Any, where: str) -> Any:
    origin = get_origin(kind)
    if origin in (Union, types.UnionType):
        return _read_union(data, get_args(kind), where)
    if origin is tuple:
        if not isinstance(data, list):
            raise _refusal(where, "a list", data)
        return tuple(_read(item, get_args(kind)[0], f"{where}[{index}]") for index, item in enumerate(data))
    if origin is Mapping:
        if not isinstance(data, dict):
            raise _refusal(where, "a mapping", data)
        return {key: _read(item, get_args(kind)[1], f"{where}.{key}") for key, item in data.items()}
    if is_dataclass(kind):
        return _read_dataclass(data, kind, where)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return _read_enum(data, kind, where)
    return _read_plain(data, kind, where)


def _read_dataclass(data: Any, kind: Any, where: str) -> Any:
    if not isinstance(data, dict):
        raise _refusal(where, "a mapping", data)
    kinds = _field_kinds(kind)
    wrong = [f"lacks {name!r}" for name in kinds if name not in data]
    wrong += [f"has an unknown {shown(name)}" for name in data if name not in kinds]
    if wrong:
        raise EvidenceError(f"{where} {wrong[0]}")
    return kind(**{name: _read(data[name], field, f"{where}.{name}") for name, field in kinds.items()})


@lru_cache(maxsize=64)
def _field_kinds(kind: type) -> Mapping[str, Any]:
    hints = get_type_hints(kind)
    return {field.name: hints[field.name] for field in fields(kind)}


def _read_union(data: Any, kinds: tuple[Any, ...], where: str) -> Any:
    for kind in kinds:
        if _could_be(data, kind):
            return _read(data, kind, where)
    if type(data) is int and float in kinds:
        return data
    raise _refusal(where, "one of " + ", ".join(_name(kind) for kind in kinds), data)


def _could_be(data: Any, kind: Any) -> bool:
    """Tell whether a value has the outer type of a kind; what is within it is read later."""
    if get_origin(kind) is tuple:
        return isinstance(data, list)
    if isinstance(kind, type) and issubclass(kind, Enum):
        return isinstance(data, str)
    if get_origin(kind) is Mapping or is_dataclass(kind):
        return isinstance(data, dict)
    return type(data) is kind


def _read_enum(data: Any, kind: type[Enum], where: str) -> Enum:
    for member in kind:
        if type(data) is type(member.value) and data == member.value:
            return member
    raise _refusal(where, f"a {kind.__name__}", data)


def _read_plain(data: Any, kind: Any, where: str) -> Any:
    # A whole number may stand for a float; it stays one, for the digest tells 0 from 0.0.
    if type(data) is not kind and not (kind is float and type(data) is int):
        raise _refusal(where, _name(kind), data)
    if isinstance(data, float) and not math.isfinite(data):
        raise _refusal(where, "a finite number", data)
    return data


def _name(kind: Any) -> str:
    if get_origin(kind) is tuple:
        return "list"
    return "none" if kind is type(None) else str(kind.__name__)


def _refusal(where: str, expected: str, data: Any) -> EvidenceError:
    return EvidenceError(f"{where} is not {expected}: {shown(data)}")


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    mapping = dict(pairs)
    if len(mapping) < len(pairs):
        raise ValueError("a key stands twice")
    return mapping


def _refuse_constant(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a finite number")
