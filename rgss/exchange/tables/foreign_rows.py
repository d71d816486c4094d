"""Rows of a table of another tool as elements."""

from __future__ import annotations

import re
import shlex
from collections import Counter
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace

from rgss.exchange.attributes import ATTRIBUTES, Part
from rgss.exchange.content import Row
from rgss.exchange.files import problem
from rgss.exchange.foreign_names import LINKED, PART, ForeignNames
from rgss.findings import Finding, Severity, shown

_BREAK = re.compile(r"\r\n?")
"""Line breaks within a cell, as programs of other systems write them."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForeignTable:
    """Known facts about a table of another tool.

    Attributes:
        names: The mapped names of its columns and values.
        part: Part of rows whose part neither the table nor the project states.
        known: Part of each element of the project, by id.
    """

    names: ForeignNames
    part: Part | None = None
    known: Mapping[str, Part] = field(default_factory=dict)


class ForeignRows:
    """Reader of rows, with a list of those that are not imported."""

    def __init__(self, table: ForeignTable) -> None:
        """Create a reader."""
        self._table = table
        self._lacking: Counter[str] = Counter()
        self._of_no_part: Counter[str] = Counter()
        self.losses: list[Finding] = []
        """Values of elements whose part has no such attribute."""

    def element(self, file: str, row: Row) -> Iterator[Row]:
        """The row as an element; none if it has no id or no text, such as a heading, or if its part is none of rgss.

        Args:
            file: The file's name.
            row: The row, with the cells of all columns; its part, if it is of the sheet of one.
        """
        names = self._table.names
        cells = {
            name: names.own_ids(name, cell) if name in LINKED else _BREAK.sub("\n", cell)
            for name, cell in row.cells.items()
        }
        cells["id"] = names.own_id(cells.get("id", "").strip())
        said = cells.pop(PART, "").strip()
        lacks = next((name for name in ("id", "text") if name in cells and not cells[name].strip()), "")
        if lacks:
            self._lacking[lacks] += 1
            return
        stated = names.stated_part(said)
        if said and stated is None:
            self._of_no_part[said] += 1
            return
        part = row.part or stated or self._table.known.get(cells["id"]) or self._table.part
        own = {attribute.name for attribute in ATTRIBUTES[part]} if part is not None else cells.keys()
        for name in cells.keys() - own:
            if part is not None and cells[name].strip():
                message = f"{cells['id']}: a {part.value} requirement has no {name!r}: {shown(cells[name])} is omitted"
                column = row.columns[name]
                severity = Severity.WARNING
                self.losses.append(problem(file, "loss", message, line=row.line, column=column, severity=severity))
        yield replace(row, part=part, cells={name: cell for name, cell in cells.items() if name in own})

    def notes(self) -> Iterator[str]:
        """Notes on rows that are not imported."""
        for lacks, count in sorted(self._lacking.items()):
            rows = "1 row is" if count == 1 else f"{count} rows are"
            yield f"{rows} not imported: no {lacks}"
        for value, count in sorted(self._of_no_part.items()):
            rows = "1 row is" if count == 1 else f"{count} rows are"
            option = f"--map-value {shlex.quote(f'{PART}:{value}=…')}"
            yield f"{rows} not imported: {shown(value)} is no part ({option} takes such)"
