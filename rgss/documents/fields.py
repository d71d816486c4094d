"""Field types of YAML files: quantities with units, identifiers, texts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Any, Generic, TypeVar

from pydantic import AfterValidator, BeforeValidator, GetCoreSchemaHandler, StringConstraints, WithJsonSchema
from pydantic_core import CoreSchema, PydanticCustomError, core_schema

from rgss.documents.model import DocumentModel
from rgss.errors import QuantityError
from rgss.quantities import dimension, parse_quantity


def _reader_of(unit: str) -> Callable[[Any], float]:
    example = "a number, such as 0.5" if unit == "1" else f'a number and a unit, such as "1 {unit}"'

    def read(value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, (int, float, str)):
            raise _as_field_error(QuantityError("a quantity is expected", hint=f"write {example}"))
        try:
            return parse_quantity(value if isinstance(value, str) else repr(value), unit)
        except QuantityError as error:
            raise _as_field_error(error) from error

    return read


@dataclass(frozen=True, slots=True)
class JointQuantity:
    """Quantity of a revolute or prismatic joint.

    Attributes:
        value: In rad, or in m, and so on.
        is_linear: True for a length, a linear speed or acceleration, or a force.
    """

    value: float
    is_linear: bool


def _joint_reader_of(angular: str, linear: str) -> Callable[[Any], JointQuantity]:
    """Reader of a quantity whose unit determines the kind of the joint."""
    read_angular, read_linear = _reader_of(angular), _reader_of(linear)

    def read(value: Any) -> JointQuantity:
        try:
            return JointQuantity(value=read_angular(value), is_linear=False)
        except PydanticCustomError:
            try:
                return JointQuantity(value=read_linear(value), is_linear=True)
            except PydanticCustomError:
                pass
            raise

    return read


def _as_field_error(error: QuantityError) -> PydanticCustomError:
    return PydanticCustomError("quantity", "{message}", {"message": error.message, "hint": error.hint})


_NUMBER_PATTERN = r"\s*[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+-]?[0-9]{1,3})?\s*"
QUANTITY_PATTERN = rf"^{_NUMBER_PATTERN}(\s1\s*/\s*|/\s*)?[A-Za-zµμ°%$(].*$"
"""Pattern of a number with a unit; the reader checks the unit."""

_EXAMPLES = {
    "m": ("120 mm", "0.5 m"),
    "kg": ("0.25 kg", "50 g"),
    "s": ("6 s", "0.25 ms"),
    "rad": ("90 deg", "0.01 rad"),
    "rad/s": ("120 deg/s",),
}


def _schema(unit: str) -> WithJsonSchema:
    examples = _EXAMPLES.get(unit, (f"1 {unit}",))
    hint = f"write a number and a unit, such as {examples[0]}"
    return WithJsonSchema(
        {
            "type": "string",
            "pattern": QUANTITY_PATTERN,
            "description": f"A quantity in {unit} or a unit that converts to it.",
            "examples": list(examples),
            # Not keywords of JSON Schema: editors show these instead of their own messages.
            "errorMessage": hint,
            "patternErrorMessage": hint,
        }
    )


def _joint_schema(angular: str, linear: str) -> WithJsonSchema:
    schema = dict(_schema(angular).json_schema or {})
    schema["description"] = f"A quantity in {angular}, or in {linear} for a prismatic joint."
    return WithJsonSchema(schema)


def _check_unit(text: str) -> str:
    try:
        dimension(text)
    except QuantityError as error:
        raise _as_field_error(error) from error
    return text


def number_as_text(value: Any) -> Any:
    """A number as a text, since a quantity without a unit may be a plain number; anything else as it is."""
    return repr(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value


Metres = Annotated[float, BeforeValidator(_reader_of("m")), _schema("m")]
Kilograms = Annotated[float, BeforeValidator(_reader_of("kg")), _schema("kg")]
KilogramsPerCubicMetre = Annotated[float, BeforeValidator(_reader_of("kg/m**3")), _schema("kg/m**3")]
KilogramSquareMetres = Annotated[float, BeforeValidator(_reader_of("kg*m**2")), _schema("kg*m**2")]
Seconds = Annotated[float, BeforeValidator(_reader_of("s")), _schema("s")]
NewtonsPerMetre = Annotated[float, BeforeValidator(_reader_of("N/m")), _schema("N/m")]
NewtonSecondsPerMetre = Annotated[float, BeforeValidator(_reader_of("N*s/m")), _schema("N*s/m")]
Newtons = Annotated[float, BeforeValidator(_reader_of("N")), _schema("N")]
Radians = Annotated[float, BeforeValidator(_reader_of("rad")), _schema("rad")]
RadiansPerSecond = Annotated[float, BeforeValidator(_reader_of("rad/s")), _schema("rad/s")]
RadiansPerSecondSquared = Annotated[float, BeforeValidator(_reader_of("rad/s**2")), _schema("rad/s**2")]
MetresPerSecond = Annotated[float, BeforeValidator(_reader_of("m/s")), _schema("m/s")]
MetresPerSecondSquared = Annotated[float, BeforeValidator(_reader_of("m/s**2")), _schema("m/s**2")]
JointPosition = Annotated[JointQuantity, BeforeValidator(_joint_reader_of("rad", "m")), _joint_schema("rad", "m")]
JointSpeed = Annotated[JointQuantity, BeforeValidator(_joint_reader_of("rad/s", "m/s")), _joint_schema("rad/s", "m/s")]
JointAcceleration = Annotated[
    JointQuantity,
    BeforeValidator(_joint_reader_of("rad/s**2", "m/s**2")),
    _joint_schema("rad/s**2", "m/s**2"),
]
JointEffort = Annotated[JointQuantity, BeforeValidator(_joint_reader_of("N*m", "N")), _joint_schema("N*m", "N")]
Hertz = Annotated[float, BeforeValidator(_reader_of("Hz")), _schema("Hz")]
Dimensionless = Annotated[
    float,
    BeforeValidator(_reader_of("1")),
    WithJsonSchema({"anyOf": [{"type": "number"}, {"type": "string", "pattern": rf"^{_NUMBER_PATTERN}%?\s*$"}]}),
]
"""A pure number, or a percentage such as ``"95 %"``."""

QuantityText = Annotated[str, StringConstraints(min_length=1, max_length=60)]
"""A quantity whose unit depends on its context; its reader converts it."""

UnitText = Annotated[str, StringConstraints(min_length=1, max_length=60), AfterValidator(_check_unit)]
"""The name of a unit; ``"1"`` for a pure number."""

IDENTIFIER_PATTERN = r"^[A-Za-z][A-Za-z0-9_.-]*$"
Identifier = Annotated[str, StringConstraints(pattern=IDENTIFIER_PATTERN, max_length=80)]
"""An identifier: a letter, then letters, digits, and ``_ . -``."""

Text = Annotated[
    str,
    StringConstraints(min_length=1, max_length=10_000, strip_whitespace=True),
    WithJsonSchema({"type": "string", "maxLength": 10_000, "pattern": r"\S"}),
]
"""Prose; not empty."""

_Model = TypeVar("_Model", bound=DocumentModel)


@dataclass(frozen=True)
class ReadFrom(Generic[_Model]):
    """Annotation of a type with another form in files, such as a number with its unit as one text.

    A value created in Python is already an instance of the annotated class.
    """

    model: type[_Model]
    """The written form."""
    convert: Callable[[_Model], Any]

    def __get_pydantic_core_schema__(self, source: type[Any], handler: GetCoreSchemaHandler) -> CoreSchema:
        """Schema of the model in files, and of the annotated class in Python."""
        return core_schema.json_or_python_schema(
            json_schema=core_schema.no_info_after_validator_function(self.convert, handler.generate_schema(self.model)),
            python_schema=core_schema.is_instance_schema(source),
        )
