"""Measures whose expression has no value for a design, whatever its trials observe."""

from __future__ import annotations

from collections.abc import Mapping

from rgss.measures.definitions import MeasureSet
from rgss.measures.expressions import Binary, Call, Negative, Node, Power
from rgss.measures.functions import FUNCTIONS, Shape
from rgss.measures.possible_values import range_of
from rgss.measures.ranges import Range

_ROOT = "sqrt"


def undefined_measures(measure_set: MeasureSet, *, fixed: Mapping[str, float | str]) -> tuple[str, ...]:
    """Ids of the measures that are undefined for a design, without those that only depend on one of them.

    A measure that depends only on the design is computed. For any other the division by zero, or the root of a negative
    number, is proven by the ranges of the metrics, so that one may be undefined in every trial and not be found.

    Args:
        measure_set: The measures, with the ranges of metrics.
        fixed: The value of each ``design.…`` and ``component.…`` source, in SI. A measure that needs an absent one, or
            a text, is left out.
    """
    values = {constant.id: constant.value for constant in measure_set.constants}
    for symbol in measure_set.design_inputs:
        value = fixed.get(symbol.source)
        if isinstance(value, (int, float)):
            values[symbol.id] = float(value)
    known = {symbol.id for symbol in measure_set.inputs if symbol.from_trial} | {*values}
    ranges = {**{name: Range.of_number(value) for name, value in values.items()}, **measure_set.trial_ranges}
    undefined = []
    for measure in measure_set.evaluation_order:
        if not known.issuperset(measure.expression.names):
            continue
        if measure.from_trials:
            is_defined = not _is_never_defined(measure.expression.root, ranges)
            ranges[measure.id] = range_of(measure.expression.root, ranges)
        else:
            result = measure.expression.evaluate(values)
            is_defined = isinstance(result, float)
            if isinstance(result, float):
                values[measure.id] = result
                ranges[measure.id] = Range.of_number(result)
        if is_defined:
            known.add(measure.id)
        else:
            undefined.append(measure.id)
    return tuple(undefined)


def _is_never_defined(node: Node, ranges: Mapping[str, Range]) -> bool:
    """True if a part of an expression divides by zero, or takes the root of a negative number, in every trial."""
    if isinstance(node, Negative):
        return _is_never_defined(node.operand, ranges)
    if isinstance(node, Binary):
        by_zero = node.symbol == "/" and _is_zero(range_of(node.right, ranges))
        return by_zero or _is_never_defined(node.left, ranges) or _is_never_defined(node.right, ranges)
    if isinstance(node, Power):
        base = range_of(node.base, ranges)
        is_root = not float(node.exponent).is_integer()
        undefined = (node.exponent < 0.0 and _is_zero(base)) or (is_root and base.high < 0.0)
        return undefined or _is_never_defined(node.base, ranges)
    if isinstance(node, Call):
        if FUNCTIONS[node.function].shape is Shape.CHOICE:
            return all(_is_never_defined(one, ranges) for one in node.arguments)
        of_negative = node.function == _ROOT and range_of(node.arguments[0], ranges).high < 0.0
        return of_negative or any(_is_never_defined(one, ranges) for one in node.arguments)
    return False


def _is_zero(one: Range) -> bool:
    return one.low == one.high == 0.0
