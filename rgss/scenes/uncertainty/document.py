"""Document models of uncertainty and workload."""

from __future__ import annotations

import re
from typing import Annotated, Any

from pydantic import BeforeValidator, Field, PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from rgss.documents import (
    IDENTIFIER_PATTERN,
    Dimensionless,
    DocumentModel,
    Identifier,
    Kilograms,
    Metres,
    QuantityText,
    Text,
    number_as_text,
)
from rgss.findings import shown
from rgss.scenes.uncertainty.quantities import QUANTITIES
from rgss.scenes.uncertainty.quantity_names import further_object_endings, quantity_of, similar_name

MOST_REPLICATES_OF_CASE = 1000

_PATTERNS = tuple(
    rf"^{first}\.{IDENTIFIER_PATTERN.strip('^$')}\.({'|'.join(endings)})$"
    for first, endings in further_object_endings().items()
)


def _is_name(value: Any) -> bool:
    try:
        quantity = quantity_of(value) if isinstance(value, str) else None
    except KeyError:
        return False
    if quantity is None or quantity.name != value:
        return False
    return not quantity.object or re.fullmatch(IDENTIFIER_PATTERN, quantity.object) is not None


def _read_name(value: Any) -> str:
    if _is_name(value):
        return str(value)
    near = similar_name(str(value))
    hint = f"did you mean {near!r}?" if near else f"quantities: {', '.join(QUANTITIES)}"
    details = {"message": f"unknown uncertain quantity {shown(str(value))}", "hint": hint}
    raise PydanticCustomError("quantity", "{message}", details)


ValueText = Annotated[
    QuantityText,
    BeforeValidator(number_as_text),
    WithJsonSchema(
        {
            "type": ["string", "number"],
            "minLength": 1,
            "maxLength": 60,
            "description": "A value in the quantity's unit; factors and coefficients are dimensionless.",
        }
    ),
]
"""A value in the unit of the uncertain quantity, such as ``"3 mm"`` or ``"5 %"``."""

QuantityName = Annotated[
    str,
    PlainValidator(_read_name),
    WithJsonSchema(
        {
            "anyOf": [
                {"enum": list(QUANTITIES), "enumDescriptions": [one.meaning for one in QUANTITIES.values()]},
                *({"type": "string", "pattern": pattern} for pattern in _PATTERNS),
            ]
        }
    ),
]
"""The name of an uncertain quantity."""


class NormalEntry(DocumentModel):
    """A normal distribution."""

    mean: ValueText
    sd: ValueText


class TruncatedNormalEntry(DocumentModel):
    """A truncated normal distribution."""

    mean: ValueText
    sd: ValueText
    low: ValueText
    high: ValueText


class UniformEntry(DocumentModel):
    """A uniform distribution."""

    low: ValueText
    high: ValueText


class LogNormalEntry(DocumentModel):
    """A log-normal distribution."""

    median: ValueText
    geometric_sd: Dimensionless


class DiscreteEntry(DocumentModel):
    """A few values with their weights."""

    values: Annotated[tuple[ValueText, ...], Field(min_length=1)]
    weights: tuple[Dimensionless, ...] = ()


class DistributionEntry(DocumentModel):
    """Distribution of an uncertain quantity: exactly one, with its rationale."""

    normal: NormalEntry | None = None
    truncated_normal: TruncatedNormalEntry | None = None
    uniform: UniformEntry | None = None
    lognormal: LogNormalEntry | None = None
    discrete: DiscreteEntry | None = None
    constant: ValueText | None = None
    rationale: Text


class CorrelationEntry(DocumentModel):
    """Correlated uncertain quantities."""

    quantities: Annotated[tuple[QuantityName, ...], Field(min_length=2)]
    matrix: Annotated[tuple[tuple[Dimensionless, ...], ...], Field(min_length=2)]
    rationale: Text


class CaseEntry(DocumentModel):
    """One kind of object of a workload; values that it omits are those of the scene."""

    case: Identifier
    replicates: Annotated[int, Field(ge=1, le=MOST_REPLICATES_OF_CASE)] = 1
    mass: Kilograms | None = None
    radius: Metres | None = None
    height: Metres | None = None
    friction: Dimensionless | None = None
    rationale: Text
