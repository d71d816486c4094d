"""Judging an estimate against a criterion."""

from __future__ import annotations

import math
from enum import Enum

from rgss.errors import DefinitionError, QuantityError
from rgss.measures.estimates import Estimate
from rgss.requirements import Criterion, Statistic

RELATIVE_TOLERANCE = 1e-9


class Verdict(str, Enum):
    """What the evidence says about a requirement."""

    MET = "met"
    NOT_MET = "not_met"
    INCONCLUSIVE = "inconclusive"
    NOT_RUN = "not_run"
    STALE = "stale"


def meets(criterion: Criterion, value: float, unit: str) -> bool:
    """Tell whether one value satisfies a criterion, whatever its statistic.

    A value that differs from the threshold by less than one part in 10⁹ counts as equal to it,
    so that binary rounding never decides.

    Args:
        criterion: The criterion.
        value: The value.
        unit: Its unit.

    Raises:
        DefinitionError: The value's unit measures something else than the threshold's.
    """
    try:
        threshold = criterion.threshold_in(unit)
    except QuantityError as error:
        raise DefinitionError(
            f"criterion {criterion} cannot judge a value in {unit!r}", hint="correct the threshold's unit"
        ) from error
    equal = math.isclose(value, threshold, rel_tol=RELATIVE_TOLERANCE)
    return criterion.comparison.holds(threshold if equal else value, threshold)


def judge(criterion: Criterion, estimate: Estimate, *, stale: bool = False) -> Verdict:
    """Judge an estimate of a criterion's measure.

    A criterion on the value is met, or not met, only when the value and its whole interval lie
    on one side of the threshold; otherwise, and without an interval (one trial), the evidence
    is inconclusive. A criterion on an end of the interval is met or not by that end alone.

    Args:
        criterion: The criterion.
        estimate: The estimate of its measure.
        stale: Whether the evidence is older than what it is evidence for.

    Raises:
        DefinitionError: The estimate's unit measures something else than the threshold's.
    """
    if estimate.value is None:
        return Verdict.NOT_RUN
    if stale:
        return Verdict.STALE
    bounds = {
        Statistic.VALUE: (estimate.value, estimate.low, estimate.high),
        Statistic.LOW: (estimate.low,),
        Statistic.HIGH: (estimate.high,),
    }[criterion.statistic]
    answers = [None if bound is None else meets(criterion, bound, estimate.unit) for bound in bounds]
    if None in answers or len(set(answers)) > 1:
        return Verdict.INCONCLUSIVE
    return Verdict.MET if answers[0] else Verdict.NOT_MET
