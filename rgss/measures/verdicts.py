"""Verdict of an estimate on a criterion."""

from __future__ import annotations

from enum import Enum

from rgss.errors import DefinitionError, QuantityError
from rgss.measures.estimates import Estimate
from rgss.requirements import Criterion, Statistic


class Verdict(str, Enum):
    """Verdict of the evidence on a requirement."""

    MET = "met"
    NOT_MET = "not_met"
    INCONCLUSIVE = "inconclusive"
    NOT_RUN = "not_run"
    STALE = "stale"


class StaleCause(str, Enum):
    """Cause of staleness: the input that changed since the evidence was made."""

    REQUIREMENT = "requirement"
    """The requirement: its sentence, its criterion or how it is verified."""
    MEASURE = "measure"
    """The definition of its measure, or of anything that the measure is computed from."""
    MODEL = "model"
    """What is simulated: the design, the scene, the study's settings."""
    CODE = "code"
    """The source of rgss that makes trials."""
    ENGINES = "engines"
    """The version of an engine."""


def meets(criterion: Criterion, value: float, unit: str) -> bool:
    """True if one value satisfies a criterion, whatever its statistic.

    A value within `rgss.requirements.RELATIVE_TOLERANCE` of the threshold counts as equal to it.

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
    return criterion.comparison.holds(value, threshold)


def judge(criterion: Criterion, estimate: Estimate, *, stale: bool = False) -> Verdict:
    """Judge an estimate of a criterion's measure.

    A criterion on the value is met only when the value and the far end of its interval keep the
    threshold, and not met only when the value and the near end miss it; otherwise, and where that
    end is unknown (one trial), the evidence is inconclusive. An end is wrong in at most 2.5 % of
    studies, so a verdict of met, or of not met, is too. A criterion on an end of the interval is met
    or not by that end alone.

    Args:
        criterion: The criterion.
        estimate: The estimate of its measure from the evidence that holds now.
        stale: Whether there is evidence for the verdict, but something that it
            depends on changed since; see `StaleCause`. Such a verdict is stale, whatever else
            is known; without any evidence, old or new, it is not run.

    Raises:
        DefinitionError: The estimate's unit measures something else than the threshold's.
    """
    if stale:
        return Verdict.STALE
    if estimate.value is None:
        return Verdict.NOT_RUN
    ends = {Statistic.LOW: estimate.low, Statistic.HIGH: estimate.high}
    if criterion.statistic is not Statistic.VALUE:
        end = ends[criterion.statistic]
        if end is None:
            return Verdict.INCONCLUSIVE
        return Verdict.MET if meets(criterion, end, estimate.unit) else Verdict.NOT_MET
    far, near = estimate.low, estimate.high
    if not criterion.comparison.is_lower_bound:
        far, near = near, far
    if meets(criterion, estimate.value, estimate.unit):
        return Verdict.MET if far is not None and meets(criterion, far, estimate.unit) else Verdict.INCONCLUSIVE
    if near is None or meets(criterion, near, estimate.unit):
        return Verdict.INCONCLUSIVE
    return Verdict.NOT_MET
