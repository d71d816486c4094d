"""The planners of a study: each an OMPL planner with its own parameters."""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import Annotated, Any

from pydantic import PlainValidator, WithJsonSchema
from pydantic_core import PydanticCustomError

from rgss.designs import PLANNER_PREFIX, PLANNER_QUANTITIES
from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding, shown
from rgss.motion import (
    Objective,
    OmplPlanner,
    ParameterType,
    PlannerParameter,
    PlannerSettings,
    available_planners,
    refusal_of,
    takes_objective,
)
from rgss.quantities import parse_quantity

NO_COST = "none"
_PLANNER, _OBJECTIVE = "planner", "objective"
_OBJECTIVES = (*(one.value for one in Objective), NO_COST)

Written = str | int | float | bool
"""A value as it is written in a file."""


def _read_entry(value: Any) -> Mapping[str, Written]:
    if isinstance(value, dict) and all(isinstance(one, (str, int, float)) for one in value.values()):
        return MappingProxyType(dict(value))
    message = "a planner must have its parameters by name"
    raise PydanticCustomError("quantity", "{message}", {"message": message, "hint": "write {goal_bias: 0.05}, or {}"})


def _schema() -> dict[str, Any]:
    parameters = {
        name.removeprefix(PLANNER_PREFIX): {
            "description": one.meaning,
            "type": ["string"] if one.unit == "rad" else ["number", "boolean", "string"],
        }
        for name, one in PLANNER_QUANTITIES.items()
    }
    return {
        "type": "object",
        "description": "A planner of OMPL with its own parameters; OMPL's default for every other.",
        "properties": {
            _PLANNER: {"type": "string", "description": "The planner's name in OMPL, where its own name is another."},
            _OBJECTIVE: {"enum": list(_OBJECTIVES), "description": "Cost of a path that the planner keeps low."},
            **parameters,
        },
        "additionalProperties": False,
    }


PlannerField = Annotated[Mapping[str, Written], PlainValidator(_read_entry), WithJsonSchema(_schema())]
"""Parameters of a planner by name; with ``planner`` and ``objective``."""


def read_planners(
    entries: Mapping[str, Mapping[str, Written]], document: Document, findings: list[Finding]
) -> Mapping[str, PlannerSettings]:
    """The planners that a study declares, by their own names.

    Args:
        entries: The section ``planning.planners``.
        document: The file, for positions.
        findings: Collects the problems.
    """
    read = {}
    for name, entry in entries.items():
        place = ("planning", "planners", name)
        algorithm = str(entry.get(_PLANNER, name))
        if problem := planner_problem(algorithm):
            message, hint = problem
            at_key = _PLANNER not in entry
            location = place if at_key else (*place, _PLANNER)
            findings.append(document.finding("study.planner", message, location, hint=hint, at_key=at_key))
            continue
        if name != algorithm and not planner_problem(name):
            message = f"{name} is a planner of OMPL, and cannot name {algorithm}"
            hint = f"choose another name, such as {algorithm}-long"
            findings.append(document.finding("study.planner", message, place, hint=hint, at_key=True))
            continue
        read[name] = _settings(algorithm, entry, place, document, findings)
    return MappingProxyType(read)


def planner_problem(name: str, declared: Iterable[str] = ()) -> tuple[str, str] | None:
    """The reason why a planner cannot be used, and a hint; None if it can."""
    known = [*declared, *(planner for planner in available_planners() if planner not in set(declared))]
    if name in known:
        return None
    if reason := refusal_of(name):
        return f"planner {name} cannot be run: {reason}", _listed(known)
    # Names of planners differ in few letters, so they are compared without case.
    folded = {one.casefold(): one for one in reversed(known)}
    near = difflib.get_close_matches(name.casefold(), folded, n=1)
    suggestion = f"did you mean {folded[near[0]]!r}? " if near else ""
    return f"unknown planner {shown(name)}", suggestion + _listed(known)


def _listed(planners: Iterable[str]) -> str:
    return f"planners: {', '.join(planners)}"


