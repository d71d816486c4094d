"""Verdict of a criterion from an estimate."""

from __future__ import annotations

from enum import Enum

from rgss.errors import DefinitionError, QuantityError
from rgss.measures.estimates import Estimate
from rgss.requirements import Criterion, Statistic


class Verdict(str, Enum):
    """Verdict of a requirement from evidence."""

    MET = "met"
    NOT_MET = "not_met"
    INCONCLUSIVE = "inconclusive"
    NOT_RUN = "not_run"
    STALE = "stale"


class StaleCause(str, Enum):
    """Cause of staleness: the changed input of the evidence."""

    REQUIREMENT = "requirement"
    """The requirement: its text, its criterion or its verification method."""
    MEASURE = "measure"
    """The definition of its measure, or of one of its dependencies."""
    MODEL = "model"
    """Inputs of the simulation: design, scene, settings of the study."""
    CODE = "code"
    """The source code of rgss for trials."""
    ENGINES = "engines"
    """The version of an engine."""
    FILES = "files"
    """A file that a verification record rests on: its content, or that it is there."""
    UNRECORDED = "unrecorded"
    """Unknown: the run of tests did not record what it tested."""


def meets(criterion: Criterion, value: float, unit: str) -> bool:
    """True if a value satisfies a criterion, regardless of its statistic.

    A value within `rgss.requirements.RELATIVE_TOLERANCE` of the threshold counts as equal to it.

    Args:
        criterion: The criterion.
        value: The value.
        unit: Its unit.

    Raises:
        DefinitionError: The dimensions of the value's and the threshold's units differ.
    """
    try:
        threshold = criterion.threshold_in(unit)
    except QuantityError as error:
        raise DefinitionError(
            f"the value must be in a unit of criterion {criterion}, got {unit!r}", hint="correct the threshold's unit"
        ) from error
    return criterion.comparison.holds(value, threshold)


def judge(criterion: Criterion, estimate: Estimate, *, stale: bool = False) -> Verdict:
    """Verdict of a criterion from an estimate of its measure.

    A criterion on the value is met only if the value and the unfavourable limit of its interval satisfy the threshold,
    and not met only if the value and the favourable limit violate it; otherwise, and if that limit is unknown (one
    trial), it is inconclusive. A limit fails in at most 2.5 % of studies, so a verdict of met or not met does too. A
    criterion on a limit of the interval is decided by that limit only.

    Args:
        criterion: The criterion.
        estimate: The estimate of its measure from current evidence.
        stale: True if evidence exists, but an input has changed since; see `StaleCause`. The verdict is then stale in
            any case; without any evidence it is not run.

    Raises:
        DefinitionError: The dimensions of the estimate's and the threshold's units differ.
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
