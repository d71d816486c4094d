"""Values of the settable quantities of each variant, and the trial that they make."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from enum import Enum
from typing import Any

from rgss.designs import (
    PLANNER_PREFIX,
    PLANNER_QUANTITIES,
    SETTABLE_QUANTITIES,
    Application,
    DesignVariant,
    ParameterKind,
    ParameterValue,
    SettableQuantity,
)
from rgss.errors import DefinitionError
from rgss.findings import shown
from rgss.scenes import GripperFile, GripperGeometry
from rgss.trials.pieces import TrialSpec


def values_of(variant: DesignVariant, defaults: Mapping[str, ParameterValue]) -> dict[str, ParameterValue]:
    """The value of each settable quantity: of the design's parameters, its components, else the default.

    Args:
        variant: The design.
        defaults: The values where the design sets none, by quantity.
    """
    values = dict(defaults)
    for component in variant.components.values():
        values.update({name: component.properties[own].value for own, name in component.sets.items()})
    values.update({one.sets: variant.parameters[one.id] for one in variant.definitions if one.sets})
    return values


def with_values(spec: TrialSpec, values: Mapping[str, ParameterValue]) -> TrialSpec:
    """A trial with its settable quantities set.

    Args:
        spec: The trial; what is required of it has no value yet.
        values: The value of each quantity, by name.

    Raises:
        DefinitionError: A required quantity has no value, or one of another kind.
    """
    for quantity in (*SETTABLE_QUANTITIES.values(), *PLANNER_QUANTITIES.values()):
        value = values.get(quantity.name)
        if value is None:
            if quantity.required:
                raise DefinitionError(
                    f"variant {spec.variant} has no value of {quantity.name}",
                    hint=f"add a design parameter with 'sets: {quantity.name}', or {quantity.default}",
                )
            continue
        if isinstance(value, str) != (quantity.kind is ParameterKind.NAME):
            kind = "a name" if quantity.kind is ParameterKind.NAME else "a number"
            raise DefinitionError(f"{quantity.name} of variant {spec.variant} must be {kind}, got {value!r}")
        spec = _applied(spec, quantity, value)
    return spec


def _applied(spec: TrialSpec, quantity: SettableQuantity, value: ParameterValue) -> TrialSpec:
    if quantity.application is Application.PLANNER_PARAMETER:
        name = quantity.name.removeprefix(PLANNER_PREFIX)
        return replace(spec, planner_settings=spec.planned_by.with_parameter(name, float(value)))
    if quantity.application is Application.PLACEMENT:
        return spec  # of the scene that `Project.scene_of` makes, since frames move with the base
    path = quantity.field.split(".")
    present = field_of(spec, quantity.field)
    if quantity.application is Application.REQUIRE:
        if present != value:
            raise DefinitionError(
                f"{quantity.name} of variant {spec.variant} must equal {quantity.default}, which is {present:g}, "
                f"got {value:g}",
                hint="let the catalogue match the design with a component of another geometry",
            )
        return spec
    if isinstance(present, Enum):
        chosen: TrialSpec = _replaced(spec, path, type(present)(value))
        return chosen
    if quantity.application is Application.ADD_FOR_EACH_FINGER:
        value = present + spec.gripper.geometry.fingers * value
    elif quantity.kind is ParameterKind.COUNT:
        value = int(value)
    return spec if present == value else _replaced(spec, path, value)


def field_of(spec: TrialSpec, path: str) -> Any:
    """The value of a field of a trial or of what it is made of.

    Args:
        spec: The trial.
        path: The field, such as ``gripper.finger_mass_kg``.
    """
    found: Any = spec
    for name in path.split("."):
        found = getattr(found, name)
    return found


def _replaced(owner: Any, path: list[str], value: ParameterValue | Enum) -> Any:
    name, *rest = path
    return replace(owner, **{name: _replaced(getattr(owner, name), rest, value) if rest else value})


def mounted(file: GripperFile, mounting: ParameterValue | None, variant: int) -> GripperGeometry:
    """The shape of a gripper in the mounting of a design.

    Args:
        file: The gripper.
        mounting: Mounting that the design sets; None for the gripper's own.
        variant: Id of the design.

    Raises:
        DefinitionError: The gripper has no such mounting.
    """
    name = file.mounting if mounting is None else mounting
    if isinstance(name, str) and name in file.mountings:
        return file.mountings[name]
    raise DefinitionError(
        f"gripper {file.geometry.id} of variant {variant} has no mounting {shown(str(name))}", hint=_known(file)
    )


def _known(file: GripperFile) -> str:
    names = [name for name in file.mountings if name]
    return f"mountings: {', '.join(names)}" if names else "state the name of its only one in its file, 'mounting: NAME'"
