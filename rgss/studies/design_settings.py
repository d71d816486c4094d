"""Findings about designs of which no trial can be made, before anything is simulated."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.designs import (
    PLANNER_PREFIX,
    SETTABLE_QUANTITIES,
    DesignSpace,
    ParameterValue,
    format_value,
    written_values,
)
from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding, shown
from rgss.motion import available_planners
from rgss.scenes import GripperFile, Robot, motion_of, pad_limits
from rgss.studies.planning import PlanningChoice, planner_problem, require_value
from rgss.studies.trial_values import values_of

GRIPPER = "gripper"
"""The role of the components that have a gripper file."""

TIME_LIMIT = "planning.time_limit"
PLANNER = "planning.planner"
MOUNTING = "gripper.mounting"
_FINGERS, _TOOL_SPEED = "gripper.fingers", "robot.tool_speed"
_FORCE, _SPEED = "gripper.finger.force", "gripper.finger.speed"
_ROUNDING = 1.0 + 1e-9


def design_findings(
    designs: DesignSpace,
    document: Document,
    grippers: Mapping[str, GripperFile],
    robots: Sequence[Robot],
    planning: PlanningChoice,
) -> Iterator[Finding]:
    """Findings on designs whose trials cannot be run.

    Args:
        designs: The design space.
        document: Its file, for positions.
        grippers: The gripper file of each gripper component, by its name.
        robots: The arms of the designs, which give values where no design does.
        planning: The study's planning, which gives values too.
    """
    given = [(robot.id, default_values(robot, planning)) for robot in robots]
    yield from _missing_findings(designs, document, grippers, given)
    yield from _planner_findings(designs, document, planning)
    yield from _planner_parameter_findings(designs, document, planning)
    yield from _component_findings(designs, grippers)
    yield from _finger_findings(designs, document, grippers)
    yield from _mounting_findings(designs, document, grippers)
    yield from _linkage_findings(designs, document, grippers)


def default_values(robot: Robot, planning: PlanningChoice) -> Mapping[str, ParameterValue]:
    """The values that the robot and the study give where no design does, by quantity."""
    given = {_TOOL_SPEED: robot.tool_speed_m_s, PLANNER: planning.planner or None, TIME_LIMIT: planning.time_limit_s}
    return {name: value for name, value in given.items() if value is not None}


def setters_of(designs: DesignSpace) -> frozenset[str]:
    """The quantities that parameters or properties of components set."""
    of_roles = (quantity for role in designs.catalogue.roles for quantity in role.sets.values())
    return frozenset({*of_roles, *(parameter.sets for parameter in designs.parameters)})


def _missing_findings(
    designs: DesignSpace,
    document: Document,
    grippers: Mapping[str, GripperFile],
    defaults: Sequence[tuple[str, Mapping[str, ParameterValue]]],
) -> Iterator[Finding]:
    given = setters_of(designs)
    for quantity in SETTABLE_QUANTITIES.values():
        without = [robot for robot, values in defaults if quantity.name not in values]
        if not quantity.required or quantity.name in given or not without:
            continue
        message = f"nothing sets {quantity.name}"
        if len(without) < len(defaults):
            message += f" of {' and '.join(without)}"
        if quantity.default.endswith("the gripper file"):
            lacking = [name for name, file in grippers.items() if quantity.name not in file.settings]
            if not lacking:
                continue
            message += f" of {lacking[0]}"
        hint = f"add 'sets: {quantity.name}' to a parameter, or {quantity.default}"
        yield document.finding("design.unset-quantity", message, ("parameters",), hint=hint)


def _planner_findings(designs: DesignSpace, document: Document, planning: PlanningChoice) -> Iterator[Finding]:
    planners = {parameter.id for parameter in designs.parameters if parameter.sets == PLANNER}
    for location, name, value in written_values(designs):
        if name in planners and (problem := planner_problem(str(value), planning.planners)):
            message, hint = problem
            yield document.finding("design.planner", message, location, hint=hint)


def _planner_parameter_findings(
    designs: DesignSpace, document: Document, planning: PlanningChoice
) -> Iterator[Finding]:
    """Parameters of planners that designs set on a planner which does not have them, or out of its range."""
    if not any(name.startswith(PLANNER_PREFIX) for name in setters_of(designs)):
        return
    found: dict[tuple[str, str, float], int] = {}
    for variant in designs.expand():
        values = values_of(variant, {PLANNER: planning.planner})
        for name, value in values.items():
            if name.startswith(PLANNER_PREFIX) and isinstance(value, (int, float)):
                found.setdefault((str(values[PLANNER]), name, value), variant.id)
    for (planner, name, value), number in found.items():
        algorithm = planning.planner_settings(planner).algorithm
        if algorithm not in available_planners():
            continue  # it has its own finding
        try:
            require_value(available_planners()[algorithm], name.removeprefix(PLANNER_PREFIX), value)
        except QuantityError as error:
            ids = {parameter.id for parameter in designs.parameters if parameter.sets == name}
            places = (place for place, own, written in written_values(designs) if own in ids and written == value)
            message = f"variant {number}: {error.message}"
            yield document.finding("design.planner-parameter", message, next(places, ("parameters",)), hint=error.hint)


def _component_findings(designs: DesignSpace, grippers: Mapping[str, GripperFile]) -> Iterator[Finding]:
    catalogue = designs.catalogue
    document = catalogue.document
    roles = [role.id for role in catalogue.roles]
    if GRIPPER not in roles:
        message = f"the task needs components of the role {GRIPPER!r}"
        yield document.finding("design.task-role", message, ("roles",), hint=f"roles: {', '.join(roles)}")
    counting = [parameter.id for parameter in designs.parameters if parameter.sets == _FINGERS]
    for index, component in enumerate(catalogue.components):
        if component.role != GRIPPER:
            continue
        if not component.geometry:
            message = f"gripper {component.id!r} has no geometry"
            hint = "name the file of its shape under 'geometry'"
            yield document.finding("design.geometry", message, ("components", index), hint=hint)
            continue
        file = grippers.get(component.geometry)
        for name in counting:
            counts = designs.selectors[component.id].get(name, ())
            if file is not None and any(count != file.geometry.fingers for count in counts):
                listed = " or ".join(format_value(count) for count in counts)
                message = f"{component.id!r} is for {name} = {listed}, its shape has {file.geometry.fingers} fingers"
                hint = "name the file of another shape"
                yield document.finding("design.geometry", message, ("components", index, "geometry"), hint=hint)


def _finger_findings(
    designs: DesignSpace, document: Document, grippers: Mapping[str, GripperFile]
) -> Iterator[Finding]:
    """Numbers of fingers that the gripper of a design does not have, where no component is matched by the number."""
    ids = {parameter.id for parameter in designs.parameters if parameter.sets == _FINGERS}
    found: dict[tuple[str, float], int] = {}
    for variant in designs.expand() if ids else ():
        component = variant.components.get(GRIPPER)
        if component is None or component.geometry not in grippers or ids & set(designs.selectors[component.id]):
            continue
        count = values_of(variant, {}).get(_FINGERS)
        if isinstance(count, (int, float)) and count != grippers[component.geometry].geometry.fingers:
            found.setdefault((component.geometry, count), variant.id)
    for (geometry, count), number in found.items():
        fingers = grippers[geometry].geometry.fingers
        places = (place for place, own, written in written_values(designs) if own in ids and written == count)
        yield document.finding(
            "design.fingers",
            f"variant {number}: {_FINGERS} is {count:g}, but {geometry} has {fingers} fingers",
            next(places, ("parameters",)),
            hint=f"set it to {fingers}, or take a gripper of {count:g} fingers",
        )


def _mounting_findings(
    designs: DesignSpace, document: Document, grippers: Mapping[str, GripperFile]
) -> Iterator[Finding]:
    """Find mountings that a design sets and no gripper has.

    Args:
        designs: The design space.
        document: Its file, for positions.
        grippers: The gripper file of each gripper component, by its name.
    """
    ids = {parameter.id for parameter in designs.parameters if parameter.sets == MOUNTING}
    known = {name for file in grippers.values() for name in file.mountings if name}
    for place, own, value in written_values(designs):
        if own in ids and grippers and value not in known:
            hint = f"mountings: {', '.join(sorted(known))}" if known else "no gripper of the catalogue has mountings"
            hint += "; a gripper with one states its name in its file, 'mounting: NAME'"
            yield document.finding(
                "design.mounting", f"no gripper has a mounting {shown(str(value))}", place, hint=hint
            )


def _linkage_findings(
    designs: DesignSpace, document: Document, grippers: Mapping[str, GripperFile]
) -> Iterator[Finding]:
    """Forces and speeds of fingers beyond what the driven joint of their linkage gives.

    Args:
        designs: The design space.
        document: Its file, for positions.
        grippers: The gripper file of each gripper component, by its name.
    """
    found: dict[tuple[str, str, float], int] = {}
    linkages = {name: file.geometry.linkage for name, file in grippers.items() if file.geometry.linkage is not None}
    if not linkages or not {_FORCE, _SPEED} & setters_of(designs):
        return
    for variant in designs.expand():
        component = variant.components.get(GRIPPER)
        if component is None or component.geometry not in linkages:
            continue
        for name, value in values_of(variant, grippers[component.geometry].settings).items():
            if name in (_FORCE, _SPEED) and isinstance(value, (int, float)):
                found.setdefault((component.geometry, name, value), variant.id)
    for (geometry, name, value), number in found.items():
        force_n, speed_m_s = pad_limits(motion_of(linkages[geometry]))
        limit, unit = (force_n, "N") if name == _FORCE else (speed_m_s, "m/s")
        if value <= limit * _ROUNDING:
            continue
        ids = {parameter.id for parameter in designs.parameters if parameter.sets == name}
        places = (place for place, own, written in written_values(designs) if own in ids and written == value)
        yield document.finding(
            "design.linkage-limit",
            f"variant {number}: {name} is {value:g} {unit}, but the driven joint of {geometry} gives each pad "
            f"{limit:.4g} {unit} at most",
            next(places, ("parameters",)),
            hint="lower it, or correct the effort and velocity of the joint in the URDF",
        )
