"""Evaluation of every measure from a design's values and its trials."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence

from rgss.errors import DefinitionError
from rgss.measures.definitions import InputSymbol, Measure, MeasureSet
from rgss.measures.estimates import Estimate, mean_estimate, proportion_estimate
from rgss.measures.estimators import Estimator, Population
from rgss.measures.functions import FUNCTIONS, Value
from rgss.measures.possible_values import possible_ranges, symbol_ranges
from rgss.measures.ranges import Range
from rgss.measures.ratios import quotients, ratio_estimate

Observed = float | int | None | Sequence[float | int | None]
"""Recorded metric of a trial."""

COMPLETE = 1.0
"""Value of a trial that counts as a success of a proportion."""


def evaluate(
    measure_set: MeasureSet,
    *,
    fixed: Mapping[str, float | str],
    trials: Sequence[Mapping[str, Observed]],
    variant: int,
    over_looks: bool = False,
    only: Collection[str] | None = None,
) -> dict[str, Estimate]:
    """Estimate every measure of one variant.

    A measure that depends only on the design is computed once. Any other is computed for each trial and estimated over
    all or the successful trials with a known value.

    Args:
        measure_set: The measures.
        fixed: The value of each ``design.…`` and ``component.…`` source, in SI. Unused sources are allowed, including
            texts.
        trials: The metrics of each trial, in SI; an absent key is an unknown value. A trial
            succeeded if its metric ``success`` is 1.
        variant: The variant's id, for messages.
        over_looks: Whether the number of trials may depend on their results, as in replication until decided; the
            intervals then hold at any number of trials.
        only: The ids of the measures; None for all.

    Returns:
        The estimate of each measure by its id, in the order of the file, in the measure's unit.

    Raises:
        DefinitionError: A value of the design is missing or is a text; a measure is undefined for this design (a
        division by zero); a metric does not have the declared shape; a trial's value is outside the declared bounds of
        its measure; trials differ in a value declared as ``of_design``.
    """
    design = design_values(measure_set, fixed=fixed, variant=variant)
    needed = None if only is None else needed_symbols(measure_set, only)
    rows = [trial_values(measure_set, design=design, trial=trial, only=needed) for trial in trials]
    successes = [trial.get("success") == 1 for trial in trials]
    # An interval of fewer trials has declared bounds alone.
    ranges = symbol_ranges(measure_set, design) if len(rows) > 1 else {}
    possible = possible_ranges(measure_set, ranges) if ranges else {}
    estimates: dict[str, Estimate] = {}
    for measure in measure_set.measures:
        if only is not None and measure.id not in only:
            continue
        rule = measure.estimate
        if rule is None:
            estimates[measure.id] = Estimate.exact(design[measure.id] / measure.si_per_unit, measure.unit)
            continue
        counted = [row for row, success in zip(rows, successes, strict=True) if success or rule.over is Population.ALL]
        if rule.statistic is Estimator.RATIO:
            _require_declared(measure, quotients(measure, counted), variant)
            within = _bounds(measure, possible.get(measure.id, Range()))
            estimates[measure.id] = ratio_estimate(
                measure, counted, ranges=ranges, within=within, over_looks=over_looks
            )
            continue
        known = [value for row in counted if (value := _summarised(measure, row)) is not None]
        if measure.id not in measure_set.noisy:
            estimates[measure.id] = _same(measure, known, variant)
        elif rule.statistic is Estimator.PROPORTION:
            complete = sum(value >= COMPLETE for value in known)
            estimates[measure.id] = proportion_estimate(complete, len(known), over_looks=over_looks)
        else:
            within = possible.get(measure.id, Range())
            estimates[measure.id] = _mean(measure, known, within, variant, over_looks=over_looks)
    return estimates


def replicate_ranges(
    measure_set: MeasureSet, *, fixed: Mapping[str, float | str], estimates: Mapping[str, Estimate], variant: int
) -> dict[str, Range]:
    """Possible values of a trial of each measure that is estimated from trials, in the measure's unit.

    They are the bounds of `evaluate`: those that are declared, that follow from the definition, or, of a measure whose
    inputs are declared as ``of_design``, its value. A ratio has none.

    Args:
        measure_set: The measures.
        fixed: As for `evaluate`.
        estimates: The result of `evaluate`.
        variant: The variant's id, for messages.

    Raises:
        DefinitionError: As `evaluate`.
    """
    design = design_values(measure_set, fixed=fixed, variant=variant)
    possible = possible_ranges(measure_set, symbol_ranges(measure_set, design))
    found = {}
    for measure in measure_set.measures:
        rule = measure.estimate
        if rule is None or rule.statistic is Estimator.RATIO:
            continue
        known = estimates[measure.id].value
        if measure.id not in measure_set.noisy and known is not None:
            found[measure.id] = Range.of_number(known)
            continue
        within = _bounds(measure, possible.get(measure.id, Range()))
        low = max(within.low, 0.0) if measure.least is None and measure.is_never_negative else within.low
        found[measure.id] = Range(low=low, high=within.high)
    return found


def _same(measure: Measure, known: Sequence[float], variant: int) -> Estimate:
    """Exact value of a measure that depends on neither seed nor draws."""
    if not known:
        return Estimate.unknown(measure.unit)
    if min(known) != max(known):
        raise DefinitionError(
            f"trials of variant {variant} give {measure.id} = {min(known):g} and {max(known):g} {measure.unit}, "
            "but its inputs are declared as of_design",
            hint="remove 'of_design' from the input in the measures file",
        )
    return Estimate(value=known[0], unit=measure.unit, low=known[0], high=known[0], n=len(known))


def _mean(measure: Measure, known: Sequence[float], possible: Range, variant: int, *, over_looks: bool) -> Estimate:
    """Mean of a measure's values, with bounds that are declared or follow from its definition or its unit."""
    _require_declared(measure, known, variant)
    least, most = measure.least, measure.most
    # One trial has no variance, so only a declared bound gives an interval.
    if len(known) > 1:
        if least is None and measure.is_never_negative and min(known) >= 0.0:
            least = 0.0
        least = possible.low if least is None and math.isfinite(possible.low) else least
        most = possible.high if most is None and math.isfinite(possible.high) else most
    return mean_estimate(known, measure.unit, least=least, most=most, over_looks=over_looks)


