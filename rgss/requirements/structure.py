"""Properties of blocks: multiplicity as a part, values, ports, and connectors between parts."""

from __future__ import annotations

import re
from enum import Enum
from typing import Annotated

from pydantic import AfterValidator, BeforeValidator, WithJsonSchema, model_validator
from pydantic.dataclasses import dataclass

from rgss.documents import STRICT, Identifier, QuantityText, Text, UnitText, number_as_text
from rgss.errors import QuantityError
from rgss.quantities import parse_quantity

_MULTIPLICITY = r"^(\d{1,6}|\d{1,6}\.\.(\d{1,6}|\*)|\*)$"


def _check_multiplicity(text: str) -> str:
    if not re.match(_MULTIPLICITY, text):
        raise ValueError(f"a multiplicity is a number, a range such as 2..3 or 1..*, or *, got {text!r}")
    lower, _, upper = text.partition("..")
    if upper not in ("", "*") and int(lower) > int(upper):
        raise ValueError(f"the lower bound of a multiplicity must not exceed the upper one, got {text!r}")
    return text


Multiplicity = Annotated[
    str,
    BeforeValidator(number_as_text),
    AfterValidator(_check_multiplicity),
    WithJsonSchema({"anyOf": [{"type": "string", "pattern": _MULTIPLICITY}, {"type": "integer", "minimum": 0}]}),
]
"""Number of parts: ``6``, ``"2..3"``, ``"1..*"`` or ``"*"``."""

ValueText = Annotated[
    QuantityText,
    BeforeValidator(number_as_text),
    WithJsonSchema({"type": ["string", "number"], "minLength": 1, "maxLength": 60}),
]
"""A quantity in a unit of the value's dimension; a pure number may be bare."""


class PortDirection(str, Enum):
    """Direction in which something passes a port, seen from the block that has it."""

    IN = "in"
    OUT = "out"
    INOUT = "inout"


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class ValueProperty:
    """A quantity that a block has: its value type is its unit."""

    id: Identifier
    unit: UnitText
    value: ValueText | None = None
    symbol: Identifier | None = None
    text: Text | None = None

    @model_validator(mode="after")
    def _value_fits_unit(self) -> ValueProperty:
        if self.value is not None:
            try:
                parse_quantity(self.value, self.unit)
            except QuantityError as error:
                raise ValueError(f"'value': {error}") from error
        return self


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Port:
    """A place at the border of a block through which something passes."""

    id: Identifier
    direction: PortDirection
    flow: Text


@dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Connector:
    """A connection of two parts of a block, or of a part with a port of the block itself."""

    source: Identifier
    source_port: Identifier | None = None
    target: Identifier
    target_port: Identifier | None = None
    flow: Text | None = None