def _settings(
    algorithm: str,
    entry: Mapping[str, Written],
    place: tuple[str, ...],
    document: Document,
    findings: list[Finding],
) -> PlannerSettings:
    planner = available_planners()[algorithm]
    parameters = []
    for name, written in entry.items():
        if name in (_PLANNER, _OBJECTIVE):
            continue
        try:
            parameters.append((name, read_parameter(planner, name, written)))
        except QuantityError as error:
            at_key = name not in planner.parameters
            location = (*place, name)
            findings.append(
                document.finding("study.planner-parameter", error.message, location, hint=error.hint, at_key=at_key)
            )
    objective, problem = _objective(algorithm, entry.get(_OBJECTIVE))
    if problem is not None:
        message, hint = problem
        given = _OBJECTIVE in entry
        location = (*place, _OBJECTIVE) if given else place
        findings.append(document.finding("study.planner-objective", message, location, hint=hint, at_key=not given))
    return PlannerSettings(algorithm=algorithm, parameters=tuple(parameters), objective=objective)


def _objective(algorithm: str, written: Written | None) -> tuple[Objective | None, tuple[str, str] | None]:
    if written is None:
        if algorithm != "TRRT":
            return None, None
        hint = (
            f"write 'objective: clearance' or 'objective: mechanical_work', or 'objective: {NO_COST}' if that is meant"
        )
        return None, ("TRRT without a cost accepts every transition, as RRT does", hint)
    if written not in _OBJECTIVES:
        near = difflib.get_close_matches(str(written), _OBJECTIVES, n=1)
        suggestion = f"did you mean {near[0]!r}? " if near else ""
        message = f"unknown objective {shown(str(written))}"
        return None, (message, f"{suggestion}objectives: {', '.join(_OBJECTIVES)}")
    if written == NO_COST:
        return None, None
    if not takes_objective(algorithm):
        return None, (f"{algorithm} has no use for an objective", "remove it")
    return Objective(written), None


def read_parameter(planner: OmplPlanner, name: str, written: Written) -> float:
    """The value of a planner's parameter in SI.

    Args:
        planner: The planner.
        name: The parameter's name in OMPL's parameter set.
        written: The value as it is written: with a unit where the parameter has one.

    Raises:
        QuantityError: The planner has no such parameter, or the value is none of it.
    """
    parameter = _known(planner, name)
    if parameter.type is ParameterType.FLAG:
        if not isinstance(written, bool):
            raise QuantityError(f"{name} must be true or false, got {shown(str(written))}", hint=f"write {name}: true")
        return float(written)
    if isinstance(written, bool):
        raise QuantityError(f"{name} must be a number", hint=f"write {name}: {parameter.default:g}")
    unit = PLANNER_QUANTITIES[f"{PLANNER_PREFIX}{name}"].unit
    value = parse_quantity(written if isinstance(written, str) else repr(written), unit)
    require_value(planner, name, value)
    return value


def require_value(planner: OmplPlanner, name: str, value: float) -> None:
    """Check that a planner has a parameter, and that a value in SI is valid for it.

    Raises:
        QuantityError: It has not, or the value is out of its range or of another type.
    """
    parameter = _known(planner, name)
    if problem := parameter.problem_of(value):
        unit = PLANNER_QUANTITIES[f"{PLANNER_PREFIX}{name}"].unit
        where = f"OMPL's default for {planner.name} is {parameter.default:g}"
        raise QuantityError(problem, hint=where if unit == "1" else f"{where} {unit}")


def _known(planner: OmplPlanner, name: str) -> PlannerParameter:
    if name in planner.parameters:
        return planner.parameters[name]
    near = difflib.get_close_matches(name, planner.parameters, n=1)
    suggestion = f"did you mean {near[0]!r}? " if near else ""
    listed = ", ".join(planner.parameters) or "none"
    raise QuantityError(
        f"{planner.name} has no parameter {shown(name)}", hint=f"{suggestion}parameters of {planner.name}: {listed}"
    )
