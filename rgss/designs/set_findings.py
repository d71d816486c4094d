"""Findings about the quantities set by parameters and properties of components."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rgss.designs.components import Catalogue, Component, Role
from rgss.designs.findings import near_hint
from rgss.designs.parameters import DesignParameter, ParameterKind, ParameterValue, read_magnitude
from rgss.designs.settable import SettableQuantity
from rgss.designs.settable_quantities import CATALOGUE_PREFIX, settable_quantity
from rgss.designs.space import DesignSpace
from rgss.documents import Document
from rgss.errors import DefinitionError, QuantityError
from rgss.findings import Finding, shown
from rgss.quantities import dimension

_Location = tuple["str | int", ...]
_RULE = "design.sets"


def parameter_set_findings(
    document: Document, parameters: Sequence[DesignParameter], catalogue: Catalogue
) -> Iterator[Finding]:
    """Findings about parameters whose kind or unit does not match the quantity, and quantities set twice.

    Args:
        document: The file of the design space.
        parameters: The parameters, in the order of the file.
        catalogue: The catalogue, whose properties also set quantities.
    """
    setters = {
        quantity: f"property {name!r} of role {role.id!r} in {_place(catalogue.document, index, name)}"
        for index, role in enumerate(catalogue.roles)
        for name, quantity in role.sets.items()
    }
    for index, parameter in enumerate(parameters):
        if not parameter.sets:
            continue
        place: _Location = ("parameters", index, "sets")
        if parameter.sets.startswith(CATALOGUE_PREFIX):
            yield from _catalogue_findings(document, place, parameter, catalogue)
        else:
            problem = _kind_problem(parameter.kind, parameter.unit, _setting(parameter.sets))
            if problem:
                message, hint = problem
                yield document.finding(_RULE, f"{parameter.id} {message}", place, hint=hint)
        if parameter.sets in setters:
            message = f"{parameter.sets} is already set by {setters[parameter.sets]}"
            yield document.finding("design.set-twice", message, place, hint="set it in one place")
        else:
            line, _ = document.values[place]
            setters[parameter.sets] = f"{parameter.id} in line {line}"


def role_set_findings(document: Document, roles: Sequence[Role]) -> Iterator[Finding]:
    """Findings about properties that cannot set their quantity, and quantities set twice.

    Args:
        document: The file of the catalogue.
        roles: The roles, in the order of the file.
    """
    setters: dict[str, str] = {}
    for index, role in enumerate(roles):
        for name, quantity in role.sets.items():
            place: _Location = ("roles", index, "sets", name)
            if name not in role.properties:
                hint = near_hint(name, role.properties, f"properties of a {role.id}")
                message = f"a {role.id} has no property {name!r}"
                yield document.finding("design.unknown-property", message, place, hint=hint, at_key=True)
                continue
            if quantity.startswith(CATALOGUE_PREFIX):
                message, hint = f"property {name!r} cannot select a component", "use a parameter instead"
                yield document.finding(_RULE, message, place, hint=hint)
                continue
            setting = _setting(quantity)
            kind = ParameterKind.COUNT if setting.kind is ParameterKind.COUNT else ParameterKind.QUANTITY
            problem = _kind_problem(kind, role.properties[name], setting)
            if problem:
                yield document.finding(_RULE, f"property {name!r} {problem[0]}", place, hint=problem[1])
            if quantity in setters:
                message = f"{quantity} is already set by {setters[quantity]}"
                yield document.finding("design.set-twice", message, place, hint="set it in one place")
            line, _ = document.values[place]
            setters.setdefault(quantity, f"property {name!r} of role {role.id!r} in line {line}")


def component_set_findings(document: Document, components: Sequence[Component]) -> Iterator[Finding]:
    """Findings about values of components out of the range of their quantity.

    Args:
        document: The file of the catalogue.
        components: The components, in the order of the file.
    """
    for index, component in enumerate(components):
        for name, quantity in component.sets.items():
            setting, value = _setting(quantity), component.properties[name].value
            place: _Location = ("components", index, "properties", name, "value")
            if setting.kind is ParameterKind.COUNT and not value.is_integer():
                message = f"{name} sets {quantity} and must be a whole number, got {value:g}"
                yield document.finding("design.value", message, place, hint="write a count, such as 2")
            else:
                yield from value_findings(document, place, name, setting, value)


def design_value_findings(designs: DesignSpace, document: Document) -> Iterator[Finding]:
    """Findings about values of parameters out of the range of their quantity."""
    settings = {one.id: settable_quantity(one.sets) for one in designs.parameters}
    for place, name, value in written_values(designs):
        setting = settings[name]
        if setting is not None:
            yield from value_findings(document, place, name, setting, value)


def written_values(designs: DesignSpace) -> Iterator[tuple[_Location, str, ParameterValue]]:
    """All values of parameters in the file, with their locations."""
    for name, value in designs.constants.items():
        yield ("constants", name), name, value
    for number, factor in enumerate(designs.factors):
        if factor.span is not None:
            for end, bound in enumerate((factor.span.low, factor.span.high)):
                yield ("factors", number, "range", end), factor.span.parameter, bound
        for place, level in enumerate(factor.levels):
            for name, value in level.values.items():
                yield ("factors", number, "levels", place, "sets", name), name, value


def value_findings(
    document: Document, place: _Location, name: str, setting: SettableQuantity, value: ParameterValue
) -> Iterator[Finding]:
    """Findings about a value out of the range of its quantity.

    Args:
        document: The file.
        place: Location of the value.
        name: Its key.
        setting: The quantity that it sets.
        value: The value in SI.
    """
    if isinstance(value, str):
        if setting.choices and value not in setting.choices:
            message = f"{name} must be {' or '.join(setting.choices)}, got {shown(value)}"
            yield document.finding("design.choice", message, place, hint=near_hint(value, setting.choices, "names"))
        return
    if setting.positive and value <= 0:
        yield document.finding("design.not-positive", f"{name} must be greater than zero", place)
    elif setting.least and value < read_magnitude(setting.least, setting.unit):
        rule = "design.too-slow" if setting.positive else "design.negative"
        message = f"{name} must be at least {setting.least}"
        yield document.finding(rule, message, place, hint=setting.least_reason)
    elif setting.greatest and value > read_magnitude(setting.greatest, setting.unit):
        message = f"{name} must be at most {setting.greatest}, got {value:g}"
        yield document.finding("design.too-great", message, place, hint=setting.greatest_reason)


def _catalogue_findings(
    document: Document, place: _Location, parameter: DesignParameter, catalogue: Catalogue
) -> Iterator[Finding]:
    role = parameter.sets.removeprefix(CATALOGUE_PREFIX)
    roles = [known.id for known in catalogue.roles]
    if role not in roles:
        hint = near_hint(role, roles, "known roles")
        yield document.finding("design.unknown-role", f"unknown role {role!r}", place, hint=hint)
    elif parameter.kind is not ParameterKind.NAME:
        message = f"{parameter.id} must be a name to set {parameter.sets}"
        yield document.finding(_RULE, message, place, hint="write 'kind: name'; its values are ids of components")
    elif parameter.role != role:
        message = f"{parameter.id} has the role {parameter.role!r} and sets {parameter.sets}"
        yield document.finding(_RULE, message, place, hint="remove 'role'")


def _kind_problem(kind: ParameterKind, unit: str, setting: SettableQuantity) -> tuple[str, str] | None:
    if kind is not setting.kind:
        wanted = "a quantity" if setting.kind is ParameterKind.QUANTITY else f"a {setting.kind.value}"
        return f"must be {wanted} to set {setting.name}", f"write 'kind: {setting.kind.value}'"
    try:
        if unit and dimension(unit) != dimension(setting.unit):
            return f"must be a quantity in {setting.unit!r} to set {setting.name}, not in {unit!r}", "correct the unit"
    except QuantityError:
        return None  # An unknown unit has its own finding.
    return None


def _setting(name: str) -> SettableQuantity:
    found = settable_quantity(name)
    if found is None:  # the model of the file accepts no other name
        raise DefinitionError(f"unknown quantity {name!r}")
    return found


def _place(document: Document, role: int, name: str) -> str:
    line, _ = document.values["roles", role, "sets", name]
    return f"{document.label}:{line}"
