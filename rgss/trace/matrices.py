"""Traceability matrices: which of these links to which of those."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from rgss.requirements import LinkKind
from rgss.trace.measure_trace import MeasureKind
from rgss.trace.model import TraceModel


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceMatrix:
    """A table of links.

    Attributes:
        rows: Ids of the rows.
        columns: Ids of the columns.
        cells: For each row and each column, whether they are linked.
    """

    rows: tuple[str, ...]
    columns: tuple[str, ...]
    cells: tuple[tuple[bool, ...], ...]

    def linked_to_row(self, row: str) -> tuple[str, ...]:
        """Ids of the columns that a row is linked to."""
        return tuple(
            column for column, linked in zip(self.columns, self.cells[self.rows.index(row)], strict=True) if linked
        )

    def linked_to_column(self, column: str) -> tuple[str, ...]:
        """Ids of the rows that a column is linked to."""
        index = self.columns.index(column)
        return tuple(row for row, cells in zip(self.rows, self.cells, strict=True) if cells[index])


def stakeholder_by_effectiveness(model: TraceModel) -> TraceMatrix:
    """Stakeholder requirements against the measures of effectiveness that trace to them."""
    needs = [need.id for need in model.requirements.stakeholder]
    measures = [measure.id for measure in model.measures if measure.kind is MeasureKind.MOE]
    return _matrix(needs, measures, {(target, measure.id) for measure in model.measures for target in measure.traces})


def system_by_stakeholder(model: TraceModel) -> TraceMatrix:
    """System requirements against the stakeholder requirements that they derive from, over any number of steps."""
    system = [requirement.id for requirement in model.requirements.system]
    needs = [need.id for need in model.requirements.stakeholder]
    return _matrix(system, needs, {(name, origin) for name in system for origin in model.origins(name)})


def system_by_architecture(model: TraceModel) -> TraceMatrix:
    """System requirements against the blocks and behaviours that satisfy them."""
    system = [requirement.id for requirement in model.requirements.system]
    elements = [element.id for element in model.requirements.architecture.elements]
    return _matrix(
        system, elements, {(link.target, link.source) for link in model.links if link.kind is LinkKind.SATISFY}
    )


def _matrix(rows: Iterable[str], columns: Iterable[str], linked: set[tuple[str, str]]) -> TraceMatrix:
    names, heads = tuple(rows), tuple(columns)
    cells = tuple(tuple((row, column) in linked for column in heads) for row in names)
    return TraceMatrix(rows=names, columns=heads, cells=cells)
