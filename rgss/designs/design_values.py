"""Values of a design for measures and rules."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

from rgss.designs.components import Catalogue, Component
from rgss.designs.parameters import DesignParameter, ParameterValue

if TYPE_CHECKING:
    from rgss.designs.variants import DesignVariant

COMPONENT_PREFIX = "component."
DESIGN_PREFIX = "design."


def sources(variant: DesignVariant) -> Mapping[str, float | str]:
    """Values of a design for measures, in SI.

    Returns:
        ``design.<parameter>`` for every parameter, then ``component.<role>.<property>`` for
        every component, where ``cost`` is a property of each.
    """
    named = {f"{DESIGN_PREFIX}{name}": value for name, value in variant.parameters.items()}
    return {**named, **numbers(variant.parameters, variant.components)}


def numbers(parameters: Mapping[str, ParameterValue], components: Mapping[str, Component]) -> Mapping[str, float]:
    """Numbers of a combination of parameter values and components, with the names of `sources`."""
    found: dict[str, float] = {}
    for name, value in parameters.items():
        if not isinstance(value, str):
            found[f"{DESIGN_PREFIX}{name}"] = value
    for role, component in components.items():
        for name, magnitude in component.magnitudes().items():
            found[f"{COMPONENT_PREFIX}{role}.{name}"] = magnitude
    return found


def set_names(parameters: Iterable[DesignParameter]) -> Mapping[str, str]:
    """Name of each parameter in `sources`, by the quantity that it sets."""
    return {one.sets: f"{DESIGN_PREFIX}{one.id}" for one in parameters if one.sets}


def number_aliases(parameters: Iterable[DesignParameter]) -> Mapping[str, str]:
    """Aliases of the parameters in `sources`: the quantity that each sets, its id and its name, if unique."""
    known = tuple(parameters)
    named = {one.name: f"{DESIGN_PREFIX}{one.id}" for one in known}
    return {**named, **{one.id: f"{DESIGN_PREFIX}{one.id}" for one in known}, **set_names(known)}


def source_units(parameters: Iterable[DesignParameter], catalogue: Catalogue) -> Mapping[str, str]:
    """SI unit of each value of `sources`, by name; empty for names."""
    units = {f"{DESIGN_PREFIX}{parameter.id}": parameter.unit for parameter in parameters}
    for role in catalogue.roles:
        for name, unit in {"cost": catalogue.currency, **role.properties}.items():
            units[f"{COMPONENT_PREFIX}{role.id}.{name}"] = unit
    return units
