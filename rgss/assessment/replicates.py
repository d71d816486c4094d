"""Values of each measure in each replicate of a variant."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from rgss.assessment.measuring import VariantMeasures
from rgss.designs import sources
from rgss.measures import (
    COMPLETE,
    FUNCTIONS,
    Estimator,
    Measure,
    MeasureSet,
    Population,
    Value,
    design_values,
    evaluate,
    needed_symbols,
    ratio_values,
    trial_values,
)
from rgss.studies import Project, trial_specs
from rgss.trials.pieces import TrialSpec


def replicates_of(
    measures: MeasureSet, variant: VariantMeasures, *, only: Collection[str] | None = None
) -> dict[str, tuple[float | None, ...]]:
    """Value of every measure that is observed in trials, in each trial of a variant.

    Their mean is the estimate: a measure that is estimated over successful trials is unknown in the
    others, one that is a proportion is 1 or 0 in each, and one that is a ratio has its linearised values.

    Args:
        measures: The measures.
        variant: The variant with its records, in the order of their seeds.
        only: Ids of the measures that are wanted; all by default.

    Returns:
        Values in the measure's unit, by measure; None if a trial gives none.

    Raises:
        DefinitionError: A measure is not defined for the design.
    """
    design = design_values(measures, fixed=sources(variant.variant), variant=variant.variant.id)
    needed = None if only is None else needed_symbols(measures, only)
    trials = [trial_values(measures, design=design, trial=record.metrics, only=needed) for record in variant.records]
    successes = [record.metrics.get("success") == 1 for record in variant.records]
    return {
        measure.id: _row(measure, trials, successes)
        for measure in measures.measures
        if measure.estimate is not None and (only is None or measure.id in only)
    }


def common_seeds(project: Project, measured: Sequence[VariantMeasures]) -> tuple[VariantMeasures, ...]:
    """Every variant with its estimates from only those seeds that all variants have.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates and records, in the order of their seeds.

    Returns:
        The same variants if all have equal numbers; verdicts are those of all seeds.
    """
    fewest = min((len(entry.records) for entry in measured), default=0)
    return tuple(
        entry
        if len(entry.records) == fewest
        else replace(
            entry,
            trials=entry.trials[:fewest],
            records=entry.records[:fewest],
            estimates=evaluate(
                project.measures,
                fixed=sources(entry.variant),
                trials=[record.metrics for record in entry.records[:fewest]],
                variant=entry.variant.id,
                over_looks=project.study.is_sequential,
            ),
        )
        for entry in measured
    )


def specs_read(project: Project, measured: Sequence[VariantMeasures]) -> tuple[TrialSpec, ...]:
    """Trials of the estimates, with variants of equal seeds grouped.

    Args:
        project: The project with its study.
        measured: Every variant with its records.
    """
    alike: dict[tuple[int, ...], list[VariantMeasures]] = {}
    for entry in measured:
        alike.setdefault(tuple(record.seed for record in entry.records), []).append(entry)
    return tuple(
        spec
        for seeds, group in alike.items()
        for spec in trial_specs(project, variants=[entry.variant for entry in group], seeds=seeds)
    )


def _row(
    measure: Measure, trials: Sequence[Mapping[str, Value]], successes: Sequence[bool]
) -> tuple[float | None, ...]:
    rule = measure.estimate
    if rule is None or rule.statistic is not Estimator.RATIO:
        pairs = zip(trials, successes, strict=True)
        return tuple(_observed(measure, values, succeeded=succeeded) for values, succeeded in pairs)
    counted = [index for index, success in enumerate(successes) if success or rule.over is Population.ALL]
    found = dict(zip(counted, ratio_values(measure, [trials[index] for index in counted]), strict=True))
    return tuple(found.get(index) for index in range(len(trials)))


def _observed(measure: Measure, values: Mapping[str, Value], *, succeeded: bool) -> float | None:
    rule = measure.estimate
    if rule is None or (rule.over is Population.SUCCESSFUL and not succeeded):
        return None
    value = values[measure.id]
    if measure.summary is not None:
        value = FUNCTIONS[measure.summary.value].evaluate((value,))
    if not isinstance(value, float):
        return None
    quantity = value / measure.si_per_unit
    return float(quantity >= COMPLETE) if rule.statistic is Estimator.PROPORTION else quantity
