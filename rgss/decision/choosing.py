"""Trade-off of a study, formulated from its estimates and decided."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from rgss.assessment import VariantMeasures, replicates_of, require_complete, requirements_with_criteria
from rgss.decision.level_structure import level_structure
from rgss.decision.moved_thresholds import with_moved_winners
from rgss.decision.preference_model import (
    measures_of_choice,
    program_of,
    risks_of,
    threshold_of,
    value_function_of,
)
from rgss.measures import Estimate, Estimator
from rgss.requirements import Criterion, Statistic
from rgss.studies import Project
from rgss.tradeoff import (
    Alternative,
    Decision,
    Overlap,
    SharedPart,
    SolverRun,
    TradeProblem,
    decide,
    overlapping_measures,
    shared_parts,
)


def trade_problem(
    project: Project,
    measured: Sequence[VariantMeasures],
    *,
    tolerant: bool = True,
    known: dict[int, tuple[VariantMeasures, Alternative]] | None = None,
) -> TradeProblem:
    """The choice among a study's variants under its requirements.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        tolerant: True to apply the study's tolerance to thresholds on measures that differ from trial to trial.
        known: Cache of alternatives from earlier calls for the same project, by variant, with their estimates:
            those of the same estimates are reused, and new ones are added.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed, or there are too few replicates for it.
        DefinitionError: A criterion has a comparison that a program does not support, or levels are to
            be chosen of designs that are not combinations of levels.
    """
    require_complete(measured, sweep=project.command("sweep"))
    criteria = demanded_criteria(project)
    trade_off = project.study.trade_off
    tolerance = trade_off.tolerance if tolerant else 0.0
    thresholds = tuple(
        threshold_of(project, requirement, criterion, column=_column(criterion)).tolerated(
            tolerance if criterion.measure in project.measures.noisy else 0.0
        )
        for requirement, criterion in criteria.items()
    )
    functions = tuple(value_function_of(project, valued) for valued in trade_off.valued)
    program = program_of(project, functions)
    risks = risks_of(project)
    # The posterior of an interval's end is drawn around its measure.
    columns = {measure: (measure, Statistic.VALUE) for measure in measures_of_choice(project, program, risks)}
    columns.update({_column(criterion): (criterion.measure, criterion.statistic) for criterion in criteria.values()})
    return TradeProblem(
        alternatives=tuple(_known_alternative(project, variant, columns, known) for variant in measured),
        thresholds=thresholds,
        value_functions=functions,
        weighting=trade_off.weighting,
        risks=risks,
        program=program,
        weight_bounds=trade_off.weight_bounds,
        levels=level_structure(project.designs, [one.variant for one in measured]) if trade_off.choose_levels else None,
    )


def choose(
    project: Project,
    measured: Sequence[VariantMeasures],
    *,
    problem: TradeProblem | None = None,
    resamples: int | None = None,
    independent: tuple[SolverRun, ...] = (),
    time_limit: float | None = None,
) -> Decision:
    """Choose the best variant.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        problem: Result of `trade_problem` for them, if it was computed already.
        resamples: Draws that test a conflict against noise, as for `rgss.tradeoff.decide`; 0 for none.
        independent: Runs of other solvers than HiGHS, as further checks.
        time_limit: Seconds for the runs of a solver over levels.

    Raises:
        EvidenceError: Trials of the study have no evidence.
        TradeoffError: The choice is ill posed, or no optimum was proved.
        DefinitionError: As for `trade_problem`.
    """
    margin = project.study.trade_off.practical_margin
    posed = trade_problem(project, measured) if problem is None else problem
    decision = decide(
        posed,
        margin=margin,
        last_of_equals=project.study.trade_off.last_of_equals,
        seed=project.study.seed,
        resamples=resamples,
        independent=independent,
        time_limit=time_limit,
    )
    if decision.conflicts is None:
        return decision
    return replace(decision, conflicts=with_moved_winners(project, posed, decision.conflicts))


def demanded_criteria(project: Project) -> dict[str, Criterion]:
    """Criterion of the choice by requirement; if the study decides by verdicts, on the end that a verdict needs."""
    return {
        requirement.id: _demanded(project, requirement.criterion)
        for requirement in requirements_with_criteria(project)
        if requirement.criterion is not None
    }


def proportion_measures(project: Project) -> frozenset[str]:
    """Ids of the measures that are estimated as proportions."""
    return frozenset(
        measure.id
        for measure in project.measures.measures
        if measure.estimate is not None and measure.estimate.statistic is Estimator.PROPORTION
    )


def unweighted_measures(project: Project) -> tuple[str, ...]:
    """Valued measures with weight 0, which neither the value nor the rule of equals reads."""
    weights = project.study.trade_off.weighting.weights
    return tuple(measure for measure, weight in weights.items() if weight == 0.0)


def double_counting(project: Project) -> tuple[Overlap, ...]:
    """Valued measures of which one contains the other, with an alternative measure."""
    measures = project.measures
    weights = project.study.trade_off.weighting.weights
    contained = {measure.id: set(measures.dependencies(measure.id)) for measure in measures.measures}
    return overlapping_measures(
        weights,
        contained.__getitem__,
        candidates=[
            measure.id for measure in measures.measures if measure.better.value != "none" and measure.id not in weights
        ],
        alike=lambda one, other: measures.measure(one).unit == measures.measure(other).unit,
    )


def shared_measures(project: Project) -> tuple[SharedPart, ...]:
    """Valued measures that depend on measures in common, although neither contains the other."""
    weights = project.study.trade_off.weighting.weights
    return shared_parts(weights, project.measures.dependencies)


def _demanded(project: Project, criterion: Criterion) -> Criterion:
    """Criterion of a choice; if the study decides by verdicts, on the end of the interval that a verdict needs."""
    if not project.study.trade_off.shown_feasible or criterion.statistic is not Statistic.VALUE:
        return criterion
    if criterion.measure not in project.measures.noisy:
        return criterion
    return replace(criterion, statistic=Statistic.LOW if criterion.comparison.is_lower_bound else Statistic.HIGH)


def _known_alternative(
    project: Project,
    variant: VariantMeasures,
    columns: Mapping[str, tuple[str, Statistic]],
    known: dict[int, tuple[VariantMeasures, Alternative]] | None,
) -> Alternative:
    if known is None:
        return _alternative(project, variant, columns)
    of, alternative = known.get(variant.variant.id, (None, None))
    if of is not variant or alternative is None:
        alternative = _alternative(project, variant, columns)
        known[variant.variant.id] = (variant, alternative)
    return alternative


def _alternative(
    project: Project, variant: VariantMeasures, columns: Mapping[str, tuple[str, Statistic]]
) -> Alternative:
    measures = project.measures
    noisy = {measure for measure, _ in columns.values() if measure in measures.noisy}
    samples = replicates_of(measures, variant, only=noisy)
    rows = {}
    for column, (measure, statistic) in columns.items():
        if measure in samples:
            rows[column] = _shifted(samples[measure], variant.estimates[measure], statistic)
    return Alternative(
        variant=variant.variant.id,
        measures={
            column: _statistic(variant.estimates[measure], statistic)
            for column, (measure, statistic) in columns.items()
        },
        samples=rows,
    )


def _shifted(row: tuple[float | None, ...], estimate: Estimate, statistic: Statistic) -> tuple[float | None, ...]:
    """Replicates of an end of an interval: those of the estimate, shifted by the distance of the end."""
    end = _statistic(estimate, statistic)
    if statistic is Statistic.VALUE or end is None or estimate.value is None:
        return row
    shift = end - estimate.value
    return tuple(None if quantity is None else quantity + shift for quantity in row)


def _column(criterion: Criterion) -> str:
    if criterion.statistic is Statistic.VALUE:
        return criterion.measure
    return f"{criterion.measure}.{criterion.statistic.value}"


def _statistic(estimate: Estimate, statistic: Statistic) -> float | None:
    if statistic is Statistic.LOW:
        return estimate.low
    return estimate.high if statistic is Statistic.HIGH else estimate.value
