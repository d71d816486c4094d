"""The traceability report as HTML, JSON, tables and terminal text."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.trace.files import trace_files
    from rgss.reports.trace.formats import TRACE_FORMATS, TraceFormat, trace_format
    from rgss.reports.trace.html import trace_context
    from rgss.reports.trace.report import TraceReport, trace_report
    from rgss.reports.trace.terminal import found_lines, report_lines
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
