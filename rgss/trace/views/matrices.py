"""Traceability matrices of two kinds of elements."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from rgss.errors import DefinitionError
from rgss.requirements import nearest
from rgss.trace.model import MeasureKind, TraceModel


class _Named(Protocol):
    @property
    def id(self) -> str: ...


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceMatrix:
    """A table of links, kept sparse: its size is that of its links, not of rows times columns.

    Attributes:
        rows: Ids of the rows.
        columns: Ids of the columns.
        linked: For each row, the ascending indices of the columns that it is linked to.
    """

    rows: tuple[str, ...]
    columns: tuple[str, ...]
    linked: tuple[tuple[int, ...], ...]
    _row_index: Mapping[str, int] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "_row_index", _positions(self.rows))

    @property
    def link_count(self) -> int:
        """Number of links."""
        return sum(map(len, self.linked))

    @property
    def empty_rows(self) -> tuple[str, ...]:
        """Ids of the rows without a link: gaps."""
        return tuple(row for row, indices in zip(self.rows, self.linked, strict=True) if not indices)

    @property
    def empty_columns(self) -> tuple[str, ...]:
        """Ids of the columns without a link: gaps."""
        reached = {index for indices in self.linked for index in indices}
        return tuple(column for index, column in enumerate(self.columns) if index not in reached)

    def linked_to_row(self, row: str) -> tuple[str, ...]:
        """Ids of the columns linked to a row, in the order of the columns.

        Raises:
            DefinitionError: The row is unknown.
        """
        position = self._row_index.get(row)
        if position is None:
            raise DefinitionError(f"the matrix has no row {row!r}", hint=nearest(row, self._row_index))
        return tuple(self.columns[index] for index in self.linked[position])


def matrix_of(rows: Iterable[str], columns: Iterable[str], linked: Mapping[str, Iterable[str]]) -> TraceMatrix:
    """Matrix from the links of its rows.

    Args:
        rows: Ids of the rows.
        columns: Ids of the columns.
        linked: Function that returns the linked ids of a row; ids without a column are ignored.
    """
    names, heads = tuple(rows), tuple(columns)
    positions = _positions(heads)
    return TraceMatrix(
        rows=names,
        columns=heads,
        linked=tuple(
            tuple(sorted({positions[name] for name in linked.get(row, ()) if name in positions})) for row in names
        ),
    )


def stakeholder_by_effectiveness(model: TraceModel) -> TraceMatrix:
    """Stakeholder requirements against the measures of effectiveness that trace to them."""
    measures = [measure for measure in model.measures if measure.kind is MeasureKind.MOE]
    linked: dict[str, list[str]] = {}
    for measure in measures:
        for need in measure.traces:
            linked.setdefault(need, []).append(measure.id)
    return matrix_of(_ids(model.requirements.stakeholder), _ids(measures), linked)


def system_by_stakeholder(model: TraceModel) -> TraceMatrix:
    """System requirements against the stakeholder requirements that they derive from, over any number of steps."""
    return matrix_of(_ids(model.requirements.system), _ids(model.requirements.stakeholder), _all_origins(model))


def system_by_architecture(model: TraceModel) -> TraceMatrix:
    """System requirements against the blocks and behaviours that satisfy them."""
    linked = {requirement.id: requirement.satisfied_by for requirement in model.requirements.system}
    return matrix_of(_ids(model.requirements.system), _ids(model.requirements.architecture.elements), linked)


def _all_origins(model: TraceModel) -> Mapping[str, frozenset[str]]:
    """Stakeholder requirements from which each system requirement derives, transitively.

    In topological order, with one step for each link. In a cycle the graph is searched from each requirement
    separately.
    """
    needs = {need.id for need in model.requirements.stakeholder}
    parents = {requirement.id: requirement.derived_from for requirement in model.requirements.system}
    children: dict[str, list[str]] = {}
    waiting: dict[str, int] = {}
    for name, above in parents.items():
        there = [parent for parent in dict.fromkeys(above) if parent in parents]
        waiting[name] = len(there)
        for parent in there:
            children.setdefault(parent, []).append(name)
    reached: dict[str, frozenset[str]] = {}
    ready = deque(name for name, count in waiting.items() if count == 0)
    while ready:
        name = ready.popleft()
        reached[name] = _joined([needs.intersection(parents[name]), *(reached.get(p, _NONE) for p in parents[name])])
        for child in children.get(name, ()):
            waiting[child] -= 1
            if waiting[child] == 0:
                ready.append(child)
    for name in parents:
        if name not in reached:
            reached[name] = model.origins(name)
    return reached


_NONE: frozenset[str] = frozenset()


def _joined(parts: Sequence[frozenset[str] | set[str]]) -> frozenset[str]:
    """Their union; the largest part itself, and no copy of it, where it holds the others."""
    largest = max(parts, key=len)
    if all(part <= largest for part in parts):
        return frozenset(largest)
    return frozenset().union(*parts)


def _positions(names: Sequence[str]) -> Mapping[str, int]:
    return {name: index for index, name in enumerate(names)}


def _ids(items: Iterable[_Named]) -> tuple[str, ...]:
    return tuple(item.id for item in items)
