"""Differences between two values, named by their places."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

ABSENT = "–"
_NOTHING = frozenset({ABSENT, "None", "''", "[]", "{}"})
"""Texts of values that are as good as absent: a later release may have more inputs, which are not used with these."""

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
    """Every value that differs, by its dotted name, in the order of the values, and then every list in another order.

    Args:
        then: Plain data: mappings, lists, texts, numbers.
        now: The same as it is now.
    """
    before, after = values_by_name(then), values_by_name(now)
    values = (
        Change(name=name, then=before.get(name, ABSENT), now=after.get(name, ABSENT))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    )
    return (*values, *_reordered(then, now, ""))


def input_changes(then: Any, now: Any) -> tuple[Change, ...]:
    """Inputs that differ, as `changes_between` has them; one that is None or empty is the same as one that is absent.

    Args:
        then: Former inputs, as plain data.
        now: The present ones.
    """
    return tuple(
        change
        for change in changes_between(then, now)
        if not (ABSENT in (change.then, change.now) and {change.then, change.now} <= _NOTHING)
    )


def values_by_name(value: Any) -> dict[str, str]:
    """Every value by its dotted name, as text.

    Args:
        value: Plain data: mappings, lists, texts, numbers.
    """
    return dict(_leaves(value, ""))


def _reordered(then: Any, now: Any, name: str) -> Iterator[Change]:
    """Lists of the same named entries in another order, each with the entries whose position changed."""
    if isinstance(then, Mapping) and isinstance(now, Mapping):
        for key in then:
            if key in now:
                yield from _reordered(then[key], now[key], f"{name}.{key}" if name else str(key))
    elif _is_list(then) and _is_list(now):
        before, after = _by_title(then), _by_title(now)
        if before.keys() == after.keys():
            moved = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
            if moved:
                was, is_now = (", ".join(titles) for titles in zip(*moved, strict=True))
                yield Change(name=f"order of {name}", then=was, now=is_now)
        for title in before:
            if title in after:
                yield from _reordered(before[title], after[title], f"{name}[{title}]")


def _is_list(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str)


def _by_title(items: Sequence[Any]) -> dict[str, Any]:
    return {_title(item, index): item for index, item in enumerate(items)}


def _leaves(value: Any, name: str) -> Iterator[tuple[str, str]]:
    """Leaves of nested data by path; empty containers are leaves too."""
    if value and isinstance(value, Mapping):
        for key, item in value.items():
            yield from _leaves(item, f"{name}.{key}" if name else str(key))
    elif value and _is_list(value):
        for index, item in enumerate(value):
            yield from _leaves(item, f"{name}[{_title(item, index)}]")
    else:
        yield name, repr(value)


def _title(item: Any, index: int) -> str:
    """Title of an entry: its name, or its position where it has none."""
    if isinstance(item, Mapping):
        return str(next((item[title] for title in _TITLES if title in item), index))
    return str(index)
