"""Positions of the keys and values of a file by location."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

Location = tuple["str | int", ...]
"""Keys and indices from the top of a file, such as ``("bodies", 2, "mass")``."""

Position = tuple[int, int]
"""Line and column, from 1."""


Mark = int
"""A position as one integer: a file has hundreds of thousands, which the garbage collector does not track."""

_COLUMN_BITS = 32


def mark_of(line: int, column: int) -> Mark:
    """Mark of a line and a column, both from 0, as counted by the parser."""
    return line << _COLUMN_BITS | column


def position_of(mark: Mark) -> Position:
    """Line and column, from 1, of a mark."""
    return (mark >> _COLUMN_BITS) + 1, (mark & ((1 << _COLUMN_BITS) - 1)) + 1


@dataclass(frozen=True, slots=True)
class ListPlaces:
    """Positions of a list and its entries."""

    mark: Mark
    inner: list[Places]


@dataclass(frozen=True, slots=True)
class MappingPlaces:
    """Positions of a mapping, its keys and their values."""

    mark: Mark
    keys: dict[str, Mark]
    inner: dict[str, Places]


Places = ListPlaces | MappingPlaces | Mark
"""Positions of a value and everything in it, in the shape of the value itself."""


class _Positions(Mapping[Location, Position]):
    """Positions of the parts of a file by their locations."""

    def __init__(self, places: Places, end: Callable[[], Position]) -> None:
        """Positions of a whole file."""
        self._places = places
        self._end = end

    def __len__(self) -> int:
        return sum(1 for _ in self)


class ValuePositions(_Positions):
    """Position of the value at each location."""

    def __getitem__(self, location: Location) -> Position:
        return min(position_of(_mark_of(_places_at(self._places, location))), self._end())

    def __iter__(self) -> Iterator[Location]:
        return (location for location, _ in _walk(self._places))


class KeyPositions(_Positions):
    """Position of the key at each location within a mapping."""

    def __getitem__(self, location: Location) -> Position:
        around = _places_at(self._places, location[:-1])
        key = location[-1] if location else None
        if not isinstance(around, MappingPlaces) or not isinstance(key, str):
            raise KeyError(location)
        return min(position_of(around.keys[key]), self._end())

    def __iter__(self) -> Iterator[Location]:
        return (location for location, has_key in _walk(self._places) if has_key)


def _places_at(places: Places, location: Location) -> Places:
    for part in location:
        found = _inner(places, part)
        if found is None:
            raise KeyError(location)
        places = found
    return places


def _inner(places: Places, part: str | int) -> Places | None:
    if isinstance(places, MappingPlaces):
        return places.inner.get(part) if isinstance(part, str) else None
    if isinstance(places, ListPlaces) and isinstance(part, int) and 0 <= part < len(places.inner):
        return places.inner[part]
    return None


def _mark_of(places: Places) -> Mark:
    return places.mark if isinstance(places, (ListPlaces, MappingPlaces)) else places


def _walk(places: Places) -> Iterator[tuple[Location, bool]]:
    """All locations in the file's order, each with True if it has a key."""
    pending: list[tuple[Location, bool, Places]] = [((), False, places)]
    while pending:
        location, has_key, here = pending.pop()
        yield location, has_key
        if isinstance(here, MappingPlaces):
            pending += reversed([((*location, name), True, inner) for name, inner in here.inner.items()])
        elif isinstance(here, ListPlaces):
            pending += reversed([((*location, index), False, inner) for index, inner in enumerate(here.inner)])
