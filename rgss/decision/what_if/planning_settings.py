"""Assumptions on planning for what-ifs: charge, limits, resolutions, kinds of moves, planners."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import Any

from rgss.decision.what_if.setting import ModelSetting, count_from, in_words, one_of, quantity_from
from rgss.designs import PLANNER_PREFIX, PLANNER_QUANTITIES, ParameterKind
from rgss.errors import DefinitionError, QuantityError
from rgss.motion import OnUnverified, ParameterType, PlannerSettings, available_planners
from rgss.studies import PlanningChoice, Project, read_parameter
from rgss.tasks import MoveKind

_MOST_CHECKS = 1_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class _Quantity:
    """Quantity of the section ``planning``: field of its settings, unit, and True if it may be 0."""

    field: str
    unit: str
    may_be_zero: bool = False


_QUANTITIES = {
    "resolution": _Quantity(field="resolution_rad", unit="rad"),
    "verification_resolution": _Quantity(field="verification_resolution_rad", unit="rad"),
    "simplification_limit": _Quantity(field="simplification_limit_s", unit="s", may_be_zero=True),
    "clearance": _Quantity(field="clearance_m", unit="m", may_be_zero=True),
}


def settings_of_planning(project: Project) -> Iterator[ModelSetting]:
    """The assumptions on planning, in the order of the study's file."""
    planning = project.study.planning.settings
    charge = in_words(planning.clock.charge_s, "s")
    yield ModelSetting(
        id=CHARGE,
        value=charge,
        example=f"{CHARGE}={in_words(2.0 * planning.clock.charge_s, 's')}",
        changed=partial(_with_charge, project),
    )
    for key, quantity in _QUANTITIES.items():
        name, value = f"planning.{key}", getattr(planning, quantity.field)
        value = planning.resolution_rad if value is None else value
        yield ModelSetting(
            id=name,
            value=in_words(value, quantity.unit),
            example=f"{name}={in_words(2.0 * value or 1.0, quantity.unit)}",
            changed=partial(_with_quantity, project, name, quantity),
        )
    name = "planning.simplification_checks"
    yield ModelSetting(
        id=name,
        value=str(planning.simplification_checks),
        example=f"{name}={2 * planning.simplification_checks}",
        changed=partial(_with_count, project, name),
    )
    name = "planning.on_unverified"
    yield ModelSetting(
        id=name,
        value=planning.on_unverified.value,
        example=f"{name}=fail",
        changed=lambda text: _with_settings(
            project, on_unverified=OnUnverified(one_of("planning.on_unverified", text, ("fail", "repair")))
        ),
    )
    planned = project.study.task.planned
    for index, phase in enumerate(planned):
        name = f"moves.{phase}"
        yield ModelSetting(
            id=name,
            value=(planning.moves[index] if planning.moves else MoveKind.PLANNED).value,
            example=f"{name}=straight",
            changed=partial(_with_move, project, name, index),
        )
    yield from _planner_settings(project)


def _planner_settings(project: Project) -> Iterator[ModelSetting]:
    """The parameters of the planners that the study declares."""
    for planner, settings in project.study.planning.planners.items():
        given = dict(settings.parameters)
        for key, parameter in available_planners()[settings.algorithm].parameters.items():
            unit = PLANNER_QUANTITIES[f"{PLANNER_PREFIX}{key}"].unit
            value = given.get(key, parameter.default)
            is_flag = parameter.type is ParameterType.FLAG
            name = f"planning.planners.{planner}.{key}"
            words = ("true" if value else "false") if is_flag else in_words(value, unit)
            yield ModelSetting(
                id=name, value=words, example=f"{name}={words}", changed=partial(_with_parameter, project, planner, key)
            )
    yield from _shared_settings(project)


def _shared_settings(project: Project) -> Iterator[ModelSetting]:
    """Parameters that several planners of the study share, changed for all of them together."""
    sharing: dict[str, list[str]] = {}
    for planner, settings in project.study.planning.planners.items():
        for key in available_planners()[settings.algorithm].parameters:
            sharing.setdefault(key, []).append(planner)
    for key, planners in sharing.items():
        if len(planners) < 2:
            continue
        name, unit = f"planning.planners.{key}", PLANNER_QUANTITIES[f"{PLANNER_PREFIX}{key}"].unit
        found = {planner: _parameter_of(project, planner, key) for planner in planners}
        words = [
            ("true" if value else "false") if isinstance(value, bool) else in_words(value, unit)
            for value in dict.fromkeys(found.values())
        ]
        yield ModelSetting(
            id=name,
            value=_listed(words),
            example=f"{name}={words[0]}",
            changed=partial(_with_shared, project, tuple(planners), key),
        )


def _parameter_of(project: Project, planner: str, key: str) -> float | bool:
    settings = project.study.planning.planners[planner]
    parameter = available_planners()[settings.algorithm].parameters[key]
    value = dict(settings.parameters).get(key, parameter.default)
    return bool(value) if parameter.type is ParameterType.FLAG else float(value)


