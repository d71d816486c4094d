"""Column of a frame: name, unit and meaning."""

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
        name: Its name; a part in capitals, such as ``PARAMETER``, is a placeholder for names of the project.
        unit: The unit of its numbers, in SI; ``"1"`` for a dimensionless number, empty if it is not a number;
            a sentence where another column or the project determines the unit.
        meaning: Its meaning.
        kind: Type of its cells.
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
        """The name in a table: for a row of numbers that of its entries."""
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
        name: Its attribute of `Study` or `Trade`.
        row: Meaning of a row.
        index: The columns of its index.
        columns: The other columns, in order.
    """

    name: str
    row: str
    index: tuple[Column, ...]
    columns: tuple[Column, ...]
