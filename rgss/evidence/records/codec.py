"""Records as JSON texts, read back strictly: a damaged text gives an error."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import lru_cache
from types import MappingProxyType
from typing import Any, NoReturn, TypeVar

from rgss.documents import canonical_json
from rgss.errors import DefinitionError, EvidenceError
from rgss.evidence.records.packing import LARGEST_TEXT
from rgss.evidence.records.readers import MismatchError, reader_of
from rgss.evidence.records.records import TrialRecord

_LONGEST_INTEGER = 1000
"""Digits of the longest integer that is read: the time for it grows with their square."""

Value = TypeVar("Value")

_WHERE_VARIED: Mapping[str, object] = MappingProxyType({"workload": "", "draws": {}})
"""Keys that a record has only where something was drawn, with their defaults elsewhere."""


def record_to_json(record: TrialRecord) -> str:
    """Write a record as canonical JSON.

    The record is compared with what its text reads back as, so that nothing is written that
    could not be read: a value of the wrong type, or one that is not finite.

    Raises:
        EvidenceError: The record has such a value.
    """
    data = _plain(record)
    for name, default in _WHERE_VARIED.items():
        if data[name] == default:
            del data[name]
    try:
        text = canonical_json(data)
    except DefinitionError as error:
        raise EvidenceError(f"the record cannot be written: {error.message}", hint=error.hint) from error
    record_from_json(text)
    return text


def record_from_json(text: str) -> TrialRecord:
    """Read a record that `record_to_json` wrote.

    Raises:
        EvidenceError: The text is not such a record; the message names the part that is wrong.
    """
    data = _loaded(text, "record", float)
    if isinstance(data, dict):
        for name, default in _WHERE_VARIED.items():
            if name in data and data[name] == default:
                raise EvidenceError(f"record.{name} is empty, and then is left out")
        data = {**_WHERE_VARIED, **data}
    return read_plain(data, TrialRecord, "record")


def read_json(text: str, kind: type[Value], name: str) -> Value:
    """Read a JSON text as a type: a dataclass, enumeration, mapping, tuple, union or plain type.

    Nothing is coerced and nothing left out: every field must be there, and no other.

    Args:
        text: The text.
        kind: What it should be.
        name: Its name in messages.

    Raises:
        EvidenceError: It is something else.
    """
    # Whether its floats are finite is checked by type, where their location is known.
    return read_plain(_loaded(text, name, float), kind, name)


def read_plain(data: Any, kind: type[Value], name: str) -> Value:
    """Read plain data, as JSON gives it, as a type; see `read_json`.

    Raises:
        EvidenceError: It is something else.
    """
    try:
        return reader_of(kind)(data)  # type: ignore[no-any-return, arg-type]
    except MismatchError as error:
        raise error.as_error(name) from None


def plain_json(text: str, name: str) -> Any:
    """Read a JSON text as plain data: its numbers finite, no key twice.

    Args:
        text: The text.
        name: Its name in messages.

    Raises:
        EvidenceError: It is too long or no such JSON.
    """
    return _loaded(text, name, _finite_number)


def _loaded(text: str, name: str, parse_float: Callable[[str], float]) -> Any:
    if len(text) > LARGEST_TEXT:
        raise EvidenceError(f"the {name} has {len(text)} characters; at most {LARGEST_TEXT} are read")
    try:
        return _decoder(parse_float).decode(text)
    except (ValueError, RecursionError) as error:
        raise EvidenceError(f"the {name} is not JSON: {str(error).splitlines()[0][:100]}") from error


@lru_cache(maxsize=2)
def _decoder(parse_float: Callable[[str], float]) -> json.JSONDecoder:
    return json.JSONDecoder(
        object_pairs_hook=_without_duplicates,
        parse_constant=_refuse_constant,
        parse_int=_bounded_integer,
        parse_float=parse_float,
    )


def _plain(value: Any) -> Any:
    if is_dataclass(value) and not isinstance(value, type):
        return {name: _plain(getattr(value, name)) for name in _field_names(type(value))}
    if isinstance(value, (tuple, list)):
        return [_plain(item) for item in value]
    return value


@lru_cache(maxsize=64)
def _field_names(kind: type) -> tuple[str, ...]:
    return tuple(field.name for field in fields(kind))


def _without_duplicates(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    mapping = dict(pairs)
    if len(mapping) < len(pairs):
        raise ValueError("a key occurs twice")
    return mapping


def _bounded_integer(text: str) -> int:
    if len(text) > _LONGEST_INTEGER:
        raise ValueError(f"an integer has {len(text)} digits")
    return int(text)


def _finite_number(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        _refuse_constant(text[:20])
    return number


def _refuse_constant(text: str) -> NoReturn:
    raise ValueError(f"{text} is not a finite number")
