"""Findings about the text of a file, before it is parsed."""

from __future__ import annotations

import re
from collections.abc import Sequence

from rgss.findings import Finding, Severity

MOST_PROBLEMS = 1_000
"""Greatest number of reported problems of one file; a hostile file may have millions."""

# A line break in YAML.
_LINE_BREAK = re.compile(r"\r\n|[\n\r\x85\u2028\u2029]")


def refusal(label: str, rule: str, message: str, position: tuple[int, int] = (1, 1), *, hint: str = "") -> Finding:
    """Finding that makes a file unusable.

    Args:
        label: The file's name in messages.
        rule: The violated rule, without ``document.``.
        message: The problem.
        position: Line and column.
        hint: Advice.
    """
    line, column = position
    return Finding(
        file=label,
        line=line,
        column=column,
        rule=f"document.{rule}",
        severity=Severity.ERROR,
        message=message,
        hint=hint,
    )


def cut_short(label: str, findings: Sequence[Finding]) -> list[Finding]:
    """First findings of a file in the order of their positions, with a note if there are more."""
    first = sorted(findings)[:MOST_PROBLEMS]
    if len(findings) > MOST_PROBLEMS:
        message = f"more than {MOST_PROBLEMS} problems; the first {MOST_PROBLEMS} are shown"
        first.insert(0, refusal(label, "many", message, hint="correct these first"))
    return first


def end_of(text: str) -> tuple[int, int]:
    """Line and column of the end of a text."""
    breaks, last = 0, 0
    for match in _LINE_BREAK.finditer(text):
        breaks, last = breaks + 1, match.end()
    return breaks + 1, len(text) - last + 1
