"""Variants of a report: parameters, measures, verdicts and ranks, column by column."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.assessment import VariantMeasures, requirements_with_criteria
from rgss.decision import unweighted_measures
from rgss.decision.robustness import Robustness
from rgss.designs import value_columns
from rgss.measures import Measure, MeasureKind, Range, estimate_ranges
from rgss.reports.plain_numbers import (
    FEWER_DIGITS,
    SHOWN_DIGITS,
    WORTH_DIGITS,
    Plain,
    condensed,
    plain_number,
    plain_numbers,
)
from rgss.requirements import Criterion, Requirement
from rgss.studies import Project
from rgss.tradeoff import Decision
from rgss.tradeoff.robustness import Support


def variant_columns(measured: Sequence[VariantMeasures], decision: Decision, found: Robustness) -> Plain:
    """Entries of all variants in a report, by ascending id.

    A column is a list with an entry for each variant, or a single value if all are equal.

    Args:
        measured: Every variant with its estimates, by ascending id.
        decision: The decision.
        found: Its robustness.
    """
    ranks = {one.variant: place for place, one in enumerate(decision.ranking, start=1)}
    values = {one.variant: one.value for one in decision.infeasible}
    values |= {one.variant: one.value for one in decision.ranking}
    violated = {one.variant: list(one.requirements) for one in decision.infeasible}
    front = {found.variants[one.row]: one.support for one in found.front.points}
    ids = [entry.variant.id for entry in measured]
    return {
        "id": ids,
        "rank": [ranks.get(variant) for variant in ids],
        "value": plain_numbers((values.get(variant) for variant in ids), WORTH_DIGITS),
        "feasible": [int(flag) for flag in found.feasible],
        "pareto": [_support(front.get(variant)) for variant in ids],
        "violates": [violated.get(variant, []) for variant in ids],
        "trials": condensed([len(entry.records) for entry in measured]),
        "succeeded": condensed([sum(record.success for record in entry.records) for entry in measured]),
    }


def parameter_columns(project: Project, measured: Sequence[VariantMeasures], found: Robustness) -> list[Plain]:
    """The design parameters, those of factors first, each marked if it varies.

    Args:
        project: The project.
        measured: Every variant.
        found: The robustness, which has the parameters of each factor.
    """
    setters = {name: factor.id for factor in found.effects.factors for name in factor.parameters}
    columns = []
    for definition in project.designs.parameters:
        values = [entry.variant.parameters[definition.id] for entry in measured]
        column = [value if isinstance(value, str) else plain_number(value) for value in values]
        columns.append(
            {
                "id": definition.id,
                "sets": definition.sets,
                "ranged": [
                    one.id
                    for one in project.designs.factors
                    if one.span is not None and one.span.parameter == definition.id
                ],
                "name": definition.name.replace("_", " "),
                "unit": definition.unit,
                "description": definition.description,
                "factor": setters.get(definition.id),
                "varies": len(set(map(str, column))) > 1,
                "values": condensed(column),
            }
        )
    return sorted(columns, key=lambda column: not column["varies"])


def filter_columns(project: Project, measured: Sequence[VariantMeasures]) -> list[Plain]:
    """Values of factors and roles that select variants, as after ``--only``; -1 for a variant without one of them."""
    found = value_columns(project.designs, [entry.variant for entry in measured])
    return [{"name": one.name, "values": list(one.values), "entries": condensed(one.entries)} for one in found]


def measure_columns(project: Project, measured: Sequence[VariantMeasures]) -> list[Plain]:
    """The measures with the estimates of each variant and their intervals.

    A measure that follows from the design alone has no interval and no trials.

    Args:
        project: The project with the weights and definitions.
        measured: Every variant with its estimates.
    """
    weights = project.study.trade_off.weighting.weights
    possible = estimate_ranges(project.measures)
    return [
        _measure(project, measure, measured, weights.get(measure.id)) | _possible(possible[measure.id])
        for measure in project.measures.measures
    ]


def requirement_columns(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> list[Plain]:
    """The requirements with a criterion, with the verdict on each variant.

    Args:
        project: The project.
        measured: Every variant with its verdicts.
        decision: The decision, which has the number of better variants that each requirement excludes.
    """
    excluded = {one.requirement: one.excluded for one in decision.deciding_requirements}
    return [
        _requirement(project, requirement, requirement.criterion, measured, excluded.get(requirement.id, 0))
        for requirement in requirements_with_criteria(project)
        if requirement.criterion is not None
    ]


def weight_columns(project: Project, found: Robustness) -> Plain:
    """The weights, and the value of each variant in each measure: the inputs of a ranking.

    With the direction of each measure, for equals are compared by their quantities.

    Args:
        project: The project with the value functions.
        found: The robustness, which has weights and values.
    """
    anchors = {one.measure: one for one in project.study.values}
    return {
        "measures": [
            {
                "id": measure,
                "weight": float(weight),
                "worst": plain_number(anchors[measure].worst) if measure in anchors else None,
                "best": plain_number(anchors[measure].best) if measure in anchors else None,
                "too_high": plain_number(anchors[measure].too_high) if measure in anchors else None,
                "more_is_better": found.more_is_better[place],
                "worth": condensed(plain_numbers(found.values[:, place].tolist(), WORTH_DIGITS)),
            }
            for place, (measure, weight) in enumerate(zip(found.measures, found.weights.tolist(), strict=True))
        ],
        "practical_margin": project.study.trade_off.practical_margin,
        "unweighted": list(unweighted_measures(project)),
        "of_equals": "last" if project.study.trade_off.last_of_equals else "first",
    }


def _measure(project: Project, measure: Measure, measured: Sequence[VariantMeasures], weight: float | None) -> Plain:
    estimates = [entry.estimates[measure.id] for entry in measured]
    digits = SHOWN_DIGITS if weight is not None or measure.kind is MeasureKind.EFFECTIVENESS else FEWER_DIGITS
    column: Plain = {
        "id": measure.id,
        "name": measure.name,
        "kind": measure.kind.value,
        "unit": measure.unit,
        "better": measure.better.value,
        "weight": weight,
        "from_trials": measure.from_trials,
        "assumptions": [one.id for one in project.measures.assumptions_of(measure.id)],
        "value": condensed(plain_numbers((one.value for one in estimates), digits)),
    }
    if measure.from_trials:
        column["low"] = condensed(plain_numbers((one.low for one in estimates), digits))
        column["high"] = condensed(plain_numbers((one.high for one in estimates), digits))
        column["n"] = condensed([one.n for one in estimates])
    return column


def _possible(within: Range) -> Plain:
    """The ends that no estimate can leave, such as 1 of a share; an end that is not known is left out."""
    ends = {"least": within.low, "most": within.high}
    return {name: end for name, end in ends.items() if math.isfinite(end)}


def _requirement(
    project: Project,
    requirement: Requirement,
    criterion: Criterion,
    measured: Sequence[VariantMeasures],
    excludes: int,
) -> Plain:
    unit = project.measures.measure(criterion.measure).unit
    return {
        "id": requirement.id,
        "text": requirement.text,
        "criterion": str(criterion),
        "measure": criterion.measure,
        "statistic": criterion.statistic.value,
        "comparison": criterion.comparison.value,
        "threshold": plain_number(criterion.threshold_in(unit)),
        "excludes_better": excludes,
        "verdict": condensed([entry.verdicts[requirement.id].value for entry in measured]),
        "stale": {
            str(place): [cause.value for cause in entry.causes[requirement.id]]
            for place, entry in enumerate(measured)
            if requirement.id in entry.causes
        },
    }


def _support(support: Support | None) -> str | None:
    return None if support is None or support is Support.DOMINATED else support.value
