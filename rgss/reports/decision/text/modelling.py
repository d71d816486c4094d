"""Table of the modelling assumptions, and drivers of failures, for a terminal."""

from __future__ import annotations

from collections.abc import Iterator

from rgss.decision.study_decision import StudyDecision
from rgss.reports.decision.assumption_rows import ASSUMPTION_HEADS, assumption_rows, assumption_sentences
from rgss.reports.failure_drivers import case_lines, driver_lines
from rgss.reports.plain_text import aligned_table


def modelling_lines(made: StudyDecision) -> Iterator[str]:
    """Lines of the table and its summary."""
    yield from ("", "Which assumption changes the choice (--what-if)", "")
    yield from aligned_table(ASSUMPTION_HEADS, [row.cells for row in assumption_rows(made)])
    yield from assumption_sentences(made)


def drivers_lines(made: StudyDecision) -> Iterator[str]:
    """Lines on the drivers of failures, and the success of each case; empty if nothing was drawn."""
    if made.drivers is not None and made.drivers.seeds:
        yield ""
        yield from driver_lines(made.drivers)
        yield from case_lines(made.cases)
