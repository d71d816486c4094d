"""Document models of measures."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from rgss.documents import DocumentModel, Identifier, Text, UnitText
from rgss.measures.definitions import (
    Assumption,
    Direction,
    Equation,
    EstimateRule,
    InputSymbol,
    MeasureKind,
    NumberOrQuantityText,
)
from rgss.measures.estimators import Summary


class ConstantEntry(DocumentModel):
    """A number that is the same for every design."""

    id: Identifier
    value: NumberOrQuantityText
    unit: UnitText
    definition: Text
    source: Text | None = None


class AlternativeEntry(DocumentModel):
    """Alternative interpretation of a measure's source: another expression, another estimate, or both."""

    id: Identifier
    expression: Text | None = None
    estimate: EstimateRule | None = None
    rationale: Text


class MeasureEntry(DocumentModel):
    """Quantity by which designs are compared."""

    id: Identifier
    kind: MeasureKind
    name: Text
    definition: Text
    unit: UnitText
    expression: Text
    equation: Text | None = None
    better: Direction
    traces: tuple[Identifier, ...] = ()
    contributes_to: tuple[Identifier, ...] = ()
    estimate: EstimateRule | None = None
    summary: Summary | None = None
    simulated_as: Identifier | None = None
    alternatives: tuple[AlternativeEntry, ...] = ()


class MeasuresDocument(DocumentModel):
    """A measures file."""

    title: Text
    constants: tuple[ConstantEntry, ...] = ()
    inputs: tuple[InputSymbol, ...] = ()
    assumptions: tuple[Assumption, ...] = ()
    equations: tuple[Equation, ...] = ()
    measures: Annotated[tuple[MeasureEntry, ...], Field(min_length=1)]
