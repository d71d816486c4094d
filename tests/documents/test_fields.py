"""Each field type: its unit, what it refuses, and its JSON Schema."""

from __future__ import annotations

import math

import pytest
from pydantic import TypeAdapter, ValidationError

from rgss import documents
from rgss.documents import fields

QUANTITIES = {
    "Metres": ("120 mm", 0.12),
    "Kilograms": ("300 g", 0.3),
    "KilogramsPerCubicMetre": ("2700 kg/m^3", 2700.0),
    "KilogramSquareMetres": ("2 kg*m^2", 2.0),
    "Seconds": ("2 min", 120.0),
    "Newtons": ("1.5 kN", 1500.0),
    "NewtonsPerMetre": ("10 kN/m", 1.0e4),
    "NewtonSecondsPerMetre": ("30 N*s/m", 30.0),
    "Radians": ("180 deg", math.pi),
    "RadiansPerSecond": ("90 deg/s", math.pi / 2),
    "RadiansPerSecondSquared": ("90 deg/s^2", math.pi / 2),
    "MetresPerSecond": ("500 mm/s", 0.5),
    "MetresPerSecondSquared": ("9.81 m/s²", 9.81),
    "Hertz": ("0.24 kHz", 240.0),
    "Dimensionless": ("95 %", 0.95),
}
JOINT_QUANTITIES = {
    "JointPosition": (("180 deg", math.pi), ("120 mm", 0.12)),
    "JointSpeed": (("90 deg/s", math.pi / 2), ("500 mm/s", 0.5)),
    "JointAcceleration": (("90 deg/s^2", math.pi / 2), ("9.81 m/s²", 9.81)),
    "JointEffort": (("330 N*m", 330.0), ("1.5 kN", 1500.0)),
}


def adapter(name):
    return TypeAdapter(getattr(documents, name))


def refusal(name, value):
    with pytest.raises(ValidationError) as caught:
        adapter(name).validate_python(value)
    (problem,) = caught.value.errors()
    return problem


def test_every_field_is_tested():
    others = {
        "IDENTIFIER_PATTERN",
        "Document",
        "DocumentModel",
        "Identifier",
        "JointQuantity",
        "LoadedDocument",
        "QuantityText",
        "ReadFrom",
        "Text",
        "UnitText",
    }
    of_fields = {name for name in vars(documents) if hasattr(fields, name) and not name.islower() and name[0] != "_"}

    assert of_fields - others == {*QUANTITIES, *JOINT_QUANTITIES}


@pytest.mark.parametrize(("name", "cases"), JOINT_QUANTITIES.items())
def test_the_unit_of_a_joints_quantity_says_whether_it_turns_or_slides(name, cases):
    found = [adapter(name).validate_python(text) for text, _ in cases]
    assert [(one.value, one.is_linear) for one in found] == [
        (pytest.approx(value), linear) for (_, value), linear in zip(cases, (False, True), strict=True)
    ]
    assert refusal(name, "3 kg")["type"] == "quantity"
    assert "for a prismatic joint" in adapter(name).json_schema()["description"]


@pytest.mark.parametrize(("name", "text", "value"), [(name, *case) for name, case in QUANTITIES.items()])
def test_quantity(name, text, value):
    assert adapter(name).validate_python(text) == value


@pytest.mark.parametrize("name", sorted(set(QUANTITIES) - {"Dimensionless"}))
@pytest.mark.parametrize("value", [5, 0.5, "5", "5 lx", "many", "1e999 m"])
def test_quantity_needs_its_unit(name, value):
    assert refusal(name, value)["type"] == "quantity"


@pytest.mark.parametrize("name", sorted(QUANTITIES))
@pytest.mark.parametrize("value", [True, None, [1], {"a": 1}])
def test_quantity_of_another_kind(name, value):
    problem = refusal(name, value)

    assert problem["msg"] == "a quantity is expected"
    assert problem["ctx"]["hint"].startswith("write a number")


@pytest.mark.parametrize(("value", "number"), [(0.25, 0.25), (3, 3.0), (1e-7, 1e-7), (1e22, 1e22), ("0.25", 0.25)])
def test_dimensionless_takes_numbers(value, number):
    assert adapter("Dimensionless").validate_python(value) == number


@pytest.mark.parametrize("value", ["1 m", "5 rad", "1e999", "x"])
def test_dimensionless_takes_no_unit(value):
    assert refusal("Dimensionless", value)["type"] == "quantity"


@pytest.mark.parametrize("unit", ["1", "kg", "m/s", "USD", "%", "1/s", "kg*m**2"])
def test_unit(unit):
    assert adapter("UnitText").validate_python(unit) == unit


@pytest.mark.parametrize("unit", ["furlongs-ish", "m**", "12", "m/0", "XAU"])
def test_unknown_unit(unit):
    assert refusal("UnitText", unit)["type"] == "quantity"


@pytest.mark.parametrize("text", ["d1", "STK-006", "finger_mass.kg", "A" * 80])
def test_identifier(text):
    assert adapter("Identifier").validate_python(text) == text


@pytest.mark.parametrize("text", ["", "1a", "-a", "a b", "é", "a\n", "A" * 81])
def test_no_identifier(text):
    assert refusal("Identifier", text)["type"].startswith("string_")


def test_text_is_stripped():
    assert adapter("Text").validate_python("  words\n") == "words"


@pytest.mark.parametrize("name", [*QUANTITIES, "Identifier", "QuantityText", "Text", "UnitText"])
def test_json_schema(name):
    schema = adapter(name).json_schema()

    assert schema.get("type") == "string" or name == "Dimensionless"
    if name in QUANTITIES and name != "Dimensionless":
        assert schema["description"].startswith("A quantity in ")
