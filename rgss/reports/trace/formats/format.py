"""A format of the traceability report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact


@dataclass(frozen=True, slots=True, kw_only=True)
class Selection:
    """Part of a report.

    Attributes:
        gaps_only: Only what is open.
        table: Name of the only table; empty for all.
    """

    gaps_only: bool = False
    table: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceFormat:
    """A format that ``rgss trace`` writes.

    Attributes:
        name: Its name in options.
        suffix: The ending of its files.
        title: A file of it, in words, such as ``an Excel file``.
        write_report: Writes a part of a report. Raises `DefinitionError` for an unknown table or a
            missing package.
        write_found: Writes a chain or an impact; the report of the same project gives the texts.
        widest_grid: A matrix with more columns is written as a list of links; 0 for a format
            without tables, which always holds everything.
        tables_of_a_file: How many tables a file holds: 1, or 0 for any number.
        is_printable: Whether it is text that can be printed.
        is_for_terminals: Whether it is for people at a terminal, not for programs.
    """

    name: str
    suffix: str
    title: str
    write_report: Callable[[TraceReport, Selection], bytes]
    write_found: Callable[[Chain | Impact, TraceReport], bytes]
    widest_grid: int = 0
    tables_of_a_file: int = 0
    is_printable: bool = True
    is_for_terminals: bool = False

    @property
    def has_tables(self) -> bool:
        """True if one table alone can be written."""
        return self.widest_grid > 0
