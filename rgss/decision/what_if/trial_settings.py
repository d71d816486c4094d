"""Assumptions on trials for what-ifs: fidelity, physics, uncertainty, workload."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields, replace
from functools import partial
from typing import Any

from rgss.decision.what_if.setting import ModelSetting, count_from, in_words, one_of, quantity_from
from rgss.errors import DefinitionError
from rgss.evidence import Fidelity
from rgss.physics import LEAST_ITERATIONS_HZ, LEAST_RATE_HZ
from rgss.scenes.uncertainty import Uncertainty, UncertainValue, Workload, quantity_of
from rgss.studies import Project

NOMINAL = "uncertainty.nominal"
FIDELITY = "fidelity"
WORKLOAD = "workload"
_MOST_ITERATIONS = 10_000
_CASE_UNITS = {"mass_kg": "kg", "radius_m": "m", "height_m": "m", "friction": "1"}


def settings_of_trials(project: Project) -> Iterator[ModelSetting]:
    """The assumptions on trials, in the order of the study's file."""
    study = project.study
    known = tuple(one.value for one in Fidelity)
    yield ModelSetting(
        id=FIDELITY,
        value=study.fidelity.value,
        example=f"{FIDELITY}=kinematic",
        changed=lambda text: project.with_fidelity(one_of(FIDELITY, text, known)),
    )
    yield ModelSetting(
        id="physics.rate",
        value=in_words(study.rate_hz, "Hz"),
        example=f"physics.rate={in_words(2.0 * study.rate_hz, 'Hz')}",
        changed=partial(_with_rate, project),
    )
    yield ModelSetting(
        id="physics.solver_iterations",
        value=str(study.solver_iterations),
        example=f"physics.solver_iterations={2 * study.solver_iterations}",
        changed=partial(_with_iterations, project),
    )
    yield ModelSetting(
        id=NOMINAL,
        value=str(study.is_nominal).lower(),
        example=f"{NOMINAL}=true",
        changed=lambda text: replace(
            project, study=replace(study, is_nominal=one_of(NOMINAL, text, ("true", "false")) == "true")
        ),
    )
    yield from _uncertain_values(project)
    yield from _cases(project)


def _with_rate(project: Project, text: str) -> Project:
    return _with_physics(project, rate_hz=quantity_from("physics.rate", text, "Hz", above=0.0))


def _with_iterations(project: Project, text: str) -> Project:
    return _with_physics(
        project, iterations=count_from("physics.solver_iterations", text, least=1, most=_MOST_ITERATIONS)
    )


def _with_physics(project: Project, *, rate_hz: float | None = None, iterations: int | None = None) -> Project:
    study = project.study
    rate_hz = study.rate_hz if rate_hz is None else rate_hz
    iterations = study.solver_iterations if iterations is None else iterations
    coarse = rate_hz < LEAST_RATE_HZ or rate_hz * iterations < LEAST_ITERATIONS_HZ
    if coarse and study.fidelity is Fidelity.CONTACT:
        raise DefinitionError(
            f"--what-if: contact physics needs at least {LEAST_RATE_HZ:g} Hz and {LEAST_ITERATIONS_HZ:g} solver "
            f"iterations a second, got {rate_hz:g} Hz and {rate_hz * iterations:g}",
            hint="240 Hz with 20 iterations are validated",
        )
    return replace(project, study=replace(study, rate_hz=rate_hz, solver_iterations=iterations))


def _uncertain_values(project: Project) -> Iterator[ModelSetting]:
    if project.study.is_nominal:
        return
    for one in project.uncertainty.values:
        name, unit = f"uncertainty.{one.quantity}", quantity_of(one.quantity).unit
        kind = type(one.distribution).__name__.lower()
        yield ModelSetting(
            id=name, value=f"{kind}", example=f"{name}=nominal", changed=partial(_without, project, one.quantity)
        )
        for field in fields(one.distribution):
            value = getattr(one.distribution, field.name)
            if not isinstance(value, float):
                continue
            own_unit = "1" if field.name == "geometric_sd" else unit
            full = f"{name}.{field.name}"
            yield ModelSetting(
                id=full,
                value=in_words(value, own_unit),
                example=f"{full}={in_words(2.0 * value, own_unit)}",
                changed=partial(_with_parameter, project, one, field.name, own_unit),
            )


