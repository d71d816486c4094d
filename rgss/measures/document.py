"""The YAML form of measures."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Field, WithJsonSchema

from rgss.documents import DocumentModel, Identifier, QuantityText, Text, UnitText
from rgss.measures.definitions import Assumption, Direction, EstimateRule, InputSymbol, MeasureKind, Summary


def _as_text(value: Any) -> Any:
    """A pure number may stand without quotes; its unit decides later whether it may."""
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


ConstantText = Annotated[
    QuantityText,
    BeforeValidator(_as_text),
    WithJsonSchema(
        {"type": ["string", "number"], "minLength": 1, "maxLength": 60, "description": "A quantity, or a pure number."}
    ),
]
"""The value of a constant, such as ``"9.81 m/s^2"``; a pure number may be bare."""


class ConstantEntry(DocumentModel):
    """A number that is the same for every design."""

    id: Identifier
    value: ConstantText
    unit: UnitText
    definition: Text
    source: Text | None = None


class EquationEntry(DocumentModel):
    """A numbered relation; its number is quoted, since 4.10 would be a number."""

    id: Text
    relation: Text
    note: Text | None = None


class AlternativeEntry(DocumentModel):
    """Another reading of a measure's source: another expression, another estimate, or both."""

    id: Identifier
    expression: Text | None = None
    estimate: EstimateRule | None = None
    rationale: Text


class MeasureEntry(DocumentModel):
    """A quantity by which designs are compared."""

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
    equations: tuple[EquationEntry, ...] = ()
    measures: Annotated[tuple[MeasureEntry, ...], Field(min_length=1)]
