"""Preferences of a study, with the present thresholds of the requirements."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.errors import DefinitionError
from rgss.measures import Direction
from rgss.requirements import Criterion
from rgss.studies import Project
from rgss.studies.trade_off import AnchoredProgram, BoundChoice, RequirementBound
from rgss.tradeoff import Anchor, AnchoredValue, Program, RequirementAnchor, Risk, Threshold, ValueFunction
from rgss.tradeoff.problem import LIMIT_PREFIX


def quantity_of(project: Project, anchor: Anchor, measure: str) -> float:
    """The quantity of an anchor, in the measure's unit.

    Raises:
        DefinitionError: It is anchored on a requirement that has no criterion on the measure.
    """
    if not isinstance(anchor, RequirementAnchor):
        return anchor
    criterion = _criterion(project, anchor.requirement)
    if criterion.measure != measure:
        raise DefinitionError(
            f"{anchor.requirement} bounds {criterion.measure}, not {measure}", hint="anchor on another requirement"
        )
    return anchor.times * criterion.threshold_in(project.measures.measure(measure).unit)


def value_function_of(project: Project, valued: AnchoredValue) -> ValueFunction:
    """The value function of a measure.

    Raises:
        TradeoffError: Its anchors do not define a value function.
        DefinitionError: An end, or the threshold that it is anchored on, has moved beyond the other end, so that a
            worse quantity would have a greater value; or it is anchored on one that does not bound the measure.
    """
    measure = project.measures.measure(valued.measure)
    function = valued.function(lambda anchor: quantity_of(project, anchor, valued.measure))
    better = None if measure.better is Direction.NONE else measure.better is Direction.HIGHER
    if None not in (better, function.more_is_better) and better is not function.more_is_better:
        raise DefinitionError(
            f"with these ends of its value function, less {measure.id} would be worth more"
            if better
            else f"with these ends of its value function, more {measure.id} would be worth more",
            hint="one end, or the requirement's threshold that it is anchored on, lies beyond the other; move that too",
        )
    return function


def anchored_measures(project: Project) -> dict[str, tuple[str, ...]]:
    """Valued measures whose value functions are anchored on each requirement, by the requirement's id.

    Raises:
        TradeoffError: As for `value_function_of`.
        DefinitionError: As for `quantity_of`.
    """
    found: dict[str, list[str]] = {}
    trade_off = project.study.trade_off
    for valued in trade_off.valued:
        if valued.measure not in trade_off.weighting.deciding_measures:
            continue
        named: dict[str, None] = {}

        def quantity(anchor: Anchor, measure: str = valued.measure, named: dict[str, None] = named) -> float:
            if isinstance(anchor, RequirementAnchor):
                named[anchor.requirement] = None
            return quantity_of(project, anchor, measure)

        valued.function(quantity)
        for requirement in named:
            found.setdefault(requirement, []).append(valued.measure)
    return {requirement: tuple(measures) for requirement, measures in found.items()}


def threshold_of(project: Project, requirement: str, criterion: Criterion, *, column: str | None = None) -> Threshold:
    """The threshold of a requirement's criterion, in the measure's unit.

    Args:
        project: The project.
        requirement: The requirement's id.
        criterion: Its criterion.
        column: The column that is compared; None for the measure itself.

    Raises:
        DefinitionError: The comparison is strict, which programs do not support.
    """
    if criterion.comparison.is_strict:
        raise DefinitionError(
            f"{requirement}: a program cannot have the strict comparison {criterion.comparison.value!r}",
            hint="write >= or <=",
        )
    unit = project.measures.measure(criterion.measure).unit
    return Threshold(
        requirement=requirement,
        measure=column or criterion.measure,
        comparison=criterion.comparison,
        value=criterion.threshold_in(unit),
        unit=unit,
    )


def bound_of(project: Project, name: str, bound: BoundChoice | RequirementBound) -> Threshold:
    """The threshold of a bound that a study sets.

    Raises:
        DefinitionError: It names a requirement that has no criterion, or none on the measure.
    """
    if isinstance(bound, RequirementBound):
        return threshold_of(project, bound.requirement, _criterion(project, bound.requirement))
    return Threshold(
        requirement=name,
        measure=bound.measure,
        comparison=bound.comparison,
        value=quantity_of(project, bound.value, bound.measure),
        unit=project.measures.measure(bound.measure).unit,
    )


def program_of(project: Project, functions: Sequence[ValueFunction]) -> Program:
    """Decision program of a study.

    Args:
        project: The project with its study.
        functions: The study's value functions, which convert the quantities of a reference point.

    Raises:
        TradeoffError: The program contradicts itself.
        DefinitionError: It is anchored on a requirement that has no criterion on the measure.
    """
    stated = project.study.trade_off.program
    if not isinstance(stated, AnchoredProgram):
        return stated
    return stated.resolved(
        lambda limit: bound_of(project, f"{LIMIT_PREFIX}{limit.measure}", limit),
        lambda anchor, measure: quantity_of(project, anchor, measure),
        {function.measure: function for function in functions}.__getitem__,
    )


def risks_of(project: Project) -> tuple[Risk, ...]:
    """Demands of a study on the replicates.

    Raises:
        TradeoffError: A probability or a share is not between 0 and 1.
        DefinitionError: A requirement that is named has no criterion.
    """
    return tuple(choice.risk(bound_of(project, choice.id, choice.bound)) for choice in project.study.trade_off.risks)


def deciding_measures(project: Project) -> tuple[str, ...]:
    """Measures that a choice reads: those with a weight, those of the program and of risks, those of requirements.

    Raises:
        TradeoffError: As for `program_of`.
        DefinitionError: As for `program_of`.
    """
    valued = project.study.trade_off.valued
    program = program_of(project, tuple(value_function_of(project, one) for one in valued))
    return measures_of_choice(project, program, risks_of(project))


def measures_of_choice(project: Project, program: Program, risks: Sequence[Risk]) -> tuple[str, ...]:
    """The same, of a program and risks that are known already.

    Args:
        project: The project with its study.
        program: Its program.
        risks: Its demands on the replicates.
    """
    of_requirements = (one.criterion.measure for one in project.requirements.system if one.criterion is not None)
    wanted = (
        *project.study.trade_off.weighting.weights,
        *(risk.measure for risk in risks),
        *program.aimed_measures,
        *(limit.measure for limit in program.limits),
        *of_requirements,
    )
    return tuple(dict.fromkeys(wanted))


def _criterion(project: Project, requirement: str) -> Criterion:
    criterion = project.requirements.requirement(requirement).criterion
    if criterion is None:
        raise DefinitionError(f"{requirement} has no criterion, so no threshold", hint="name another requirement")
    return criterion
