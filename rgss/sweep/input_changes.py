"""Differences between two values, named by their places."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import dataclass
from typing import Any

ABSENT = "–"
_NOTHING = frozenset({ABSENT, "None", "''", "[]", "{}"})
"""Texts of values that are as good as absent: a later release may have more inputs, which are not used with these."""

Path = tuple[Any, ...]
"""Keys and titles that lead to a part of nested data."""

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
    same = frozenset(_unchanged(then, now, ()))
    before, after = dict(_leaves(then, "", same)), dict(_leaves(now, "", same))
    values = (
        Change(name=name, then=before.get(name, ABSENT), now=after.get(name, ABSENT))
        for name in dict.fromkeys([*before, *after])
        if before.get(name) != after.get(name)
    )
    return (*values, *_reordered(then, now, "", same))


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


def _reordered(then: Any, now: Any, name: str, left_out: Set[Path], path: Path = ()) -> Iterator[Change]:
    """Lists of the same named entries in another order, each with the entries whose position changed."""
    if path in left_out:
        return
    if isinstance(then, Mapping) and isinstance(now, Mapping):
        for key in then:
            if key in now:
                yield from _reordered(
                    then[key], now[key], f"{name}.{key}" if name else str(key), left_out, (*path, key)
                )
    elif _is_list(then) and _is_list(now):
        before, after = _by_title(then), _by_title(now)
        if before.keys() == after.keys():
            moved = [pair for pair in zip(before, after, strict=True) if pair[0] != pair[1]]
            if moved:
                was, is_now = (", ".join(titles) for titles in zip(*moved, strict=True))
                yield Change(name=f"order of {name}", then=was, now=is_now)
        for title in before:
            if title in after:
                yield from _reordered(before[title], after[title], f"{name}[{title}]", left_out, (*path, title))


def _is_list(value: Any) -> bool:
    return isinstance(value, Sequence) and not isinstance(value, str)


def _by_title(items: Sequence[Any]) -> dict[str, Any]:
    return {_title(item, index): item for index, item in enumerate(items)}


def _unchanged(then: Any, now: Any, path: Path) -> Iterator[Path]:
    """Paths below which both are the same, as most of the inputs of a trial are."""
    if _are_same(then, now):
        yield path
    elif isinstance(then, Mapping) and isinstance(now, Mapping):
        for key in then:
            if key in now:
                yield from _unchanged(then[key], now[key], (*path, key))
    elif _is_list(then) and _is_list(now):
        before, after = _by_title(then), _by_title(now)
        # Entries of one title are one name; there all are looked at.
        if (len(before), len(after)) == (len(then), len(now)):
            for title in before:
                if title in after:
                    yield from _unchanged(before[title], after[title], (*path, title))


def _are_same(then: Any, now: Any) -> bool:
    """True if all values are equal and of the same types, whatever the order of keys."""
    return bool(then == now) and _sorted_text(then) == _sorted_text(now)


def _sorted_text(value: Any) -> str:
    return json.dumps(value, sort_keys=True, default=dict)


def _leaves(value: Any, name: str, left_out: Set[Path] = frozenset(), path: Path = ()) -> Iterator[tuple[str, str]]:
    """Leaves of nested data by name, without those below the paths that are left out; empty containers are leaves."""
    if path in left_out:
        return
    if value and isinstance(value, Mapping):
        for key, item in value.items():
            yield from _leaves(item, f"{name}.{key}" if name else str(key), left_out, (*path, key))
    elif value and _is_list(value):
        for index, item in enumerate(value):
            title = _title(item, index)
            yield from _leaves(item, f"{name}[{title}]", left_out, (*path, title))
    else:
        yield name, repr(value)


def _title(item: Any, index: int) -> str:
    """Title of an entry: its name, or its position where it has none."""
    if isinstance(item, Mapping):
        return str(next((item[title] for title in _TITLES if title in item), index))
    return str(index)
