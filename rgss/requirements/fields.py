"""Field types of the requirements' files: non-empty lists, and thresholds with units."""

from __future__ import annotations

from typing import Annotated, TypeVar

from pydantic import AfterValidator, BeforeValidator, Field, WithJsonSchema

from rgss.documents import QuantityText, number_as_text
from rgss.errors import QuantityError
from rgss.findings import shown
from rgss.quantities import check_scale, parse_quantity, written_unit

_Entry = TypeVar("_Entry")


def split_quantity(text: str) -> tuple[float, str]:
    """Parse a quantity in any unit.

    Returns:
        The magnitude, and the unit as written; ``"1"`` for a pure number.

    Raises:
        QuantityError: The text is not a number with a known unit, or its unit has an offset or is logarithmic.
    """
    unit = written_unit(text)
    if unit is None and not any(map(str.isdigit, text)):
        raise QuantityError(f"{shown(text)} has no number", hint='write a number and a unit, such as "1 kg"')
    if unit is None:
        unit = "kg"  # for the example in the message that the text is not a quantity
    unit = unit or "1"
    number = parse_quantity(text, unit)
    check_scale(number, unit)
    return number, unit


def _check_quantity(text: str) -> str:
    split_quantity(text)
    return text


def _not_empty(entries: tuple[_Entry, ...]) -> tuple[_Entry, ...]:
    # Not pydantic's min_length, which counts only valid entries and so reports an invalid one twice.
    if not entries:
        raise ValueError("at least 1 entry is expected")
    return entries


Entries = Annotated[tuple[_Entry, ...], AfterValidator(_not_empty), Field(json_schema_extra={"minItems": 1})]
"""Non-empty list."""

ThresholdText = Annotated[
    QuantityText,
    BeforeValidator(number_as_text),
    AfterValidator(_check_quantity),
    WithJsonSchema(
        {
            "type": ["string", "number"],
            "minLength": 1,
            "maxLength": 60,
            "description": "A quantity in a unit of the measure's dimension.",
        }
    ),
]
"""A quantity in a unit of the measure, such as ``"0.8 kg"``; a pure number may be bare."""