def _with_shared(project: Project, planners: Sequence[str], key: str, text: str) -> Project:
    for planner in planners:
        project = _with_parameter(project, planner, key, text)
    return project


def settings_of_designs(project: Project) -> Iterator[ModelSetting]:
    """The planning limit and other numbers that design parameters set, changed for all designs together."""
    designs = project.designs
    selecting = {parameter for selector in designs.selectors.values() for parameter in selector}
    setters: dict[str, list[str]] = {}
    for parameter in designs.parameters:
        if parameter.sets and parameter.kind is ParameterKind.QUANTITY and parameter.id not in selecting:
            setters.setdefault(parameter.sets, []).append(parameter.id)
    units = {parameter.id: parameter.unit for parameter in designs.parameters}
    variants = designs.expand()
    for name, ids in setters.items():
        unit = units[ids[0]]
        values = sorted({float(one.parameters[ids[0]]) for one in variants if ids[0] in one.parameters})
        if values:
            yield ModelSetting(
                id=name,
                value=_listed([in_words(value, unit) for value in values]),
                example=f"{name}={in_words(values[0], unit)}",
                changed=partial(_with_design_value, project, name, frozenset(ids), unit),
            )
    if TIME_LIMIT not in setters and project.study.planning.time_limit_s is not None:
        value = in_words(project.study.planning.time_limit_s, "s")
        yield ModelSetting(
            id=TIME_LIMIT,
            value=value,
            example=f"{TIME_LIMIT}={value}",
            changed=lambda text: _with(project, time_limit_s=quantity_from(TIME_LIMIT, text, "s", above=0.0)),
        )


CHARGE = "planning.charge_per_check"
TIME_LIMIT = "planning.time_limit"


def _listed(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"


def _with(project: Project, **changes: Any) -> Project:
    planning = replace(project.study.planning, **changes)
    return replace(project, study=replace(project.study, planning=planning))


def _with_settings(project: Project, **changes: Any) -> Project:
    settings = replace(project.study.planning.settings, **changes)
    verification = settings.verification_resolution_rad
    if verification is not None and verification > settings.resolution_rad:
        raise DefinitionError(
            "--what-if: a path cannot be verified more coarsely than it is searched for, "
            f"{in_words(settings.resolution_rad, 'rad')}, got {in_words(verification, 'rad')}",
            hint="suppose planning.verification_resolution too",
        )
    return _with(project, settings=settings)


def _with_charge(project: Project, text: str) -> Project:
    clock = replace(project.study.planning.settings.clock, charge_s=quantity_from(CHARGE, text, "s", above=0.0))
    return _with_settings(project, clock=clock)


def _with_quantity(project: Project, name: str, quantity: _Quantity, text: str) -> Project:
    above, least = (None, 0.0) if quantity.may_be_zero else (0.0, None)
    return _with_settings(
        project, **{quantity.field: quantity_from(name, text, quantity.unit, above=above, least=least)}
    )


def _with_count(project: Project, name: str, text: str) -> Project:
    return _with_settings(project, simplification_checks=count_from(name, text, least=0, most=_MOST_CHECKS))


def _with_move(project: Project, name: str, index: int, text: str) -> Project:
    kind = MoveKind(one_of(name, text, tuple(one.value for one in MoveKind)))
    moves = project.study.planning.settings.moves or (MoveKind.PLANNED,) * len(project.study.task.planned)
    return _with_settings(project, moves=(*moves[:index], kind, *moves[index + 1 :]))


def _with_parameter(project: Project, planner: str, key: str, text: str) -> Project:
    planning: PlanningChoice = project.study.planning
    settings: PlannerSettings = planning.planners[planner]
    written: str | bool = {"true": True, "false": False}.get(text, text)
    try:
        value = read_parameter(available_planners()[settings.algorithm], key, written)
    except QuantityError as error:
        raise DefinitionError(f"--what-if: planning.planners.{planner}: {error.message}", hint=error.hint) from error
    return _with(project, planners={**planning.planners, planner: settings.with_parameter(key, value)})


def _with_design_value(project: Project, name: str, ids: frozenset[str], unit: str, text: str) -> Project:
    value = quantity_from(name, text, unit, above=0.0)
    designs = project.designs

    def moved(values: Any) -> dict[str, Any]:
        return {key: value if key in ids else one for key, one in values.items()}

    def moved_level(level: Any) -> Any:
        return replace(level, values=moved(level.values))

    factors = tuple(
        replace(
            factor,
            levels=tuple(map(moved_level, factor.levels)),
            span=None if factor.span is not None and factor.span.parameter in ids else factor.span,
        )
        for factor in designs.factors
    )
    sample = designs.sample
    if sample is not None:
        points = {number: tuple(map(moved_level, levels)) for number, levels in sample.points.items()}
        sample = replace(sample, points=points)
    changed = replace(designs, constants=moved(designs.constants), factors=factors, sample=sample)
    return replace(project, designs=changed)