def _bounds(measure: Measure, possible: Range) -> Range:
    """Range of a quotient: the declared bounds, or those that follow from its definition."""
    return Range(
        low=possible.low if measure.least is None else measure.least,
        high=possible.high if measure.most is None else measure.most,
    )


def _require_declared(measure: Measure, known: Sequence[float], variant: int) -> None:
    for value in known:
        if (measure.least is not None and value < measure.least) or (measure.most is not None and value > measure.most):
            raise DefinitionError(
                f"a trial of variant {variant} gives {measure.id} = {value:g} {measure.unit}, "
                "outside the bounds that the measure declares",
                hint="correct 'least' and 'most' of its estimate in the measures file",
            )


def design_values(measure_set: MeasureSet, *, fixed: Mapping[str, float | str], variant: int) -> dict[str, float]:
    """Constants, inputs and measures that depend only on a design.

    Args:
        measure_set: The measures.
        fixed: As for `evaluate`.
        variant: The variant's id, for messages.

    Returns:
        Their values in SI by symbol.

    Raises:
        DefinitionError: As for `evaluate`.
    """
    values = {constant.id: constant.value for constant in measure_set.constants}
    of_design = measure_set.design_inputs
    missing = [symbol.source for symbol in of_design if symbol.source not in fixed]
    if missing:
        raise DefinitionError(
            f"variant {variant} has no value for {', '.join(missing)}",
            hint="give it in the design space or the component catalogue, or correct the input's source",
        )
    for symbol in of_design:
        value = fixed[symbol.source]
        if isinstance(value, str) or not math.isfinite(value):
            raise DefinitionError(
                f"{symbol.source} of variant {variant} is {value!r}; the measures' input {symbol.id!r} needs a number"
            )
        values[symbol.id] = float(value)
    for measure in measure_set.design_measures:
        result = measure.expression.evaluate(values)
        if not isinstance(result, float):
            raise DefinitionError(
                f"measure {measure.id!r} is not defined for variant {variant}: {measure.expression.text}",
                hint="look for a division by zero or the root of a negative number",
            )
        values[measure.id] = result
    return values


def needed_symbols(measure_set: MeasureSet, measures: Collection[str]) -> frozenset[str]:
    """Ids of measures, with all measures and symbols on which they depend, directly or not."""
    return frozenset(measures).union(*(measure_set.used[each] for each in measures))


def trial_values(
    measure_set: MeasureSet,
    *,
    design: Mapping[str, float],
    trial: Mapping[str, Observed],
    only: Collection[str] | None = None,
) -> dict[str, Value]:
    """Value of every symbol in one trial.

    Args:
        measure_set: The measures.
        design: Result of `design_values` for the trial's variant.
        trial: The trial's metrics, in SI.
        only: Symbols that are wanted, with those on which they depend; all by default.

    Returns:
        The values in SI by symbol: numbers and rows, None if unknown.

    Raises:
        DefinitionError: A metric does not have the declared shape.
    """
    values: dict[str, Value] = dict(design)
    for metric, symbol in measure_set.trial_inputs:
        if only is not None and symbol.id not in only:
            continue
        observed = trial.get(metric)
        values[symbol.id] = None if observed is None else _observed(symbol, observed)
    for measure in measure_set.trial_measures:
        if only is None or measure.id in only:
            values[measure.id] = measure.expression.evaluate(values)
    return values


def _observed(symbol: InputSymbol, metric: object) -> Value:
    if isinstance(metric, (list, tuple)):
        if symbol.length != len(metric):
            declared = "one number" if symbol.length is None else str(symbol.length)
            raise DefinitionError(f"{symbol.source} has {len(metric)} entries; input {symbol.id!r} declares {declared}")
        return tuple(_number(symbol, entry) for entry in metric)
    number = _number(symbol, metric)
    if symbol.length is not None:
        raise DefinitionError(f"{symbol.source} is one number; input {symbol.id!r} declares {symbol.length}")
    return number


def _number(symbol: InputSymbol, value: object) -> float | None:
    if value is None:
        return None
    if not isinstance(value, (int, float)):
        raise DefinitionError(f"{symbol.source} is {value!r}; input {symbol.id!r} needs a number")
    return float(value) if math.isfinite(value) else None


def _summarised(measure: Measure, values: Mapping[str, Value]) -> float | None:
    value = values[measure.id]
    if measure.summary is not None:
        value = FUNCTIONS[measure.summary.value].evaluate((value,))
    return value / measure.si_per_unit if isinstance(value, float) else None
