"""Ranges of values that measures cannot leave, from those of their inputs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from rgss.measures.definitions import MeasureSet
from rgss.measures.estimators import Estimator
from rgss.measures.expressions import Binary, Call, Name, Negative, Node, Number, Power
from rgss.measures.functions import FUNCTIONS, Shape
from rgss.measures.ranges import Range


def possible_ranges(measure_set: MeasureSet, ranges: Mapping[str, Range]) -> dict[str, Range]:
    """Range of every measure's values in trials of a design, each in the measure's unit.

    Args:
        measure_set: The measures.
        ranges: Result of `symbol_ranges`.
    """
    found = {}
    for measure in measure_set.evaluation_order:
        one = ranges[measure.id]
        if measure.summary is not None:
            one = FUNCTIONS[measure.summary.value].range(one)
        found[measure.id] = one.times(Range.of_number(1.0 / measure.si_per_unit))
    return found


def symbol_ranges(measure_set: MeasureSet, design: Mapping[str, float]) -> dict[str, Range]:
    """Range of every symbol's values in trials of a design, in SI.

    Args:
        measure_set: The measures, with the ranges of metrics.
        design: Values of the symbols that depend only on the design, in SI.
    """
    ranges = {name: Range.of_number(value) for name, value in design.items()}
    ranges.update(measure_set.trial_ranges)
    for measure in measure_set.trial_measures:
        ranges[measure.id] = range_of(measure.expression.root, ranges)
    return ranges


def estimate_ranges(measure_set: MeasureSet) -> dict[str, Range]:
    """Range of every measure's estimates whatever the design, each in the unit of its estimates.

    A share of trials is from 0 to 1; any other has the declared bounds, and those that follow from its expression.
    """
    ranges = {constant.id: Range.of_number(constant.value) for constant in measure_set.constants}
    for symbol in measure_set.inputs:
        known = measure_set.metric_ranges.get(symbol.metric, Range()) if symbol.from_trial else Range()
        ranges[symbol.id] = replace(known, length=symbol.length)
    for measure in measure_set.evaluation_order:
        ranges[measure.id] = range_of(measure.expression.root, ranges)
    found = possible_ranges(measure_set, ranges)
    for measure in measure_set.measures:
        if measure.estimate is not None and measure.estimate.statistic is Estimator.PROPORTION:
            found[measure.id] = Range(low=0.0, high=1.0)
            continue
        one = found[measure.id]
        found[measure.id] = Range(
            low=one.low if measure.least is None else max(one.low, measure.least),
            high=one.high if measure.most is None else min(one.high, measure.most),
        )
    return found


def range_of(node: Node, ranges: Mapping[str, Range]) -> Range:
    """Range that an expression's value, where it is defined, cannot leave; it may be wider than necessary.

    Args:
        node: The expression.
        ranges: Ranges of its symbols in SI.
    """
    if isinstance(node, Number):
        return Range.of_number(node.value)
    if isinstance(node, Name):
        return ranges[node.id]
    if isinstance(node, Negative):
        return range_of(node.operand, ranges).negated()
    if isinstance(node, Power):
        return range_of(node.base, ranges).power(node.exponent)
    if isinstance(node, Binary):
        left, right = range_of(node.left, ranges), range_of(node.right, ranges)
        if node.symbol in "+-":
            return left.plus(right if node.symbol == "+" else right.negated())
        return left.times(right if node.symbol == "*" else right.inverse())
    return _of_call(node, ranges)


def _of_call(node: Call, ranges: Mapping[str, Range]) -> Range:
    arguments = [range_of(argument, ranges) for argument in node.arguments]
    if len(arguments) == 1:
        return FUNCTIONS[node.function].range(arguments[0])
    if FUNCTIONS[node.function].shape is Shape.CHOICE:
        return Range(low=min(one.low for one in arguments), high=max(one.high for one in arguments))
    # Of the others only the extremes take several numbers, and they are monotone in each.
    extreme = FUNCTIONS[node.function].compute
    return Range(low=extreme([one.low for one in arguments]), high=extreme([one.high for one in arguments]))
