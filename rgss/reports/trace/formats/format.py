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
        gaps_only: True for gaps only.
        table: Name of the only table; empty for all.
    """

    gaps_only: bool = False
    table: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class TraceFormat:
    """A format that ``rgss trace`` writes.

    Attributes:
        name: Its name in options.
        suffix: The suffix of its files.
        title: Name of a file of it, such as ``an Excel file``.
        write_report: Function that writes a part of a report. Raises `DefinitionError` for an unknown table or a
            missing package.
        write_found: Function that writes a chain or an impact, with the texts of the project's report.
        widest_grid: Most columns of a matrix that is written as a grid, not as a list of links; 0 for a format
            without tables, which always contains everything.
        tables_of_a_file: Number of tables in a file: 1, or 0 for any number.
        is_printable: True if it is text that can be printed.
        is_for_terminals: True if it is for a terminal, not for programs.
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
