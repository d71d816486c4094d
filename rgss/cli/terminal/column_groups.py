"""Division of a table that is wider than the terminal into groups of columns."""

from __future__ import annotations

from collections.abc import Sequence

GAP = 2
"""Spaces between two columns."""
_MOST_WRAPPED = 0.6
"""Least width of a column as a share of its longest cell, at which words seldom need more than two lines."""


def column_groups(
    cells: Sequence[Sequence[str]], width: int, *, keys: int = 1
) -> tuple[tuple[tuple[int, ...], tuple[int, ...]], ...]:
    """Columns of each part of a table, with their widths.

    Either all columns are printed side by side, with cells wrapped at spaces, or the table is divided into
    parts below each other, each of which repeats the key columns. The layout with fewer lines is taken. A
    column that is too wide by itself is wrapped in any case.

    Args:
        cells: The rows, the heads first; all have the same number of cells.
        width: The characters of a line.
        keys: Number of key columns, the first ones, which every part repeats.
    """
    natural = [max(len(row[column]) for row in cells) for column in range(len(cells[0]))]
    every = tuple(range(len(natural)))
    if _total(natural) <= width:
        return ((every, tuple(natural)),)
    ways = [_parts(natural, width, keys)]
    least = [max(map(_longest_word, column)) for column in zip(*cells, strict=True)]
    if _total(least) <= width:
        ways.append((every,))
    fitted = [tuple((part, _widths(natural, least, part, width)) for part in way) for way in ways]
    return min(fitted, key=lambda way: sum(_lines(cells, part, widths) for part, widths in way))


def columns_with_room(cells: Sequence[Sequence[str]], width: int, *, spare: Sequence[int]) -> tuple[int, ...]:
    """Columns of a table without those that may be omitted and for which a line has no room.

    Such a column is kept if its cells need two lines at most.

    Args:
        cells: The rows, the heads first; all have the same number of cells.
        width: The characters of a line.
        spare: Columns that may be omitted, the first one to omit last.
    """
    natural = [max(len(row[column]) for row in cells) for column in range(len(cells[0]))]
    kept = [column for column in range(len(natural)) if column not in spare]
    for column in spare:
        room = width - _total([natural[one] for one in kept]) - GAP
        if room < _MOST_WRAPPED * natural[column]:
            break
        natural[column] = min(natural[column], room)
        kept.append(column)
    return tuple(sorted(kept))


def _parts(natural: Sequence[int], width: int, keys: int) -> tuple[tuple[int, ...], ...]:
    """Parts whose columns fit unwrapped, if a part has more than one column beside the key columns."""
    first = tuple(range(min(keys, len(natural) - 1)))
    parts: list[tuple[int, ...]] = []
    part = first
    for column in range(len(first), len(natural)):
        if part != first and _total([natural[one] for one in (*part, column)]) > width:
            parts.append(part)
            part = first
        part = (*part, column)
    return (*parts, part)


def _widths(natural: Sequence[int], least: Sequence[int], part: Sequence[int], width: int) -> tuple[int, ...]:
    """Widths of the columns of a part: the widest ones shrink first, down to their longest words."""
    given = [natural[column] for column in part]
    floors = [least[column] for column in part]
    if _total(floors) > width:
        # The longest words do not fit either: they are broken, the longest first.
        floors = [1] * len(part)
    while _total(given) > width:
        over = [place for place in range(len(part)) if given[place] > floors[place]]
        if not over:
            break
        widest = max(over, key=lambda place: (given[place], place))
        given[widest] -= 1
    return tuple(given)


def _lines(cells: Sequence[Sequence[str]], part: Sequence[int], widths: Sequence[int]) -> int:
    """The lines of a part, with its rule and an empty line at the end."""
    return 2 + sum(
        max(_broken(row[column], width) for column, width in zip(part, widths, strict=True)) for row in cells
    )


def _broken(text: str, width: int) -> int:
    """Lines of a text wrapped at spaces, and within words that are wider than a line."""
    if len(text) <= width:
        return 1
    lines, used = 1, 0
    for word in text.split():
        if used and used + 1 + len(word) > width:
            lines, used = lines + 1, 0
        used += len(word) + (1 if used else 0)
        lines, used = lines + max(0, used - 1) // width, (used - 1) % width + 1
    return lines


def _total(widths: Sequence[int]) -> int:
    return sum(widths) + GAP * (len(widths) - 1)


def _longest_word(text: str) -> int:
    return max(map(len, text.split()), default=0)
