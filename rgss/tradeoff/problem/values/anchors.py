"""Anchors of value functions: quantities, or multiples of requirements' thresholds."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import BeforeValidator, Discriminator, StringConstraints, Tag, WithJsonSchema

from rgss.documents import Dimensionless, DocumentModel, Identifier, number_as_text


class RequirementAnchor(DocumentModel):
    """A quantity that is a requirement's threshold, or a multiple of it."""

    requirement: Identifier
    times: Dimensionless = 1.0


Anchor = float | RequirementAnchor
"""A quantity in the measure's unit, or one that a requirement gives."""


def _kind_of_anchor(value: Any) -> str:
    return "anchor" if isinstance(value, (dict, RequirementAnchor)) else "quantity"


QuantityField = Annotated[
    str,
    BeforeValidator(number_as_text),
    StringConstraints(min_length=1, max_length=60),
    WithJsonSchema(
        {
            "type": ["string", "number"],
            "minLength": 1,
            "maxLength": 60,
            "description": "A quantity in a unit of the measure's dimension.",
        }
    ),
]
"""A quantity whose unit the measure decides."""

AnchorField = Annotated[
    Annotated[RequirementAnchor, Tag("anchor")] | Annotated[QuantityField, Tag("quantity")],
    Discriminator(_kind_of_anchor),
]
"""A quantity, or ``{requirement: SYS-005}`` for the threshold of a requirement."""


class PointEntry(DocumentModel):
    """A point of a piecewise linear value."""

    at: AnchorField
    worth: Dimensionless
