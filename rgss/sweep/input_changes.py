"""Differences between two values, named by their places."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

ABSENT = "–"
_TITLES = ("phase", "subtask", "id", "name")


@dataclass(frozen=True, slots=True, kw_only=True)
class Change:
    """Change of an input.

    Attributes:
        name: Name of the input.
        then: Its former value, as text.
        now: Its present value, as text.
    """

    name: str
    then: str
    now: str


def changes_between(then: Any, now: Any) -> tuple[Change, ...]:
    """Every value that differs, by its dotted name, in the order of the values.

    Args:
        then: Plain data: mappings, lists, texts, numbers.
        now: The same as it is now.
    """
    before, after = values_by_name(then), values_by_name(now)
    return tuple(
        Change(name=name, then=before.get(name, ABSENT), now=after.get(name, ABSENT))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    )


def values_by_name(value: Any) -> dict[str, str]:
    """Every value by its dotted name, as text.

    Args:
        value: Plain data: mappings, lists, texts, numbers.
    """
    return dict(_leaves(value, ""))


def _leaves(value: Any, name: str) -> Iterator[tuple[str, str]]:
    """Leaves of nested data by path; empty containers are leaves too."""
    if value and isinstance(value, Mapping):
        for key, item in value.items():
            yield from _leaves(item, f"{name}.{key}" if name else str(key))
    elif value and isinstance(value, Sequence) and not isinstance(value, str):
        for index, item in enumerate(value):
            yield from _leaves(item, f"{name}[{_title(item, index)}]")
    else:
        yield name, repr(value)


def _title(item: Any, index: int) -> str:
    """Title of an entry: its name, or its position where it has none."""
    if isinstance(item, Mapping):
        return str(next((item[title] for title in _TITLES if title in item), index))
    return str(index)
