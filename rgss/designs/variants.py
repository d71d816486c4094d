"""One design: a value for every parameter and a component for every role."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.designs.components import Component
from rgss.designs.parameters import DesignParameter, ParameterValue
from rgss.documents import digest


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignVariant:
    """One design of a design space.

    Attributes:
        id: Its position in the full product of the factors, or among the points of the sample,
            from 1; a rule that excludes other combinations does not change it.
        parameters: The value of every design parameter, in SI, in the order of the file.
        components: The component that fills each role, by role, in the order of the catalogue.
        levels: The id of the level that it has of each factor, by factor; of a range its value
            with the unit, such as ``0.47 m/s``.
        definitions: What each of its parameters is.
    """

    id: int
    parameters: Mapping[str, ParameterValue]
    components: Mapping[str, Component]
    levels: Mapping[str, str]
    definitions: tuple[DesignParameter, ...] = field(repr=False)

    @property
    def digest(self) -> str:
        """SHA-256 of what it is made of.

        It covers the values of the parameters and each component's id, geometry, cost and
        properties; neither the id of the variant nor any prose.
        """
        components = {
            role: {"id": component.id, "geometry": component.geometry, "values": component.magnitudes()}
            for role, component in self.components.items()
        }
        return digest({"parameters": self.parameters, "components": components})

    def columns(self) -> Mapping[str, ParameterValue]:
        """The values of its parameters by column, such as ``m_f_finger_mass_kg``, in order."""
        return {definition.column: self.parameters[definition.id] for definition in self.definitions}
