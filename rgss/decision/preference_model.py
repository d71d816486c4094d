"""What a study wants of its choice, with the thresholds of the requirements as they are now."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.errors import DefinitionError
from rgss.measures import Direction
from rgss.requirements import Criterion
from rgss.studies import Project
from rgss.studies.trade_off import Anchor, RequirementAnchor, RiskChoice, ValuedMeasure, as_aim
from rgss.tradeoff import (
    AdditiveValue,
    ChanceBound,
    Comparison,
    EpsilonConstraint,
    Lexicographic,
    MinimaxRegret,
    Program,
    Risk,
    TailBound,
    Tchebycheff,
    Threshold,
    ValueFunction,
)


def threshold_of(project: Project, anchor: Anchor, measure: str) -> float:
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


def value_function_of(project: Project, valued: ValuedMeasure) -> ValueFunction:
    """The value function of a measure.

    Raises:
        TradeoffError: Its anchors make no value function.
        DefinitionError: A requirement's threshold has moved beyond the other end, so that what is
            worse would be worth more; or it is anchored on one that does not bound the measure.
    """
    measure = project.measures.measure(valued.measure)
    function = valued.function(lambda anchor: threshold_of(project, anchor, valued.measure))
    better = None if measure.better is Direction.NONE else measure.better is Direction.HIGHER
    if None not in (better, function.more_is_better) and better is not function.more_is_better:
        raise DefinitionError(
            f"with the thresholds as they are, less {measure.id} would be worth more"
            if better
            else f"with the thresholds as they are, more {measure.id} would be worth more",
            hint="a requirement's threshold lies beyond the other end of the value function; move that too",
        )
    return function


def comparison_of(requirement: str, criterion: Criterion) -> Comparison:
    """The comparison of a criterion.

    Raises:
        DefinitionError: It is strict, which no program can have.
    """
    for comparison in Comparison:
        if comparison.value == criterion.comparison.value:
            return comparison
    raise DefinitionError(
        f"{requirement}: a program cannot have the strict comparison {criterion.comparison.value!r}",
        hint="write >= or <=",
    )


def program_of(project: Project, functions: Sequence[ValueFunction]) -> Program:
    """The program by which a study decides.

    Args:
        project: The project with its study.
        functions: The study's value functions, through which the quantities of a reference point go.

    Raises:
        TradeoffError: The program contradicts itself.
        DefinitionError: It is anchored on a requirement that has no criterion on the measure.
    """
    choice = project.study.trade_off.program
    if choice.name == "lexicographic":
        return Lexicographic(aims=tuple(as_aim(aim) for aim in choice.aims))
    if choice.name == "epsilon_constraint":
        (aim,) = choice.aims
        return EpsilonConstraint(
            aim=as_aim(aim),
            bounds=tuple(
                Threshold(
                    requirement=f"limit:{bound.measure}",
                    measure=bound.measure,
                    comparison=bound.comparison,
                    value=threshold_of(project, bound.value, bound.measure),
                    unit=project.measures.measure(bound.measure).unit,
                )
                for bound in choice.limits
            ),
        )
    if choice.name == "tchebycheff":
        by_measure = {function.measure: function for function in functions}
        return Tchebycheff(
            reference={
                measure: by_measure[measure].value_at(threshold_of(project, anchor, measure))
                for measure, anchor in choice.reference
            },
            augmentation=choice.augmentation,
        )
    if choice.name == "minimax_regret":
        return MinimaxRegret(scenarios=choice.scenarios)
    return AdditiveValue()


def risks_of(project: Project) -> tuple[Risk, ...]:
    """What a study demands of the replicates.

    Raises:
        TradeoffError: A probability or a share is none.
        DefinitionError: A requirement that is named has no criterion.
    """
    return tuple(_risk(project, choice) for choice in project.study.trade_off.risks)


def _risk(project: Project, choice: RiskChoice) -> Risk:
    if choice.bound is not None:
        measure, comparison = choice.bound.measure, choice.bound.comparison
        value = threshold_of(project, choice.bound.value, measure)
    else:
        criterion = _criterion(project, choice.requirement or "")
        measure, comparison = criterion.measure, comparison_of(choice.requirement or "", criterion)
        value = criterion.threshold_in(project.measures.measure(measure).unit)
    unit = project.measures.measure(measure).unit
    if choice.probability is not None:
        return ChanceBound(
            requirement=choice.id,
            measure=measure,
            comparison=comparison,
            value=value,
            unit=unit,
            probability=choice.probability,
        )
    return TailBound(
        requirement=choice.id,
        measure=measure,
        comparison=comparison,
        value=value,
        unit=unit,
        share=choice.worst_share or 0.0,
    )


def _criterion(project: Project, requirement: str) -> Criterion:
    criterion = project.requirements.requirement(requirement).criterion
    if criterion is None:
        raise DefinitionError(f"{requirement} has no criterion, so no threshold", hint="name another requirement")
    return criterion
