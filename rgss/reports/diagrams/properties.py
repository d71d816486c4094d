"""Properties of blocks as compartments show them: values with their types, and ports with what passes."""

from __future__ import annotations

from rgss.reports.diagrams.graph import Compartment
from rgss.requirements import Block, Port, ValueProperty


def compartments_of(block: Block) -> tuple[Compartment, ...]:
    """The compartments of a block that has values or ports."""
    found = []
    if block.values:
        found.append(Compartment(title="values", lines=tuple(map(value_line, block.values))))
    if block.ports:
        found.append(Compartment(title="proxy ports", lines=tuple(map(_port_line, block.ports))))
    return tuple(found)


def value_line(value: ValueProperty) -> str:
    """A value as SysML writes it: name, type and, if it is fixed, what it is."""
    line = f"{value.id} : {value_type(value.unit)}"
    return f"{line} = {value.value}" if value.value is not None else line


def value_type(unit: str) -> str:
    """The name of a value type: the unit, or Real for a pure number."""
    return "Real" if unit == "1" else unit


def _port_line(port: Port) -> str:
    return f"{port.direction.value} {port.id} : {port.flow}"
