"""Design variant: a value for every parameter and a component for every role."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from rgss.designs.components import Component
from rgss.designs.parameters import DesignParameter, ParameterValue
from rgss.documents import digest


@dataclass(frozen=True, slots=True, kw_only=True)
class DesignVariant:
    """Design variant of a design space.

    Attributes:
        id: Its position in the full factorial, or among the points of the sample, from 1; rules that exclude other
        combinations do not change it.
        parameters: The value of every design parameter, in SI, in the order of the file.
        components: The component of each role, in the order of the catalogue.
        levels: The id of its level of each factor, by factor; for a range the value with its unit, such as ``0.47
        m/s``.
        definitions: Definition of each of its parameters.
    """

    id: int
    parameters: Mapping[str, ParameterValue]
    components: Mapping[str, Component]
    levels: Mapping[str, str]
    definitions: tuple[DesignParameter, ...] = field(repr=False)

    @property
    def digest(self) -> str:
        """SHA-256 of its parameters and components.

        It covers the values of the parameters and each component's id, geometry, cost and properties, but neither the
        id of the variant nor any text.
        """
        components = {
            role: {"id": component.id, "geometry": component.geometry, "values": component.magnitudes()}
            for role, component in self.components.items()
        }
        return digest({"parameters": self.parameters, "components": components})

    def columns(self) -> Mapping[str, ParameterValue]:
        """Values of its parameters by column, such as ``m_f_finger_mass_kg``, in order."""
        return {definition.column: self.parameters[definition.id] for definition in self.definitions}
