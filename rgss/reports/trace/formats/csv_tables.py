"""Traceability as CSV, a file for each table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.reports.trace.formats.format import Selection, TraceFormat
from rgss.reports.trace.formats.selection_tables import found_table, selected_tables

if TYPE_CHECKING:
    from rgss.reports.tables import Table
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact

_WIDEST_GRID = 300


def _report(report: TraceReport, selection: Selection) -> bytes:
    (one,) = selected_tables(report, selection, widest_grid=_WIDEST_GRID)
    return _file(one)


def _found(found: Chain | Impact, report: TraceReport) -> bytes:  # noqa: ARG001
    return _file(found_table(found))


def _file(table: Table) -> bytes:
    from rgss.reports.table_files import to_csv

    # Spreadsheets recognise UTF-8 by its byte order mark.
    return to_csv(table).encode("utf-8-sig")


CSV = TraceFormat(
    name="csv",
    suffix=".csv",
    title="a CSV file",
    write_report=_report,
    write_found=_found,
    widest_grid=_WIDEST_GRID,
    tables_of_a_file=1,
)
