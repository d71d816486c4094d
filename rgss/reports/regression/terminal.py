"""A guard's report as lines for a terminal: one for each finding."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.findings import printable
from rgss.regression import Outcome, RegressionReport
from rgss.reports.regression.words import (
    behaviour_of,
    counts_of,
    detail_of,
    inputs_of,
    listed,
    power_lines,
    reasons_of,
    remedy_of,
    title_of,
)


def report_lines(report: RegressionReport, *, everything: bool = False) -> Iterator[str]:
    """Lines of the report, without terminal control characters.

    Args:
        report: The report.
        everything: True to show metrics that are the same, and the power of those that have enough.
    """
    yield printable(f"{report.study} against {report.baseline}: {report.verdict}")
    for failing in report.failing:
        yield printable(f"  FAILED        {failing.trouble.value}: {failing.text}")
    for reason in reasons_of(report):
        word = "ACCEPTED" if report.accepted else "CHANGED"
        yield printable(f"  {word:<13} {reason}")
    for comparison in listed(report):
        if everything or comparison.outcome is not Outcome.SAME:
            word = comparison.outcome.value.upper()
            yield printable(f"  {word:<13} {title_of(comparison)}: {detail_of(comparison)}")
    for change in report.undecided:
        yield printable(f"  {Outcome.INCONCLUSIVE.value.upper():<13} {change}")
    yield printable(counts_of(report))
    if not report.behaviour.is_changed:
        yield printable(behaviour_of(report))
    for line in inputs_of(report):
        yield printable(line)
    for note in report.notes:
        yield printable(f"note: {note}")
    for line in power_lines(report, everything=everything):
        yield printable(line)
    remedy = remedy_of(report)
    if remedy:
        yield printable(remedy)
