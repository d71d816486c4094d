"""Findings: problems in a user's files, with their positions."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

_LONGEST_SHOWN = 60


class Severity(str, Enum):
    """Severity of a finding: an error makes the project unusable, a warning does not."""

    ERROR = "error"
    WARNING = "warning"
    INFO = "info"


@dataclass(frozen=True, slots=True, kw_only=True, order=True)
class Finding:
    """One problem at one position of one file.

    Attributes:
        file: The file, relative to the project.
        line: Line, from 1.
        column: Column, from 1.
        rule: The id of the violated rule, such as ``document.unknown-key``.
        severity: Its severity.
        message: The problem, in one line.
        hint: How to resolve it, in one line; may be empty.
    """

    file: str
    line: int
    column: int
    rule: str
    severity: Severity
    message: str
    hint: str = ""

    def __str__(self) -> str:
        hint = f" ({self.hint})" if self.hint else ""
        where = f"{self.file}:{self.line}:{self.column}"
        return printable(f"{where}: {self.severity.value}: {self.message}{hint} [{self.rule}]")


def printable(text: str) -> str:
    """Text safe for a terminal: contents and names of files must not control it."""
    return "".join(character if character.isprintable() else "\N{REPLACEMENT CHARACTER}" for character in text)


def shown(value: object) -> str:
    """User's value for messages: on one line, truncated if long."""
    if isinstance(value, str):
        return repr(value if len(value) <= _LONGEST_SHOWN else value[: _LONGEST_SHOWN - 1] + "…")
    text = repr(value)
    return text if len(text) <= _LONGEST_SHOWN else text[: _LONGEST_SHOWN - 1] + "…"
