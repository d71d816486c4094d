"""Components that a design is made of, and the catalogue that lists them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from pydantic.dataclasses import dataclass as document_dataclass

from rgss.designs.parameters import ParameterValue
from rgss.designs.settable_quantities import SettableField
from rgss.documents import STRICT, Document, Identifier, Text, UnitText


@dataclass(frozen=True, slots=True, kw_only=True)
class SourcedValue:
    """A magnitude with its source or assumption.

    Attributes:
        value: The magnitude in SI (money in US dollars).
        unit: Its unit.
        assumption: Whether it is assumed rather than taken from a source.
        rationale: Reason for this value; not empty where it is assumed.
        source: Its source; not empty unless it is assumed.
    """

    value: float
    unit: str
    assumption: bool
    rationale: str
    source: str


@document_dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Role:
    """A role and the units of the properties that its components have besides a cost."""

    id: Identifier
    name: Text
    properties: dict[Identifier, UnitText] = field(default_factory=dict)
    sets: dict[Identifier, SettableField] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """Something that can fill a role.

    Attributes:
        id: Its id, such as ``kg-3-light``.
        role: The id of its role.
        name: Its name.
        manufacturer: Its manufacturer or publisher.
        matches: The parameter values that select it, as they are written in the catalogue;
            empty when it suits every design.
        geometry: The file with its geometry, relative to the project; empty if it has none.
        cost: Its cost.
        properties: Its other properties, by name.
        sets: The quantity of `SETTABLE_QUANTITIES` that a property sets, by property; the same for the whole role.
    """

    id: str
    role: str
    name: str
    manufacturer: str
    matches: Mapping[str, tuple[ParameterValue, ...]]
    geometry: str
    cost: SourcedValue
    properties: Mapping[str, SourcedValue]
    sets: Mapping[str, str] = field(default_factory=dict)

    @property
    def mass_kg(self) -> float | None:
        """Its mass; None where its role has no property ``mass``."""
        mass = self.properties.get("mass")
        return None if mass is None else mass.value

    @property
    def assumptions(self) -> Mapping[str, str]:
        """The rationale of each of its values that is assumed, by name; ``cost`` is one."""
        values = {"cost": self.cost, **self.properties}
        return {name: value.rationale for name, value in values.items() if value.assumption}

    def magnitudes(self) -> Mapping[str, float]:
        """Its cost and properties in SI, by name."""
        return {"cost": self.cost.value, **{name: value.value for name, value in self.properties.items()}}


@dataclass(frozen=True, slots=True, kw_only=True)
class Catalogue:
    """The components that designs choose from.

    Attributes:
        roles: Every role, in the order of the file.
        components: Every component, in the order of the file.
        document: The file, for findings that need another file to be seen.
    """

    roles: tuple[Role, ...]
    components: tuple[Component, ...]
    document: Document = field(repr=False, compare=False)

    def of_role(self, role: str) -> tuple[Component, ...]:
        """The components of a role, in the order of the file."""
        return tuple(component for component in self.components if component.role == role)
