"""A column of a frame: its name, its unit and what it says."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Kind(str, Enum):
    """Type of a column's cells; the values are the names of pandas' types."""

    NUMBER = "float64"
    COUNT = "Int64"
    TRUTH = "boolean"
    TEXT = "string"


@dataclass(frozen=True, slots=True, kw_only=True)
class Column:
    """One column, or one pattern of columns.

    Attributes:
        name: Its name; parts in capitals stand for what a project has, such as ``PARAMETER``.
        unit: The unit of its numbers, in SI; ``"1"`` for a pure number, empty for what is not a number;
            where another column or the project says it, words that say so.
        meaning: What it says.
        kind: What its cells are.
        items: For a row of numbers how many entries it has, each a column ``item_N_NAME``; 0 where
            that differs; None for a single value.
    """

    name: str
    meaning: str
    unit: str = ""
    kind: Kind = Kind.TEXT
    items: int | None = None

    @property
    def title(self) -> str:
        """The name as a table shows it: that of its entries for a row."""
        return self.name if self.items is None else f"item_N_{self.name}"

    def entries(self, count: int = 0) -> tuple[Column, ...]:
        """The columns that a frame has for it.

        Args:
            count: How many entries a row has whose length differs.
        """
        if self.items is None:
            return (self,)
        return tuple(
            Column(
                name=f"item_{number}_{self.name}",
                meaning=f"{self.meaning}; entry {number}",
                unit=self.unit,
                kind=self.kind,
            )
            for number in range(1, (self.items or count) + 1)
        )


@dataclass(frozen=True, slots=True, kw_only=True)
class FrameDescription:
    """One frame.

    Attributes:
        name: What it is called in `rgss.load_study`'s result.
        row: What a row is.
        index: The columns of its index.
        columns: The other columns, in order.
    """

    name: str
    row: str
    index: tuple[Column, ...]
    columns: tuple[Column, ...]
