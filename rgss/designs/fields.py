"""Field types of design files whose type depends on another part of the files."""

from __future__ import annotations

from typing import Annotated, Any

from pydantic import PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from rgss.designs.parameters import ParameterValue
from rgss.documents import Identifier


def _read_scalar(value: Any) -> ParameterValue:
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise _field_error("a value is expected", 'write a quantity ("0.3 kg"), a number or a name')
    return value


def _read_choices(value: Any) -> tuple[ParameterValue, ...]:
    if not isinstance(value, list):
        return (_read_scalar(value),)
    if not value:
        raise _field_error("at least one value is expected", "write the allowed values")
    return tuple(_read_scalar(item) for item in value)


def _field_error(message: str, hint: str) -> PydanticCustomError:
    return PydanticCustomError("quantity", "{message}", {"message": message, "hint": hint})


_SCALAR_SCHEMA = {"type": ["number", "string"], "description": "A quantity with its unit, a number, or a name."}

ScalarField = Annotated[ParameterValue, PlainValidator(_read_scalar), WithJsonSchema(_SCALAR_SCHEMA)]
"""A value in a unit of the parameter."""

ChoicesField = Annotated[
    tuple[ParameterValue, ...],
    PlainValidator(_read_choices),
    WithJsonSchema({"anyOf": [_SCALAR_SCHEMA, {"type": "array", "minItems": 1, "items": _SCALAR_SCHEMA}]}),
]
"""One such value, or a list of alternatives."""

ConditionsField = dict[Identifier, ChoicesField]
"""A condition: values by parameter id, or component ids by ``component.<role>``."""
