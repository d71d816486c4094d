"""Ratio of means, such as picks per hour: total divided by total, not the mean of the trials' ratios."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from rgss.measures.definitions import Measure
from rgss.measures.expressions import Binary
from rgss.measures.functions import Value

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
    root = measure.expression.root
    if not isinstance(root, Binary) or root.symbol != QUOTIENT:
        return [None] * len(rows)
    pairs = [(root.left.evaluate(row), root.right.evaluate(row)) for row in rows]
    known = [(a, b) for a, b in pairs if isinstance(a, float) and isinstance(b, float)]
    total = math.fsum(b for _, b in known)
    if not known or total == 0.0:
        return [None] * len(rows)
    ratio, mean = math.fsum(a for a, _ in known) / total, total / len(known)
    return [
        (ratio + (a - ratio * b) / mean) / measure.si_per_unit
        if isinstance(a, float) and isinstance(b, float)
        else None
        for a, b in pairs
    ]
