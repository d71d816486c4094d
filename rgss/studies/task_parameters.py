"""What the task needs of the designs: their parameters, components and shapes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from rgss.designs import DesignSpace
from rgss.documents import Document
from rgss.findings import Finding, shown
from rgss.quantities import dimension
from rgss.scenes import GripperGeometry

FINGERS, FINGER_MASS, BASE_MASS, FINGER_VELOCITY, FINGER_FORCE, FRICTION, TOOL_SPEED, PLANNER, PLANNING_LIMIT = (
    f"d{number}" for number in range(1, 10)
)
GRIPPER, FINGER_ACTUATOR = "gripper", "finger_actuator"

_UNITS: Mapping[str, str] = MappingProxyType(
    {
        FINGERS: "1",
        FINGER_MASS: "kg",
        BASE_MASS: "kg",
        FINGER_VELOCITY: "m/s",
        FINGER_FORCE: "N",
        FRICTION: "1",
        TOOL_SPEED: "m/s",
        PLANNER: "",
        PLANNING_LIMIT: "s",
    }
)
"""The unit of each parameter that a trial is made of; empty for a name."""

_SLOWEST_M_S = 1.0e-3
_SPEEDS = frozenset({FINGER_VELOCITY, TOOL_SPEED})

_Location = tuple["str | int", ...]


def task_findings(
    designs: DesignSpace, document: Document, grippers: Mapping[str, GripperGeometry]
) -> Iterator[Finding]:
    """Find what would keep a trial of a design from being run.

    Args:
        designs: The design space.
        document: Its file, for positions.
        grippers: The shape of each gripper component, by its file.
    """
    yield from _parameter_findings(designs, document)
    yield from _value_findings(designs, document)
    yield from _component_findings(designs, grippers)


def _parameter_findings(designs: DesignSpace, document: Document) -> Iterator[Finding]:
    units = {parameter.id: parameter.unit for parameter in designs.parameters}
    places = {parameter.id: index for index, parameter in enumerate(designs.parameters)}
    for name, unit in _UNITS.items():
        at: _Location = ("parameters", places[name], "id") if name in places else ("parameters",)
        if name not in units:
            message = f"the task needs the design parameter {name!r}"
        elif (not unit) != (not units[name]) or (unit and dimension(unit) != dimension(units[name])):
            message = f"{name} must be {f'a quantity in {unit!r}' if unit else 'a name'} for the task"
        else:
            continue
        yield document.finding("design.task-parameter", message, at, hint="a trial is made of d1 to d9")


def _value_findings(designs: DesignSpace, document: Document) -> Iterator[Finding]:
    from rgss.motion import PLANNERS

    for location, name, value in _settings(designs):
        if name == PLANNER and value not in PLANNERS:
            message = f"there is no planner {shown(value)}"
            yield document.finding("design.planner", message, location, hint=f"planners: {', '.join(PLANNERS)}")
        elif _UNITS.get(name) and not isinstance(value, str) and not value > 0:
            message = f"{name} must be greater than zero"
            yield document.finding("design.not-positive", message, location)
        elif name in _SPEEDS and not isinstance(value, str) and value < _SLOWEST_M_S:
            message = f"{name} must be at least 1 mm/s"
            hint = "a slower arm or hand would need hours for the task"
            yield document.finding("design.too-slow", message, location, hint=hint)


def _settings(designs: DesignSpace) -> Iterator[tuple[_Location, str, float | int | str]]:
    """Every value that the file gives to a parameter, and where."""
    for name, value in designs.constants.items():
        yield ("constants", name), name, value
    for number, factor in enumerate(designs.factors):
        if factor.span is not None:
            for end, bound in enumerate((factor.span.low, factor.span.high)):
                yield ("factors", number, "range", end), factor.span.parameter, bound
        for place, level in enumerate(factor.levels):
            for name, value in level.values.items():
                yield ("factors", number, "levels", place, "sets", name), name, value


def _component_findings(designs: DesignSpace, grippers: Mapping[str, GripperGeometry]) -> Iterator[Finding]:
    catalogue = designs.catalogue
    document = catalogue.document
    roles = [role.id for role in catalogue.roles]
    for role in (GRIPPER, FINGER_ACTUATOR):
        if role not in roles:
            message = f"the task needs components of the role {role!r}"
            yield document.finding("design.task-role", message, ("roles",), hint=f"roles: {', '.join(roles)}")
    for index, component in enumerate(catalogue.components):
        if component.role != GRIPPER:
            continue
        if not component.geometry:
            message = f"gripper {component.id!r} has no geometry"
            yield document.finding(
                "design.geometry", message, ("components", index), hint="name the file of its shape under 'geometry'"
            )
            continue
        shape = grippers.get(component.geometry)
        counts = designs.selectors[component.id].get(FINGERS, ())
        if shape is not None and any(count != shape.fingers for count in counts):
            message = f"{component.id!r} is for {FINGERS} = {_listed(counts)}, its shape has {shape.fingers} fingers"
            yield document.finding(
                "design.geometry", message, ("components", index, "geometry"), hint="name the file of another shape"
            )


def _listed(counts: tuple[float | int | str, ...]) -> str:
    return " or ".join(f"{count:g}" if isinstance(count, float) else str(count) for count in counts)
