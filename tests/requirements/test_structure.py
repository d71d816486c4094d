"""Multiplicities, values, ports and connectors of blocks: what is read, and what is said about broken ones."""

from __future__ import annotations

import pytest

from rgss.requirements import Connector, Port, PortDirection, ValueProperty

ARCHITECTURE = "architecture.yaml"
WHOLE = "{id: BLK-0, name: System, level: system, text: The whole.}"
PARTS = """\
  - id: BLK-2
    name: Arm
    level: element
    parent: BLK-0
    text: Moves.
    ports: [{id: torque, direction: in, flow: Torque}]
  - id: BLK-3
    name: Drive
    level: element
    parent: BLK-0
    multiplicity: 6
    text: Turns.
    values: [{id: torque, unit: N*m, value: 330 N*m, symbol: tau, text: Largest torque.}, {id: ratio, unit: "1"}]
    ports: [{id: shaft, direction: out, flow: Torque}, {id: bus, direction: inout, flow: Messages}]
"""
CONNECTED = "source: BLK-3, source_port: shaft, target: BLK-2, target_port: torque"


@pytest.fixture
def structured(project):
    """The project with two parts of its system, a port of the system and a connector of each sort."""
    connectors = f"[{{{CONNECTED}}}, {{source: BLK-0, source_port: order, target: BLK-3, target_port: bus}}]"
    ports = "[{id: order, direction: in, flow: Messages}]"
    project.edit(ARCHITECTURE, WHOLE, f"{WHOLE[:-1]}, ports: {ports}, connectors: {connectors}}}")
    return project.edit(ARCHITECTURE, "behaviours:\n", f"{PARTS}behaviours:\n")


def test_a_structure_as_it_is_written(structured):
    requirements = structured.load()
    drive, whole = requirements.element("BLK-3"), requirements.element("BLK-0")

    assert drive.multiplicity == "6"
    assert drive.values == (
        ValueProperty(id="torque", unit="N*m", value="330 N*m", symbol="tau", text="Largest torque."),
        ValueProperty(id="ratio", unit="1"),
    )
    assert drive.ports[0] == Port(id="shaft", direction=PortDirection.OUT, flow="Torque")
    assert whole.connectors[0] == Connector(source="BLK-3", source_port="shaft", target="BLK-2", target_port="torque")
    assert (whole.multiplicity, whole.values) == (None, ())


@pytest.mark.parametrize(
    ("old", "new", "start", "message"),
    [
        (
            "multiplicity: 6",
            "multiplicity: 3..2",
            "3..2",
            "the lower bound of a multiplicity must not exceed the upper one, got '3..2'",
        ),
        ("multiplicity: 6", "multiplicity: many", "many", "a multiplicity is a number, a range such as 2..3 or 1..*"),
        ("relation: kind,", "relation: kind, multiplicity: 2,", "2, text: A part", "is no part of another block"),
        ("value: 330 N*m", "value: 330 kg", "{id: torque, unit: N", "'value': "),
        ("{id: ratio,", "{id: torque,", 'torque, unit: "1"', "id 'torque' is repeated in values"),
        ("{id: bus,", "{id: shaft,", "shaft, direction: inout", "id 'shaft' is repeated in ports"),
        ("target: BLK-2,", "target: BLK-1,", "BLK-1, target_port", "target: 'BLK-1' is not a part of 'BLK-0'"),
        ("target: BLK-2,", "target: BLK-9,", "BLK-9, target_port", "target: 'BLK-9' is not declared"),
        ("target: BLK-2,", "target: BLK-3,", "BLK-3, target_port: torque", "connects 'BLK-3' with itself"),
        (
            "target_port: torque",
            "target_port: torqe",
            "torqe",
            "target_port: 'torqe' is not a port of 'BLK-2' (did you mean 'torque'?)",
        ),
        (
            "id: torque, direction: in",
            "id: torque, direction: out",
            "torque}, {source: BLK-0",
            "has the direction 'out', not 'in'",
        ),
        ("id: shaft, direction: out", "id: shaft, direction: in", "shaft, target: BLK-2", "direction 'in', not 'out'"),
        ("id: order, direction: in", "id: order, direction: out", "order, target", "direction 'out', not 'in'"),
        ("source_port: order, ", "", "BLK-0, target: BLK-3", "a connector to 'BLK-0' itself names a port of it"),
    ],
)
def test_broken_structures(structured, old, new, start, message):
    structured.edit(ARCHITECTURE, old, new)
    found = structured.findings()

    # A break may have consequences at the ports; the place and the message of its cause are told.
    assert any(line.startswith(structured.position(ARCHITECTURE, start)) and message in line for line in found), found


@pytest.mark.parametrize("multiplicity", ["0", "12", "2..3", "0..*", "'*'"])
def test_multiplicities_that_are_sound(structured, multiplicity):
    structured.edit(ARCHITECTURE, "multiplicity: 6", f"multiplicity: {multiplicity}")

    assert structured.load().element("BLK-3").multiplicity == multiplicity.strip("'")


def test_a_kind_has_the_ports_and_parts_of_what_it_is_a_kind_of(structured):
    structured.edit(
        ARCHITECTURE,
        "behaviours:\n",
        "  - {id: BLK-4, name: Other, level: system, parent: BLK-0, relation: kind, text: T., "
        f"connectors: [{{{CONNECTED}}}]}}\nbehaviours:\n",
    )

    assert structured.load().element("BLK-4").connectors[0].source == "BLK-3"
