"""Rules that are checked while the files of the requirements are read, listed to be explained."""

from __future__ import annotations

from rgss.findings import Severity
from rgss.trace.rules.rule import LoadingRule

RULES: tuple[LoadingRule, ...] = (
    LoadingRule(
        id="requirements.duplicate-id",
        severity=Severity.ERROR,
        explanation="An id names one element, across all files of the requirements folder.",
        fixed=True,
    ),
    LoadingRule(
        id="requirements.dangling-id",
        severity=Severity.ERROR,
        explanation="A link leads to an element that is declared.",
        fixed=True,
    ),
    LoadingRule(
        id="requirements.wrong-kind",
        severity=Severity.ERROR,
        explanation="A link leads to the kind of element that it is for: 'satisfied_by' to structure or behaviour.",
        fixed=True,
    ),
    LoadingRule(
        id="requirements.repeated-id",
        severity=Severity.ERROR,
        explanation="A list of links names an element once.",
        fixed=True,
    ),
    LoadingRule(
        id="requirements.cycle",
        severity=Severity.ERROR,
        explanation="No element derives from itself, contains itself or refines itself, over any number of steps.",
        fixed=True,
    ),
)
