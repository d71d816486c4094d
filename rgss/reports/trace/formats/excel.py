"""Traceability as an Excel file, a sheet for each table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.reports.trace.formats.format import Selection, TraceFormat
from rgss.reports.trace.formats.selection_tables import found_table, selected_tables

if TYPE_CHECKING:
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact

_WIDEST_GRID = 300


def _report(report: TraceReport, selection: Selection) -> bytes:
    from rgss.reports.table_files import to_excel

    return to_excel(selected_tables(report, selection, widest_grid=_WIDEST_GRID))


def _found(found: Chain | Impact, report: TraceReport) -> bytes:  # noqa: ARG001
    from rgss.reports.table_files import to_excel

    return to_excel([found_table(found)])


EXCEL = TraceFormat(
    name="xlsx",
    suffix=".xlsx",
    title="an Excel file",
    write_report=_report,
    write_found=_found,
    widest_grid=_WIDEST_GRID,
    is_printable=False,
)
