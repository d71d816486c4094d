"""Components of designs, and the component catalogue."""

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
        value: The magnitude in SI (money in its currency).
        unit: Its unit.
        assumption: True if it is assumed instead of taken from a source.
        rationale: Reason for this value; required if it is assumed.
        source: Its source; required unless it is assumed.
    """

    value: float
    unit: str
    assumption: bool
    rationale: str
    source: str


@document_dataclass(frozen=True, slots=True, kw_only=True, config=STRICT)
class Role:
    """Role, with the units of its components' properties other than the cost."""

    id: Identifier
    name: Text
    properties: dict[Identifier, UnitText] = field(default_factory=dict)
    sets: dict[Identifier, SettableField] = field(default_factory=dict)


@dataclass(frozen=True, slots=True, kw_only=True)
class Component:
    """Component of a role.

    Attributes:
        id: Its id, such as ``kg-3-light``.
        role: The id of its role.
        name: Its name.
        manufacturer: Its manufacturer or publisher.
        matches: The parameter values that select it, as written in the catalogue; empty if it suits every design.
        geometry: The file with its geometry, relative to the project; empty if it has none.
        cost: Its cost.
        properties: Its other properties, by name.
        sets: The quantity of `SETTABLE_QUANTITIES` set by a property, by property; equal for the whole role.
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
        """Its mass in kg; None if its role has no property ``mass``."""
        mass = self.properties.get("mass")
        return None if mass is None else mass.value

    @property
    def assumptions(self) -> Mapping[str, str]:
        """Rationale of each of its assumed values, by name, including ``cost``."""
        values = {"cost": self.cost, **self.properties}
        return {name: value.rationale for name, value in values.items() if value.assumption}

    def magnitudes(self) -> Mapping[str, float]:
        """Its cost and properties in SI, by name."""
        return {"cost": self.cost.value, **{name: value.value for name, value in self.properties.items()}}


@dataclass(frozen=True, slots=True, kw_only=True)
class Catalogue:
    """Component catalogue.

    Attributes:
        roles: Every role, in the order of the file.
        components: Every component, in the order of the file.
        document: The file, for findings that depend on other files.
    """

    roles: tuple[Role, ...]
    components: tuple[Component, ...]
    document: Document = field(repr=False, compare=False)

    @property
    def currency(self) -> str:
        """Code of the currency of every cost."""
        return self.components[0].cost.unit

    def of_role(self, role: str) -> tuple[Component, ...]:
        """The components of a role, in the order of the file."""
        return tuple(component for component in self.components if component.role == role)
