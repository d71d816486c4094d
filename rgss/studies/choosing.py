"""From estimates to the decision."""

from __future__ import annotations

from collections.abc import Sequence

from rgss.errors import DefinitionError
from rgss.measures import Estimate
from rgss.requirements import Criterion, Statistic
from rgss.studies.measuring import VariantMeasures, require_complete, requirements_with_criteria
from rgss.studies.project import Project
from rgss.tradeoff import (
    Alternative,
    Comparison,
    Decision,
    Overlap,
    Threshold,
    TradeProblem,
    ValueFunction,
    Weighting,
    decide,
    overlapping_measures,
)


def trade_problem(project: Project, measured: Sequence[VariantMeasures]) -> TradeProblem:
    """The choice among a study's variants under its requirements.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed.
        DefinitionError: A criterion has a comparison that a program cannot have.
    """
    require_complete(measured)
    criteria = {
        requirement.id: requirement.criterion
        for requirement in requirements_with_criteria(project)
        if requirement.criterion is not None
    }
    units = {measure.id: measure.unit for measure in project.measures.measures}
    columns = {anchors.measure: (anchors.measure, Statistic.VALUE) for anchors in project.study.values}
    columns.update({_column(criterion): (criterion.measure, criterion.statistic) for criterion in criteria.values()})
    return TradeProblem(
        alternatives=tuple(
            Alternative(
                variant=variant.variant.id,
                measures={
                    column: _statistic(variant.estimates[measure], statistic)
                    for column, (measure, statistic) in columns.items()
                },
            )
            for variant in measured
        ),
        thresholds=tuple(
            Threshold(
                requirement=requirement,
                measure=_column(criterion),
                comparison=_comparison(requirement, criterion),
                value=criterion.threshold_in(units[criterion.measure]),
                unit=units[criterion.measure],
            )
            for requirement, criterion in criteria.items()
        ),
        value_functions=tuple(
            ValueFunction(measure=anchors.measure, worst=anchors.worst, best=anchors.best)
            for anchors in project.study.values
        ),
        weighting=Weighting(weights={anchors.measure: anchors.weight for anchors in project.study.values}),
    )


def choose(project: Project, measured: Sequence[VariantMeasures]) -> Decision:
    """Decide which variant is best.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed, or no optimum was proved.
        DefinitionError: A criterion has a comparison that a program cannot have.
    """
    return decide(trade_problem(project, measured))


def double_counting(project: Project) -> tuple[Overlap, ...]:
    """Valued measures of which one contains the other."""
    weights = {anchors.measure: anchors.weight for anchors in project.study.values}
    return overlapping_measures(weights, lambda measure: set(project.measures.dependencies(measure)))


def _column(criterion: Criterion) -> str:
    if criterion.statistic is Statistic.VALUE:
        return criterion.measure
    return f"{criterion.measure}.{criterion.statistic.value}"


def _statistic(estimate: Estimate, statistic: Statistic) -> float | None:
    if statistic is Statistic.LOW:
        return estimate.low
    return estimate.high if statistic is Statistic.HIGH else estimate.value


def _comparison(requirement: str, criterion: Criterion) -> Comparison:
    for comparison in Comparison:
        if comparison.value == criterion.comparison.value:
            return comparison
    raise DefinitionError(
        f"{requirement}: a program cannot have the strict comparison {criterion.comparison.value!r}",
        hint="write >= or <=",
    )
