"""Numbers of the model (costs, properties, constants), and the model with another value of one."""

from __future__ import annotations

from dataclasses import dataclass, replace

from rgss.designs import COMPONENT_PREFIX, Component, DesignVariant, si_unit
from rgss.measures import MeasureSet
from rgss.studies import Project

CATALOGUE, MEASURES = "catalogue", "measures"
COST = "cost"


@dataclass(frozen=True, slots=True, kw_only=True)
class ModelNumber:
    """A cost or property of a component, or a constant of the measures.

    Attributes:
        id: Its name on the command line: ``catalogue.<component>.<property>`` or
            ``measures.<constant>``.
        value: Its value in SI (money in its currency).
        unit: The unit of the value.
        rationale: Reason for the assumption; empty unless it is assumed.
        component: The component; empty for a constant.
        role: The component's role; empty for a constant.
        name: The property, or the constant's symbol.
    """

    id: str
    value: float
    unit: str
    rationale: str
    component: str
    role: str
    name: str

    @property
    def is_assumed(self) -> bool:
        """True if it is an assumption and has no source."""
        return bool(self.rationale)

    @property
    def source(self) -> str:
        """Name of its source in measures and rules; empty for a constant."""
        return f"{COMPONENT_PREFIX}{self.role}.{self.name}" if self.component else ""


def model_numbers(project: Project) -> tuple[ModelNumber, ...]:
    """Every number of the catalogue, then every constant of the measures, in the order of the files."""
    of_components = [
        ModelNumber(
            id=f"{CATALOGUE}.{component.id}.{name}",
            value=sourced.value,
            unit=sourced.unit,
            rationale=sourced.rationale if sourced.assumption else "",
            component=component.id,
            role=component.role,
            name=name,
        )
        for component in project.designs.catalogue.components
        for name, sourced in {COST: component.cost, **component.properties}.items()
    ]
    # A number from a source is assumed where an assumption is about taking it.
    concerned = {each: one.rationale for one in project.measures.assumptions for each in one.concerns}
    constants = [
        ModelNumber(
            id=f"{MEASURES}.{constant.id}",
            value=constant.value,
            unit=si_unit(constant.unit),
            rationale=concerned.get(constant.id, "") if constant.source else constant.definition,
            component="",
            role="",
            name=constant.id,
        )
        for constant in project.measures.constants
    ]
    return (*of_components, *constants)


def assumed_numbers(project: Project) -> tuple[ModelNumber, ...]:
    """The assumed numbers."""
    return tuple(number for number in model_numbers(project) if number.is_assumed)


def symbols_of(measures: MeasureSet, number: ModelNumber) -> frozenset[str]:
    """Symbols of expressions whose value is a number."""
    if not number.component:
        return frozenset({number.name})
    return frozenset(symbol.id for symbol in measures.inputs if symbol.source == number.source)


def with_number(project: Project, number: ModelNumber, value: float) -> Project:
    """The project with another value of one number; dependent values follow.

    Args:
        project: The project.
        number: The number.
        value: Its value in SI.
    """
    if not number.component:
        return replace(project, measures=measures_with(project.measures, number, value))
    catalogue = project.designs.catalogue
    components = tuple(
        component_with(component, number, value) if component.id == number.component else component
        for component in catalogue.components
    )
    return replace(project, designs=replace(project.designs, catalogue=replace(catalogue, components=components)))


def measures_with(measures: MeasureSet, number: ModelNumber, value: float) -> MeasureSet:
    """The measures with another value of a constant; the same for a number of the catalogue."""
    if number.component:
        return measures
    constants = tuple(
        replace(constant, value=value) if constant.id == number.name else constant for constant in measures.constants
    )
    return replace(measures, constants=constants)


def variant_with(variant: DesignVariant, number: ModelNumber, value: float) -> DesignVariant:
    """A variant with another value of a component's number; the same if it has no such component."""
    component = variant.components.get(number.role)
    if component is None or component.id != number.component:
        return variant
    return replace(variant, components={**variant.components, number.role: component_with(component, number, value)})


def component_with(component: Component, number: ModelNumber, value: float) -> Component:
    """A component with another value of its cost or of a property."""
    if number.name == COST:
        return replace(component, cost=replace(component.cost, value=value))
    properties = {
        name: replace(sourced, value=value) if name == number.name else sourced
        for name, sourced in component.properties.items()
    }
    return replace(component, properties=properties)
