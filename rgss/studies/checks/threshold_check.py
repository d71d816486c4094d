"""Findings about thresholds beyond the values that a measure can have, or that exclude each other."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from rgss.figures import exact_figure
from rgss.findings import Finding, Severity
from rgss.measures import Range, estimate_ranges
from rgss.requirements import Comparison, Criterion, Statistic
from rgss.studies.project import Project

_ORDER = {Statistic.LOW: 0, Statistic.VALUE: 1, Statistic.HIGH: 2}


def threshold_findings(project: Project) -> Iterator[Finding]:
    """Report criteria that no value of their measure can meet, alone or together; warn of those that each one meets.

    The bounds are those that the measure declares, and those that follow from its definition.
    """
    ranges = estimate_ranges(project.measures)
    for requirement in project.requirements.system:
        criterion = requirement.criterion
        if criterion is None:
            continue
        unit = project.measures.measure(criterion.measure).unit
        outcome = _outcome(criterion, criterion.threshold_in(unit), ranges[criterion.measure], unit)
        if outcome is None:
            continue
        reason, is_met = outcome
        place = project.requirements.places[requirement.id]
        yield place.document.finding(
            "study.threshold-range",
            f"{requirement.id} demands {criterion}, but {criterion.measure} is {reason}: "
            f"{'every design meets it' if is_met else 'no design can meet it'}",
            (*place.location, "criterion", "threshold"),
            severity=Severity.WARNING if is_met else Severity.ERROR,
            hint="correct the threshold, or the bounds of the measure",
        )
    yield from _contradictions(project)


def _contradictions(project: Project) -> Iterator[Finding]:
    """Pairs of criteria on one measure of which the one asks for more than the other allows."""
    judged = [
        (requirement, requirement.criterion)
        for requirement in project.requirements.system
        if requirement.criterion is not None
    ]
    for (earlier, one), (later, other) in itertools.combinations(judged, 2):
        if one.measure != other.measure or one.comparison.is_lower_bound == other.comparison.is_lower_bound:
            continue
        least, most = (one, other) if one.comparison.is_lower_bound else (other, one)
        # The lower end of an interval is at most the value, and that at most the upper end.
        if _ORDER[least.statistic] > _ORDER[most.statistic]:
            continue
        unit = project.measures.measure(one.measure).unit
        if most.comparison.holds(least.threshold_in(unit), most.threshold_in(unit)) and least.comparison.holds(
            most.threshold_in(unit), least.threshold_in(unit)
        ):
            continue
        place = project.requirements.places[later.id]
        yield place.document.finding(
            "study.contradiction",
            f"{later.id} demands {other}, and {earlier.id} demands {one}: no design can meet both",
            (*place.location, "criterion", "threshold"),
            hint="correct one of the thresholds",
        )


def _outcome(criterion: Criterion, threshold: float, possible: Range, unit: str) -> tuple[str, bool] | None:
    """The bound that decides a criterion, and whether it is met; None if values on both sides are possible."""
    suffix = "" if unit == "1" else f" {unit}"
    least, most = f"at least {exact_figure(possible.low)}{suffix}", f"at most {exact_figure(possible.high)}{suffix}"
    if criterion.comparison.is_lower_bound:
        if not criterion.comparison.holds(possible.high, threshold):
            return most, False
        # A threshold at the bound itself, such as a clearance of at least 0 mm, is deliberate.
        return (least, True) if Comparison.ABOVE.holds(possible.low, threshold) else None
    if not criterion.comparison.holds(possible.low, threshold):
        return least, False
    return (most, True) if Comparison.BELOW.holds(possible.high, threshold) else None
