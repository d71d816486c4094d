"""Strict readers of plain data by type, cached by type."""

from __future__ import annotations

import math
import sys
import types
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from functools import lru_cache
from typing import Any, Union, get_args, get_origin, get_type_hints

from rgss.errors import EvidenceError
from rgss.findings import shown

Reader = Callable[[Any], Any]


class MismatchError(Exception):
    """Type mismatch; its location is collected while it propagates."""

    def __init__(self, problem: str, data: str = "") -> None:
        super().__init__(problem)
        self._where = ""
        self._problem = problem
        self._data = data

    def within(self, part: str) -> MismatchError:
        """The mismatch with its location relative to the enclosing value."""
        self._where = part + self._where
        return self

    def as_error(self, name: str) -> EvidenceError:
        """Mismatch as an error, with the name of the whole value."""
        return EvidenceError(f"{name}{self._where} {self._problem}{self._data}")


@lru_cache(maxsize=256)
def reader_of(kind: Any) -> Reader:
    """Reader of a dataclass, enumeration, mapping, tuple, union or plain type.

    It returns the value, and raises `MismatchError` for data of another type: nothing is coerced, and exactly the
    fields of the type are required.
    """
    origin = get_origin(kind)
    if origin in (Union, types.UnionType):
        return _union_reader(get_args(kind))
    if origin is tuple:
        return _tuple_reader(reader_of(get_args(kind)[0]))
    if origin is Mapping:
        return _mapping_reader(reader_of(get_args(kind)[1]))
    if is_dataclass(kind) and isinstance(kind, type):
        hints = get_type_hints(kind)
        return _dataclass_reader(kind, {field.name: reader_of(hints[field.name]) for field in fields(kind)})
    if isinstance(kind, type) and issubclass(kind, Enum):
        return _enum_reader(kind)
    return _float_reader if kind is float else _plain_reader(kind)


def _tuple_reader(read_item: Reader) -> Reader:
    def read(data: Any) -> tuple[Any, ...]:
        if type(data) is not list:
            raise _refusal("a list", data)
        items: list[Any] = []
        try:
            for item in data:
                items.append(read_item(item))  # noqa: PERF401 - its length locates the problem
        except MismatchError as error:
            raise error.within(f"[{len(items)}]") from None
        return tuple(items)

    return read


def _mapping_reader(read_item: Reader) -> Reader:
    def read(data: Any) -> dict[str, Any]:
        if type(data) is not dict:
            raise _refusal("a mapping", data)
        key = ""
        found = {}
        try:
            for key, item in data.items():
                # Interned, since thousands of records have the same keys.
                found[sys.intern(key)] = read_item(item)
        except MismatchError as error:
            raise error.within(f".{key}") from None
        return found

    return read


def _dataclass_reader(kind: type, readers: Mapping[str, Reader]) -> Reader:
    names = readers.keys()

    def read(data: Any) -> Any:
        if type(data) is not dict:
            raise _refusal("a mapping", data)
        if data.keys() != names:
            wrong = [f"lacks {name!r}" for name in names if name not in data]
            wrong += [f"has an unknown {shown(name)}" for name in data if name not in names]
            raise MismatchError(wrong[0])
        name = ""
        values = {}
        try:
            for name, read_field in readers.items():
                values[name] = read_field(data[name])
        except MismatchError as error:
            raise error.within(f".{name}") from None
        return kind(**values)

    return read


def _enum_reader(kind: type[Enum]) -> Reader:
    members = {(type(member.value), member.value): member for member in kind}
    known = {type(member.value) for member in kind}

    def read(data: Any) -> Enum:
        found = members.get((type(data), data)) if type(data) in known else None
        if found is None:
            raise _refusal(f"a {kind.__name__}", data)
        return found

    return read


def _union_reader(kinds: tuple[Any, ...]) -> Reader:
    """Reader of a union, selected by the outer type of the data."""
    readers: dict[type, Reader] = {}
    for kind in kinds:
        readers.setdefault(_outer_type(kind), reader_of(kind))
    if float in kinds:
        readers.setdefault(int, reader_of(float))
    expected = "one of " + ", ".join(_name(kind) for kind in kinds)

    def read(data: Any) -> Any:
        read_choice = readers.get(type(data))
        if read_choice is None:
            raise _refusal(expected, data)
        return read_choice(data)

    return read


def _outer_type(kind: Any) -> type:
    if get_origin(kind) is tuple:
        return list
    if isinstance(kind, type) and issubclass(kind, Enum):
        return str
    if get_origin(kind) is Mapping or is_dataclass(kind):
        return dict
    return kind  # type: ignore[no-any-return]


def _float_reader(data: Any) -> float:
    # An integer is accepted as a float, but stays an integer, because the digest distinguishes 0 and 0.0.
    if type(data) is int:
        return data
    if type(data) is not float:
        raise _refusal("float", data)
    if not math.isfinite(data):
        raise _refusal("a finite number", data)
    return data


def _plain_reader(kind: Any) -> Reader:
    def read(data: Any) -> Any:
        if type(data) is not kind:
            raise _refusal(_name(kind), data)
        return data

    return read


def _name(kind: Any) -> str:
    if get_origin(kind) is tuple:
        return "list"
    return "none" if kind is type(None) else str(kind.__name__)


def _refusal(expected: str, data: Any) -> MismatchError:
    return MismatchError(f"is not {expected}: ", shown(data))
