"""Table of design variants that fits the width of a terminal."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

from rgss.findings import printable
from rgss.reports.plain_text import aligned_table

if TYPE_CHECKING:
    from rgss.designs import DesignParameter, DesignSpace, DesignVariant

WIDEST = 100
"""Characters of a line; JSON and CSV have every column by its full name, however wide."""

_GAP = 2


@dataclass(frozen=True, slots=True, kw_only=True)
class _Column:
    """Column: head and cells."""

    head: str
    cells: list[str]

    @property
    def width(self) -> int:
        return max(map(len, (printable(self.head), *map(printable, self.cells))))


def variant_table_lines(designs: DesignSpace, variants: Sequence[DesignVariant]) -> Iterator[str]:
    """Lines of a table of variants with their parameters.

    If the columns of the CSV file fit, these are shown. Otherwise constant parameters are listed below
    the table, and if necessary ids replace the names of the parameters, which are listed below too;
    columns that still do not fit are printed in another table.

    Args:
        designs: The design space, which determines the constant parameters.
        variants: The listed variants.
    """
    every = designs.expand()
    definitions = designs.parameters
    ids = _Column(head="id", cells=[str(variant.id) for variant in variants])
    whole = [_column(one, one.column, variants) for one in definitions]
    if not every or _fits(ids, whole):
        yield from _block_lines(ids, whole)
        return
    varying = [one for one in definitions if len({variant.parameters[one.id] for variant in every}) > 1]
    same = [f"{_name(one)} {_cell(every[0], one)}{_unit(one)}" for one in definitions if one not in varying]
    columns = [_column(one, one.column, variants) for one in varying]
    notes = []
    if not _fits(ids, columns):
        columns = [_column(one, f"{one.id} [{one.unit}]" if _unit(one) else one.id, variants) for one in varying]
        notes = [_listed(map(_name, varying))]
    if same:
        notes.append(f"The same in all designs: {_listed(same)}")
    yield from _block_lines(ids, columns)
    yield ""
    yield from notes


def _block_lines(ids: _Column, columns: Sequence[_Column]) -> Iterator[str]:
    for number, block in enumerate(_blocks(ids, columns)):
        if number:
            yield ""
        shown = [ids, *block]
        rows = zip(*(column.cells for column in shown), strict=True)
        yield from aligned_table([column.head for column in shown], rows, right=range(len(shown)))


def _blocks(ids: _Column, columns: Sequence[_Column]) -> list[list[_Column]]:
    """The columns in tables that fit, each with at least one."""
    blocks: list[list[_Column]] = [[]]
    for column in columns:
        if blocks[-1] and not _fits(ids, [*blocks[-1], column]):
            blocks.append([])
        blocks[-1].append(column)
    return blocks


def _listed(texts: Iterable[str]) -> str:
    return ", ".join(map(printable, texts))


def _fits(ids: _Column, columns: Sequence[_Column]) -> bool:
    return ids.width + sum(_GAP + column.width for column in columns) <= WIDEST


def _column(definition: DesignParameter, head: str, variants: Sequence[DesignVariant]) -> _Column:
    return _Column(head=head, cells=[_cell(variant, definition) for variant in variants])


def _cell(variant: DesignVariant, definition: DesignParameter) -> str:
    value = variant.parameters[definition.id]
    return f"{value:g}" if isinstance(value, float) else str(value)


def _name(definition: DesignParameter) -> str:
    name = definition.name.replace("_", " ")
    return name if definition.name == definition.id else f"{definition.id} {name}"


def _unit(definition: DesignParameter) -> str:
    return "" if definition.unit in ("", "1") else f" {definition.unit}"
