"""Strict JSON serialisation of records; a damaged text raises an error."""

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
"""Greatest number of digits of an integer; the parsing time is quadratic in it."""

Value = TypeVar("Value")

_WHERE_VARIED: Mapping[str, object] = MappingProxyType({"workload": "", "draws": {}})
"""Keys present only in records with draws, with their defaults."""


def record_to_json(record: TrialRecord) -> str:
    """Record as canonical JSON.

    The text is read back and compared with the record, so that no text is written that could not be read, such as one
    with a value of a wrong type or a non-finite number.

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
    """Record from the output of `record_to_json`.

    Raises:
        EvidenceError: The text is not a record; the message names the invalid part.
    """
    data = _loaded(text, "record", float)
    if isinstance(data, dict):
        for name, default in _WHERE_VARIED.items():
            if name in data and data[name] == default:
                raise EvidenceError(f"record.{name} must be omitted if empty")
        data = {**_WHERE_VARIED, **data}
    return read_plain(data, TrialRecord, "record")


def read_json(text: str, kind: type[Value], name: str) -> Value:
    """Read a JSON text as a type: a dataclass, enumeration, mapping, tuple, union or plain type.

    Nothing is coerced; exactly the fields of the type are required.

    Args:
        text: The text.
        kind: The expected type.
        name: Its name in messages.

    Raises:
        EvidenceError: The text has another content.
    """
    # Finite floats are required by type, where their location is known.
    return read_plain(_loaded(text, name, float), kind, name)


def read_plain(data: Any, kind: type[Value], name: str) -> Value:
    """Read plain data from JSON as a type; see `read_json`.

    Raises:
        EvidenceError: The data are of another type.
    """
    try:
        return reader_of(kind)(data)  # type: ignore[no-any-return, arg-type]
    except MismatchError as error:
        raise error.as_error(name) from None


def plain_json(text: str, name: str) -> Any:
    """Read a JSON text as plain data, with finite numbers and without duplicate keys.

    Args:
        text: The text.
        name: Its name in messages.

    Raises:
        EvidenceError: The text is too long, or not such JSON.
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
