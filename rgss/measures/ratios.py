"""Ratio of means, such as picks per hour: total divided by total, not the mean of the trials' ratios."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from rgss.measures.anytime_evidence import anytime_mean_limits
from rgss.measures.definitions import Measure
from rgss.measures.estimates import TAIL, Estimate
from rgss.measures.expressions import Binary
from rgss.measures.functions import Value
from rgss.measures.mean_limits import mean_limits
from rgss.measures.possible_values import range_of
from rgss.measures.ranges import Range
from rgss.measures.ratio_limits import Pair, ratio_limits

QUOTIENT = "/"


def ratio_values(measure: Measure, rows: Sequence[Mapping[str, Value]]) -> list[float | None]:
    """Linearised values of a ratio of means, whose mean is the ratio.

    For numerators a and denominators b with means ā and b̄, r = ā/b̄ and the values are r + (a - r b) / b̄: their mean
    is r, and their variance divided by n is the variance of r to first order (delta method; Cochran 1977, section
    2.11).

    Args:
        measure: A measure estimated as a ratio, with a quotient as expression.
        rows: Value of every symbol in each trial, in SI.

    Returns:
        A value in the measure's unit for each row; None for those with an unknown numerator or denominator, and for all
        if the denominators sum to 0.
    """
    pairs = _pairs(measure, rows)
    known = [pair for pair in pairs if pair is not None]
    total = math.fsum(b for _, b in known)
    if not known or total == 0.0:
        return [None] * len(rows)
    ratio, mean = math.fsum(a for a, _ in known) / total, total / len(known)
    return [
        None if pair is None else (ratio + (pair[0] - ratio * pair[1]) / mean) / measure.si_per_unit for pair in pairs
    ]


def quotients(measure: Measure, rows: Sequence[Mapping[str, Value]]) -> list[float]:
    """Quotient of each trial in the measure's unit, without those of denominator 0.

    Args:
        measure: A measure estimated as a ratio.
        rows: Value of every symbol in each trial, in SI.
    """
    known = [pair for pair in _pairs(measure, rows) if pair is not None]
    return [a / b / measure.si_per_unit for a, b in known if b != 0.0]


def ratio_estimate(
    measure: Measure,
    rows: Sequence[Mapping[str, Value]],
    *,
    ranges: Mapping[str, Range],
    within: Range,
    over_looks: bool = False,
) -> Estimate:
    """Ratio of means with the limits of `rgss.measures.ratio_limits`, which stay within what is possible.

    If the denominators may have either sign, the limits are those of the mean of the linearised values, cut to what is
    possible. One trial has no limits but those that the measure declares.

    Args:
        measure: A measure estimated as a ratio, with a quotient as expression.
        rows: Value of every symbol in each trial, in SI.
        ranges: Ranges of the symbols in SI.
        within: Range that the quotient of a trial cannot leave, in the measure's unit.
        over_looks: Whether the number of trials may depend on their values; the limits then hold at any number.
    """
    linearised = [value for value in ratio_values(measure, rows) if value is not None]
    root = measure.expression.root
    if not linearised or not isinstance(root, Binary):
        return Estimate.unknown(measure.unit)
    value = math.fsum(linearised) / len(linearised)
    low, high = measure.least, measure.most
    if len(linearised) > 1:
        found = ratio_limits(
            [pair for pair in _pairs(measure, rows) if pair is not None],
            numerator=range_of(root.left, ranges),
            denominator=range_of(root.right, ranges),
            tail=TAIL,
            over_looks=over_looks,
        )
        if found is None:
            limits = anytime_mean_limits if over_looks else mean_limits
            low, high = limits(linearised, least=None, most=None, tail=TAIL)
        else:
            low, high = (None if limit is None else limit / measure.si_per_unit for limit in found)
        low, high = _cut(low, high, within)
        # Rounding must not exclude the value itself.
        low, high = None if low is None else min(low, value), None if high is None else max(high, value)
    return Estimate(value=value, unit=measure.unit, low=low, high=high, n=len(linearised))


def _cut(low: float | None, high: float | None, within: Range) -> tuple[float | None, float | None]:
    """Limits within a range, whose ends serve for unknown ones."""
    bottom = within.low if low is None else max(low, within.low)
    top = within.high if high is None else min(high, within.high)
    return (bottom if math.isfinite(bottom) else None), (top if math.isfinite(top) else None)


def _pairs(measure: Measure, rows: Sequence[Mapping[str, Value]]) -> list[Pair | None]:
    """Numerator and denominator of each trial in SI; None if one is unknown."""
    root = measure.expression.root
    if not isinstance(root, Binary) or root.symbol != QUOTIENT:
        return [None] * len(rows)
    pairs = [(root.left.evaluate(row), root.right.evaluate(row)) for row in rows]
    return [(a, b) if isinstance(a, float) and isinstance(b, float) else None for a, b in pairs]
