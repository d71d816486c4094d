"""Screening of designs by kinematic trials, before contact trials.

A design is screened out if the bounds from kinematic trials (see `rgss.assessment.estimate_bounds`) prove that it
cannot meet a requirement, not even within the tolerance of the choice, or if the study's promotion rule limits the
number of promoted designs and others are better. In that comparison every measure has its best possible value, and
quantities that kinematic fidelity does not determine (success in contact, slip, forces, times of motion) have their
best value for every design; so a design is never excluded by unknown quantities.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace

from rgss.assessment import (
    EstimateBounds,
    VariantMeasures,
    VerdictRecord,
    bounds_by_measure,
    measure_variants,
    requirements_with_criteria,
)
from rgss.decision.preference_model import quantity_of
from rgss.decision.screening_result import ScreenedVariant, ScreeningOutcome, ScreeningResult
from rgss.designs import DesignVariant
from rgss.errors import DefinitionError
from rgss.evidence import EvidenceStore
from rgss.figures import rounded_figure
from rgss.measures import Estimate, Verdict, judge
from rgss.requirements import Criterion
from rgss.studies import Project, Promotion, trial_specs
from rgss.tradeoff import ValueFunction
from rgss.tradeoff.problem import TIE_TOLERANCE
from rgss.trials import TrialSpec


def promoted(project: Project, measured: Sequence[VariantMeasures]) -> ScreeningResult:
    """Outcome of screening for each design, with the reason.

    Ties at the bound of `keep` are promoted together, so that ids do not decide.

    Args:
        project: The project with its study, which has a screening.
        measured: Every variant with its estimates at the screening fidelity.

    Raises:
        DefinitionError: The study has no screening.
        TradeoffError: A value function of the study is ill posed.
    """
    screening = project.study.screening
    if screening is None:
        raise DefinitionError(
            f"study {project.study.id!r} has no screening", hint="write 'fidelity: [kinematic, contact]'"
        )
    functions = _value_functions(project)
    entries = [_first_look(project, entry, functions) for entry in measured]
    if any(one.outcome is ScreeningOutcome.IMPOSSIBLE for one in entries) and not any(one.goes_on for one in entries):
        spared = "no design can meet every requirement, so all go on"
        entries = [
            replace(one, outcome=ScreeningOutcome.SPARED, reason=f"{spared}; this one cannot: {one.reason}")
            for one in entries
        ]
    return ScreeningResult(screening=screening, variants=tuple(_ranked(entries, screening.promotion)))


def screening_specs(project: Project, *, variants: Iterable[DesignVariant] | None = None) -> tuple[TrialSpec, ...]:
    """The trials of the screening fidelity; none if the study has no screening.

    Args:
        project: The project with its study.
        variants: The designs; all by default.
    """
    screening = project.study.screening
    if screening is None:
        return ()
    return trial_specs(project.with_fidelity(screening.fidelity.value), variants=variants)


def screen(project: Project, store: EvidenceStore | None) -> ScreeningResult | None:
    """Screen by the stored evidence; None if the study has no screening.

    Raises:
        EvidenceError: The store is damaged.
    """
    screening = project.study.screening
    if screening is None:
        return None
    return promoted(project, measure_variants(project.with_fidelity(screening.fidelity.value), store))


def surviving_specs(
    project: Project, result: ScreeningResult, *, variants: Iterable[DesignVariant] | None = None
) -> tuple[TrialSpec, ...]:
    """The deciding trials of the promoted designs.

    Args:
        project: The project with its study.
        result: The outcome of screening.
        variants: The designs to select from; all by default.
    """
    among = project.designs.expand() if variants is None else variants
    return trial_specs(project, variants=result.promoted(among))


def measure_survivors(
    project: Project, store: EvidenceStore | None, *, recorded: VerdictRecord | None = None
) -> tuple[tuple[VariantMeasures, ...], ScreeningResult | None]:
    """Every promoted variant, and the outcome of screening.

    Args:
        project: The project with its study.
        store: The evidence; None if there is none yet.
        recorded: As for `measure_variants`.

    Raises:
        DefinitionError: A measure is not defined for a design.
        EvidenceError: The store is damaged.
    """
    measured = measure_variants(project, store, recorded=recorded)
    result = screen(project, store)
    if result is None:
        return measured, None
    survivors = set(result.survivors)
    return tuple(entry for entry in measured if entry.variant.id in survivors), result


def reopened(result: ScreeningResult, project: Project, measured: Sequence[VariantMeasures]) -> tuple[int, ...]:
    """The screened-out designs that would be promoted under suppositions.

    Args:
        result: The outcome of screening without them.
        project: The project under the suppositions.
        measured: Every variant with its estimates at the screening fidelity under them.

    Returns:
        Their ids; they have only evidence of screening.
    """
    there = set(result.survivors)
    return tuple(variant for variant in promoted(project, measured).survivors if variant not in there)


def _first_look(
    project: Project, entry: VariantMeasures, functions: Mapping[str, tuple[float, ValueFunction]]
) -> ScreenedVariant:
    if entry.missing:
        reason = f"{entry.missing} of its trials at the screening fidelity have no evidence"
        return ScreenedVariant(variant=entry.variant.id, outcome=ScreeningOutcome.UNSCREENED, reason=reason)
    bounds = bounds_by_measure(project, entry)
    missed = {
        requirement.id: requirement.criterion
        for requirement in requirements_with_criteria(project)
        if requirement.criterion is not None and not _possible(project, requirement.criterion, bounds)
    }
    value = sum(weight * _best(function, bounds[measure]) for measure, (weight, function) in functions.items())
    return ScreenedVariant(
        variant=entry.variant.id,
        outcome=ScreeningOutcome.IMPOSSIBLE if missed else ScreeningOutcome.PROMOTED,
        reason="; ".join(_why(name, criterion, bounds) for name, criterion in missed.items())
        or "no evidence excludes it",
        missed=tuple(missed),
        best_value=value,
    )


def _possible(project: Project, criterion: Criterion, bounds: Mapping[str, EstimateBounds]) -> bool:
    """True if a verdict other than not met is possible, or an estimate that the choice tolerates.

    A criterion has one threshold: if neither end of the bounds meets it, no value between them does.
    """
    found = bounds[criterion.measure]
    if not found.bounded or not found.estimates:
        return True
    tolerance = project.study.trade_off.tolerance if criterion.measure in project.measures.noisy else 0.0
    return any(
        judge(criterion, estimate) is not Verdict.NOT_MET or _is_tolerated(criterion, estimate, tolerance)
        for estimate in found.estimates
    )


def _is_tolerated(criterion: Criterion, estimate: Estimate, tolerance: float) -> bool:
    """True if an estimate, or an end of its interval, misses a threshold by at most a share of it."""
    threshold = criterion.threshold_in(estimate.unit)
    slack = math.copysign(tolerance * abs(threshold), criterion.comparison.margin(1.0, 0.0))
    return any(
        criterion.comparison.holds(end + slack, threshold)
        for end in (estimate.value, estimate.low, estimate.high)
        if end is not None
    )


def _why(requirement: str, criterion: Criterion, bounds: Mapping[str, EstimateBounds]) -> str:
    estimates = bounds[criterion.measure].estimates
    values = [one.value for one in estimates if one.value is not None]
    unit = "" if estimates[0].unit == "1" else f" {estimates[0].unit}"
    low, high = min(values), max(values)
    between = (
        f"{rounded_figure(low)}{unit}" if low == high else f"from {rounded_figure(low)} to {rounded_figure(high)}{unit}"
    )
    return f"{requirement} requires {criterion}, and {criterion.measure} is {between}"


def _value_functions(project: Project) -> dict[str, tuple[float, ValueFunction]]:
    trade_off = project.study.trade_off
    found: dict[str, tuple[float, ValueFunction]] = {}
    for valued in trade_off.valued:
        function = valued.function(lambda anchor, measure=valued.measure: quantity_of(project, anchor, measure))  # type: ignore[misc]
        found[valued.measure] = (trade_off.weighting.weights[valued.measure], function)
    return found


def _best(function: ValueFunction, bounds: EstimateBounds) -> float:
    """Greatest value of a quantity within bounds; 1 if it is unbounded, 0 if there is no quantity."""
    if not bounds.bounded:
        return 1.0
    quantities = [one.value for one in bounds.estimates if one.value is not None]
    if function.peak is not None and quantities and min(quantities) <= function.peak <= max(quantities):
        return 1.0
    return max((function.value_at(quantity) for quantity in quantities), default=0.0)


def _ranked(entries: Sequence[ScreenedVariant], promotion: Promotion) -> list[ScreenedVariant]:
    contenders = [one for one in entries if one.outcome is ScreeningOutcome.PROMOTED and one.best_value is not None]
    values = sorted((one.best_value for one in contenders if one.best_value is not None), reverse=True)
    bars: list[tuple[float, str]] = []
    if values and promotion.within is not None:
        bars.append((values[0] - promotion.within, f"more than {promotion.within:g} below the best, {values[0]:.4g}"))
    if promotion.keep is not None and len(values) > promotion.keep:
        last = values[promotion.keep - 1]
        bars.append((last, f"below those of the best {promotion.keep}, at least {last:.4g}"))
    found = []
    for one in entries:
        beaten = [
            words
            for bar, words in bars
            if one.outcome is ScreeningOutcome.PROMOTED
            and one.best_value is not None
            and one.best_value < bar - TIE_TOLERANCE
        ]
        if beaten:
            reason = f"its value is at most {one.best_value:.4g}, {' and '.join(beaten)}"
            found.append(replace(one, outcome=ScreeningOutcome.OUTRANKED, reason=reason))
        else:
            found.append(one)
    return found
