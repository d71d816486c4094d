"""Formats of the traceability report, one module each, and their registry."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.trace.formats.format import Selection, TraceFormat
    from rgss.reports.trace.formats.registry import TRACE_FORMATS, trace_format
    from rgss.reports.trace.formats.selection_tables import selected_tables
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
