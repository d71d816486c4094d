"""Traceability as Markdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from rgss.reports.trace.formats.format import Selection, TraceFormat
from rgss.reports.trace.formats.selection_tables import found_table, selected_tables

if TYPE_CHECKING:
    from rgss.reports.trace.report import TraceReport
    from rgss.trace.views import Chain, Impact

_WIDEST_GRID = 20


def _report(report: TraceReport, selection: Selection) -> bytes:
    from rgss.reports.table_files import to_markdown

    tables = selected_tables(report, selection, widest_grid=_WIDEST_GRID)
    return to_markdown(tables, title=report.title).encode("utf-8")


def _found(found: Chain | Impact, report: TraceReport) -> bytes:  # noqa: ARG001
    from rgss.reports.table_files import to_markdown
    from rgss.trace.views import Chain

    title = f"Chain of {found.id}" if isinstance(found, Chain) else f"Impact of a change to {found.id}"
    return to_markdown([found_table(found)], title=title).encode("utf-8")


MARKDOWN = TraceFormat(
    name="md",
    suffix=".md",
    title="a Markdown file",
    write_report=_report,
    write_found=_found,
    widest_grid=_WIDEST_GRID,
)