def _with_parameter(project: Project, one: UncertainValue, field: str, unit: str, text: str) -> Project:
    name = f"uncertainty.{one.quantity}.{field}"
    value = quantity_from(name, text, unit, above={"sd": 0.0, "geometric_sd": 1.0, "median": 0.0}.get(field))
    changes: dict[str, Any] = {field: value}
    distribution = replace(one.distribution, **changes)
    low, high = distribution.support
    if low > high or (field in ("low", "high") and low == high):
        raise DefinitionError(f"--what-if: {name}: low must be less than high, got {text}")
    quantity = quantity_of(one.quantity)
    if not quantity.is_possible(low):
        raise DefinitionError(
            f"--what-if: {name}: {quantity.name} cannot be {in_words(low, quantity.unit)}, got {text}"
        )
    given = Uncertainty(values=(UncertainValue(quantity=one.quantity, distribution=distribution),))
    study = replace(project.study, uncertainty=project.study.uncertainty.overridden_by(given))
    return replace(project, study=study)


def _without(project: Project, quantity: str, text: str) -> Project:
    one_of(f"uncertainty.{quantity}", text, ("nominal",))
    study = replace(project.study, uncertainty=_removed(project.study.uncertainty, quantity))
    scene = replace(project.scene, uncertainty=_removed(project.scene.uncertainty, quantity))
    return replace(project, study=study, scene=scene)


def _removed(uncertainty: Uncertainty, quantity: str) -> Uncertainty:
    """An uncertainty without a quantity; the others of its correlated group are kept."""
    groups = []
    for group in uncertainty.correlations:
        kept = [place for place, name in enumerate(group.quantities) if name != quantity]
        if len(kept) > 1:
            names = tuple(group.quantities[place] for place in kept)
            matrix = tuple(tuple(group.matrix[row][column] for column in kept) for row in kept)
            groups.append(replace(group, quantities=names, matrix=matrix))
    values = tuple(one for one in uncertainty.values if one.quantity != quantity)
    return Uncertainty(values=values, correlations=tuple(groups))


def _cases(project: Project) -> Iterator[ModelSetting]:
    cases = project.workload.cases
    if not cases:
        return
    yield ModelSetting(
        id=WORKLOAD,
        value=", ".join(case.id for case in cases),
        example=f"{WORKLOAD}={cases[0].id}",
        changed=partial(_with_case_alone, project),
    )
    for place, case in enumerate(cases):
        for field, unit in _CASE_UNITS.items():
            value = getattr(case, field)
            if value is not None:
                name = f"{WORKLOAD}.{case.id}.{field.rpartition('_')[0] or field}"
                yield ModelSetting(
                    id=name,
                    value=in_words(value, unit),
                    example=f"{name}={in_words(2.0 * value, unit)}",
                    changed=partial(_with_case_value, project, name, place, field, unit),
                )


def _with_case_alone(project: Project, text: str) -> Project:
    by_id = {case.id: case for case in project.workload.cases}
    one_of(WORKLOAD, text, by_id)
    return replace(project, study=replace(project.study, workload=Workload(cases=(by_id[text],))))


def _with_case_value(project: Project, name: str, place: int, field: str, unit: str, text: str) -> Project:
    cases = list(project.workload.cases)
    changes: dict[str, Any] = {field: quantity_from(name, text, unit, above=0.0)}
    cases[place] = replace(cases[place], **changes)
    return replace(project, study=replace(project.study, workload=Workload(cases=tuple(cases))))
