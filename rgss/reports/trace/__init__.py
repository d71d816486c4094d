"""The traceability report as HTML, JSON, tables and terminal text."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.trace.files import found_file, report_file, tables_of
    from rgss.reports.trace.html import trace_context
    from rgss.reports.trace.report import TraceReport, trace_report
    from rgss.reports.trace.terminal import chain_lines, impact_lines, table_lines, terminal_tables
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)

__all__ = [
    "TraceReport",
    "chain_lines",
    "found_file",
    "impact_lines",
    "report_file",
    "table_lines",
    "tables_of",
    "terminal_tables",
    "trace_context",
    "trace_report",
]
